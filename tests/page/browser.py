"""Headless Chromium, driven through a pipe by its DevTools protocol: no driver, no network."""

import base64
import io
import json
import os
import select
import subprocess
import time

import matplotlib.image
import numpy as np

#: s, limit for an answer and for loading a page
PATIENCE = 60


class Browser:
    """One process with a separate profile and home directory. Use it in a `with` statement."""

    def __init__(self, program, folder):
        to_read, self.to_browser = os.pipe()
        self.from_browser, to_write = os.pipe()
        options = ["--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--remote-debugging-pipe",
                   "--no-first-run", f"--user-data-dir={folder}/profile"]
        # The protocol uses descriptors 3 and 4.
        self.process = subprocess.Popen(
            ["bash", "-c", f'exec "$@" 3<&{to_read} 4>&{to_write}', "browser", program, *options, "about:blank"],
            pass_fds=(to_read, to_write), stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            env={**os.environ, "HOME": str(folder)})
        os.close(to_read)
        os.close(to_write)
        self.rest, self.events, self.number = b"", [], 0

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(PATIENCE)

    def read(self, until):
        """Returns the next message, or None after a timeout."""
        while b"\0" not in self.rest:
            ready, _, _ = select.select([self.from_browser], [], [], max(0.0, until - time.monotonic()))
            if not ready:
                return None
            piece = os.read(self.from_browser, 1 << 20)
            assert piece, "the browser has ended"
            self.rest += piece
        text, self.rest = self.rest.split(b"\0", 1)
        return json.loads(text)

    def call(self, method, session=None, **parameters):
        """Returns the answer to a call; other messages are appended to `events`."""
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        os.write(self.to_browser, json.dumps(message).encode() + b"\0")
        until = time.monotonic() + PATIENCE
        while (answer := self.read(until)) is not None:
            if answer.get("id") == self.number:
                assert "error" not in answer, f"{method}: {answer['error']}"
                return answer["result"]
            self.events.append(answer)
        raise AssertionError(f"{method}: no answer within {PATIENCE} s")

    def page(self, address, width=1200, height=1400, ratio=1, dark=False):
        return Page(self, address, width, height, ratio, dark)


class Page:
    """A page that has been opened and reports that it is ready, or why not."""

    def __init__(self, browser, address, width, height, ratio, dark):
        self.browser, self.address = browser, address
        target = browser.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = browser.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=ratio, mobile=False)
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])
        self.call("Page.navigate", url=address)
        self.state = self.wait_for("document.documentElement?.dataset.state")

    def call(self, method, **parameters):
        return self.browser.call(method, self.session, **parameters)

    def value(self, expression):
        answer = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in answer, answer
        return answer["result"].get("value")

    def wait_for(self, expression):
        until = time.monotonic() + PATIENCE
        while time.monotonic() < until:
            if found := self.value(expression):
                return found
            time.sleep(0.05)
        raise AssertionError(f"{self.address}: not within {PATIENCE} s: {expression}")

    def settle(self):
        """Waits until two more pictures have been drawn."""
        self.value("new Promise((go) => requestAnimationFrame(() => requestAnimationFrame(() => go(true))))")

    def text(self, selector):
        return self.value(f"document.querySelector({json.dumps(selector)}).textContent")

    def picture(self, file=None):
        """Returns the visible part as RGB, 0 to 255."""
        self.settle()
        png = base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])
        if file:
            file.write_bytes(png)
        return np.round(255 * matplotlib.image.imread(io.BytesIO(png))[..., :3]).astype(int)

    def place(self, selector, across=0.5, down=0.5):
        """Returns a position within an element, px; scrolls to it."""
        box = self.value(f"(() => {{ const e = document.querySelector({json.dumps(selector)}); e.scrollIntoView({{ block: 'nearest' }});"
                         " const b = e.getBoundingClientRect(); return [b.left, b.top, b.width, b.height]; })()")
        return box[0] + across * box[2], box[1] + down * box[3]

    def mouse(self, kind, x, y, **more):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)
        self.settle()

    def click(self, x, y):
        self.mouse("mouseMoved", x, y)
        for kind in ("mousePressed", "mouseReleased"):
            self.mouse(kind, x, y, button="left", clickCount=1)

    def drag(self, x0, y0, x1, y1):
        self.mouse("mouseMoved", x0, y0)
        self.mouse("mousePressed", x0, y0, button="left", clickCount=1)
        for share in (0.5, 1.0):
            self.mouse("mouseMoved", x0 + share * (x1 - x0), y0 + share * (y1 - y0), button="left", buttons=1)
        self.mouse("mouseReleased", x1, y1, button="left", clickCount=1)

    def key(self, key):
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, text=key if kind == "keyDown" and len(key) == 1 else "")
        self.settle()

    def complaints(self):
        """Returns errors, and requests for anything other than the page itself."""
        self.value("1")
        wrong = []
        for event in self.browser.events:
            if event.get("sessionId") != self.session:
                continue
            said = event["params"]
            if event["method"] == "Network.requestWillBeSent" and said["request"]["url"].split("#")[0] != self.address.split("#")[0]:
                wrong.append(f"asks for {said['request']['url']}")
            elif event["method"] in ("Runtime.exceptionThrown", "Runtime.consoleAPICalled"):
                wrong.append(json.dumps(said))
            elif event["method"] == "Log.entryAdded":
                wrong.append(said["entry"]["text"])
        return wrong
