"""start.py, with which the program carries out commands by modules of this package: messages, exit codes and signals."""

import shutil
import signal
import subprocess
import sys
import time

import pytest
from conftest import PACKAGE


@pytest.fixture
def start(tmp_path):
    """Returns a function that starts a module of a package talus with this text."""
    package = tmp_path / "talus"
    package.mkdir()
    (package / "__init__.py").touch()
    shutil.copy(PACKAGE / "talus/start.py", package)
    shutil.copy(PACKAGE / "talus/errors.py", package)

    def started(text, *words, out=subprocess.PIPE, closes_output=False):
        (package / "example.py").write_text(text)
        command = [sys.executable, "-P", package / "start.py", "example", *words]
        return subprocess.Popen(["sh", "-c", 'exec "$@" >&-', "sh", *command] if closes_output else command, cwd=tmp_path, text=True,
                                stdout=out, stderr=subprocess.PIPE)

    return started


def outcome(process):
    out, err = process.communicate(timeout=30)
    return process.returncode, out, err


def test_a_module_gets_the_arguments_and_ends_with_its_code(start):
    assert outcome(start("def main(words):\n print(words)\n return 3\n", "a b", "--x")) == (3, "['a b', '--x']\n", "")
    assert outcome(start("def main(words): pass\n"))[0] == 0


@pytest.mark.parametrize(("text", "code", "message"), [
    ("from talus.errors import MissingFile\nraise MissingFile('a.h5: not there')", 66, "a.h5: not there"),
    ("import no_such_package.inner", 69, "this command needs the Python module no_such_package: "
                                         "apt-get install python3-no_such_package"),
    ("open('missing/file', 'w')", 74, "missing/file: cannot read or write: No such file or directory"),
    ("open('.', 'w')", 73, ".: cannot read or write: Is a directory"),
    ("raise MemoryError", 71, "out of memory"),
])
def test_an_error_is_one_line_with_a_code_of_the_program(start, text, code, message):
    ended, out, err = outcome(start("def main(words):\n " + text.replace("\n", "\n ") + "\n"))
    assert (ended, out, err) == (code, "", f"talus: error: {message}\n")


@pytest.mark.parametrize("setting", [{"PYTHONIOENCODING": "latin-1"}, {"LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0"}])
def test_output_is_utf8_in_any_locale(start, monkeypatch, setting):
    for name, value in setting.items():
        monkeypatch.setenv(name, value)
    process = start("import sys\ndef main(words): print('θ ± 1', '\\udcff'); print('μ', file=sys.stderr)\n")
    out, err = process.stdout.buffer.read(), process.stderr.buffer.read()
    assert (process.wait(), out, err) == (0, "θ ± 1 ".encode() + b"\xff\n", "μ\n".encode())


def test_a_full_disk_fails_the_output(start):
    with open("/dev/full", "w") as full:
        process = start("def main(words): print('result')\n", out=full)
    assert outcome(process) == (74, None, "talus: error: standard output: cannot read or write: No space left on device\n")


def test_closed_output_is_no_failure(start):
    process = start("import os\ndef main(words): print('lost'); os.write(2, b'done')\n", closes_output=True)
    assert outcome(process) == (0, "", "done")


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
@pytest.mark.parametrize("work", ["time.sleep(30)", "hashlib.pbkdf2_hmac('sha256', b'', b'', 10**8)"])  # the second in C
def test_a_signal_stops_it(start, number, work):
    process = start(f"import hashlib, time\ndef main(words):\n print('begun', flush=True)\n {work}\n")
    assert process.stdout.readline() == "begun\n"
    process.send_signal(number)
    began = time.monotonic()
    assert outcome(process) == (75, "", "Stopped; unfinished results are not kept.\n")
    assert time.monotonic() - began < 5
