"""The commands and the Python of docs/tutorial.md, docs/questions.md and docs/gallery.md run as they are printed, in their
order, as a reader types them. Only the bed of the demo is a smaller one."""

import os
import re
import shutil
import subprocess
import sys

import pytest
from conftest import PROGRAM, ROOT

PAGES = ["tutorial", "questions", "gallery"]

#: In the place of demo.toml: 84 grains, which fail above 10 deg within a second of computing.
SMALL_DEMO = """
[bed]
length = 12
depth = 7
[deposition]
rate = 2
rest_velocity = 0.1
[tilt]
rate = 40
step = 0.1
[output]
frame_every = 2
observable_every = 0.5
"""

#: Commands before those of the system: all packages are there, and nothing is installed or built.
STAND_INS = {
    "dpkg-query": "shift 3\nprintf '%s installed\\n' \"$@\"",
    "cmake": "exit 0",
    "apt-get": "exit 1",
    "sudo": "exit 1",
    "python3": f'exec {sys.executable} "$@"',
}


def pieces(page):
    """What a page tells to type, in its order: (None, command), or (NAME, text) of a file to be saved."""
    text = (ROOT / f"docs/{page}.md").read_text()
    found = re.finditer(r"^```python\n(?P<code>.*?)^```$|^ {4}(?P<command>\S[^\n]*)$", text, re.MULTILINE | re.DOTALL)
    for piece in found:
        if piece["code"]:
            yield re.findall(r"as `(\w+\.py)`", text[: piece.start()])[-1], piece["code"]
        else:
            yield None, piece["command"]


@pytest.fixture
def checkout(tmp_path):
    """A checkout with nothing but what the pages need."""
    shutil.copy(ROOT / "bootstrap", tmp_path)
    (tmp_path / "build/release").mkdir(parents=True)
    (tmp_path / "build/release/talus").symlink_to(PROGRAM)
    for name in ("docs", "python"):
        (tmp_path / name).symlink_to(ROOT / name)
    shutil.copytree(ROOT / "assets/scenarios", tmp_path / "assets/scenarios")
    (tmp_path / "assets/scenarios/demo.toml").write_text(SMALL_DEMO)
    (tmp_path / "bin").mkdir()
    for name, script in STAND_INS.items():
        (tmp_path / "bin" / name).write_text(f"#!/bin/bash\n{script}\n")
        (tmp_path / "bin" / name).chmod(0o755)
    return tmp_path


@pytest.mark.parametrize("page", PAGES)
def test_page_can_be_typed_from_its_first_line_to_its_last(page, checkout):
    if "matplotlib" in (ROOT / f"docs/{page}.md").read_text():
        pytest.importorskip("matplotlib", reason="matplotlib is not installed: python3-matplotlib")
    if shutil.which("gnuplot") is None:
        pytest.skip("gnuplot is not installed: gnuplot-nox")
    environment = os.environ | {"PATH": f"{checkout / 'bin'}:{checkout / 'build/release'}:{os.environ['PATH']}", "MPLBACKEND": "Agg"}
    typed = list(pieces(page))
    assert typed
    for name, text in typed:
        if name:
            (checkout / name).write_text(text)
            continue
        done = subprocess.run(["bash", "-c", text], cwd=checkout, env=environment, capture_output=True, text=True)
        assert done.returncode == 0, f"docs/{page}.md: {text}\n{done.stdout}{done.stderr}"
        for output in re.findall(r"(?:-o|--screenshot) (\S+)", text):
            made = checkout / output
            assert any(made.iterdir()) if made.is_dir() else made.stat().st_size > 0, f"docs/{page}.md: {text}"


def test_commands_are_recognised():
    """The tutorial is that of the first hour: none of its steps is lost on the way from the page to the test."""
    commands = [text for name, text in pieces("tutorial") if not name]
    for step in ["./bootstrap demo", "talus info", "talus panel", "talus run", "talus ensemble", "talus figures", "talus view", "python3"]:
        assert any(step in command for command in commands), step
    assert [name for name, _ in pieces("tutorial") if name] == ["first.py"]
