"""Common parts of the tests: the program, and runs that they share."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("TALUS_BUILD", ROOT / "build/release"))
# With the extension, if it was built.
PACKAGE = BUILD / "python" if any((BUILD / "python/talus").glob("_core*.so")) else ROOT / "python"
sys.path[:0] = [str(PACKAGE), str(ROOT / "docs/images/cookbook")]
os.environ["PYTHONPATH"] = f"{PACKAGE}:{os.environ.get('PYTHONPATH', '')}"
pytest.importorskip("h5py", reason="h5py is not installed: python3-h5py")
pytest.importorskip("xxhash", reason="xxhash is not installed: python3-xxhash")

import talus  # noqa: E402

PROGRAM = os.path.abspath(os.environ.get("TALUS_PROGRAM", ROOT / "build/release/talus"))
#: Environment of the program. LD_PRELOAD loads the sanitizer for Python; the program has its own built in.
PROGRAM_ENVIRONMENT = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}

#: A bed of 90 grains that fails within a second of computing.
BED = """
[bed]
length = 15
depth = 6
[tilt]
rate = 4
step = 0.004
[output]
frame_every = 0.5
"""


def pytest_configure(config):
    config.addinivalue_line("markers", "chosen: ./bootstrap test runs it without --all")


def run_talus(*words, folder=None):
    """Returns the output of `talus`; if it fails, so does the test."""
    done = subprocess.run([PROGRAM, *map(str, words)], cwd=folder, capture_output=True, text=True, env=PROGRAM_ENVIRONMENT)
    assert done.returncode == 0, done.stderr
    return done.stdout


def json_of(*words):
    return json.loads(run_talus(*words, "--json"))


@pytest.fixture(scope="session")
def folder(tmp_path_factory):
    """Returns a folder with bed.toml."""
    folder = tmp_path_factory.mktemp("runs")
    (folder / "bed.toml").write_text(BED)
    return folder


@pytest.fixture(scope="session")
def analysed(folder):
    """Returns the path of a complete run of a periodic bed, with its analysis."""
    path = folder / "analysed.h5"
    run_talus("run", folder / "bed.toml", "-o", path)
    run_talus("analyze", path)
    return path


@pytest.fixture
def run(analysed):
    with talus.open(analysed) as run:
        yield run


@pytest.fixture(scope="session")
def walls(folder):
    """Returns the path of a run between walls on a smooth floor that continues after failure, without an
    analysis."""
    path = folder / "walls.h5"
    run_talus("run", folder / "bed.toml", "--set", "bed.boundary=walls", "--set", "bed.floor=smooth",
              "--set", "tilt.after_failure=hold", "-o", path)
    return path


@pytest.fixture(scope="session")
def rolling(folder):
    """Returns the path of a run whose contacts resist rolling."""
    path = folder / "rolling.h5"
    run_talus("run", folder / "bed.toml", "--set", "contact.rolling_friction=0.1", "--set", "tilt.end_angle=4",
              "-o", path)
    return path


@pytest.fixture(scope="session")
def stopped(folder):
    """Returns the path of a run that was stopped halfway; its folder has several segments."""
    path = folder / "stopped.h5"
    process = subprocess.Popen([PROGRAM, "run", folder / "bed.toml", "-o", path], stderr=subprocess.DEVNULL)
    manifest = folder / "stopped.h5.run/manifest"
    while process.poll() is None and (not manifest.exists() or manifest.read_text().count("segment") < 8):
        time.sleep(0.005)
    process.send_signal(signal.SIGINT)
    assert process.wait() == 75, "the run was complete before it could be stopped"
    return path


@pytest.fixture
def copied(analysed, tmp_path):
    """Returns a copy of the analysed run, which the test may damage."""
    return Path(shutil.copy(analysed, tmp_path / "copied.h5"))


@pytest.fixture(scope="session")
def book(tmp_path_factory):
    """Returns the folder in which the commands of docs/cookbook.md were run."""
    import make

    folder = tmp_path_factory.mktemp("cookbook")
    make.make_runs(folder, PROGRAM)
    return folder
