"""The package as others install it: a wheel that is built and installed without a network, and cmake --install."""

import importlib.util
import os
import shutil
import subprocess
import sys

import pytest
from conftest import ROOT, json_of

import talus

FILES = sorted(path.name for path in (ROOT / "python/talus").iterdir() if path.is_file())


def call(*words, **options):
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout.strip()


def check_installed(folder, path):
    """The package in `folder` is whole and reads a run, from another place than the sources."""
    assert sorted(file.name for file in (folder / "talus").iterdir() if file.is_file()) == FILES
    words = "import sys, talus; print(talus.__file__, len(talus.open(sys.argv[1]).frames))"
    environment = {**os.environ, "PYTHONPATH": str(folder), "PYTHONDONTWRITEBYTECODE": "1"}
    told = call(sys.executable, "-c", words, path, env=environment, cwd="/")
    assert told == f"{folder}/talus/__init__.py {json_of('info', path)['frames']}"


def test_wheel_is_built_and_installed_without_a_network(analysed, tmp_path):
    for package in ("pip", "setuptools", "wheel"):
        if importlib.util.find_spec(package) is None:
            pytest.skip(f"{package} is not installed: python3-{package}")
    source = shutil.copytree(ROOT / "python", tmp_path / "source", ignore=shutil.ignore_patterns("__pycache__", "build"))
    pip = (sys.executable, "-m", "pip", "--disable-pip-version-check", "--no-input")
    call(*pip, "wheel", "--no-index", "--no-deps", "--no-build-isolation", "-w", tmp_path, source)
    [wheel] = tmp_path.glob("*.whl")
    assert wheel.name == f"talus-{talus.__version__}-py3-none-any.whl"
    call(*pip, "install", "--no-index", "--no-deps", "--no-compile", "--target", tmp_path / "site", wheel)
    check_installed(tmp_path / "site", analysed)


def test_cmake_installs_the_package_beside_the_program(analysed, tmp_path):
    build = os.environ.get("TALUS_BUILD", ROOT / "build/release")
    call("cmake", "--install", build, "--prefix", tmp_path, "--component", "python")
    [package] = tmp_path.glob("lib/python3*/dist-packages")
    check_installed(package, analysed)
