"""The installed package: wheels built and installed without a network, with and without the extension, and
cmake --install."""

import importlib.util
import os
import shutil
import subprocess
import sys

import pytest
from conftest import BUILD, ROOT, json_of

import talus

FILES = sorted(path.name for path in (ROOT / "python/talus").iterdir() if path.is_file())


def call(*words, **options):
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout.strip()


def check_installed(folder, path, extension):
    """Checks that the package in `folder` is complete and, outside the sources, reads a run, and steps a
    bed or reports what is missing."""
    files = sorted(file.name for file in (folder / "talus").iterdir() if file.is_file())
    assert [name for name in files if not name.endswith(".so")] == FILES
    assert len(files) == len(FILES) + extension
    words = """
import sys, talus
reported = [talus.__file__, len(talus.open(sys.argv[1]).frames)]
try:
    sim = talus.Simulation({"bed": {"length": 10, "depth": 3}})
    sim.step(3)
    reported.append(sim.step_count)
except talus.Error as error:
    reported.append("talus._core" in str(error) and "./bootstrap wheel" in str(error))
print(*reported)
"""
    environment = {**os.environ, "PYTHONPATH": str(folder), "PYTHONDONTWRITEBYTECODE": "1"}
    reported = call(sys.executable, "-c", words, path, env=environment, cwd="/")
    assert reported == f"{folder}/talus/__init__.py {json_of('info', path)['frames']} {3 if extension else True}"


def has_extension():
    return any((BUILD / "python/talus").glob("_core*.so"))


@pytest.mark.parametrize("extension", [False, True])
def test_wheel_is_built_and_installed_without_a_network(analysed, tmp_path, extension):
    for package in ("pip", "setuptools", "wheel"):
        if importlib.util.find_spec(package) is None:
            pytest.skip(f"{package} is not installed: python3-{package}")
    if extension and not has_extension():
        pytest.skip("the extension is not built: pybind11-dev, python3-dev")
    source = shutil.copytree(BUILD / "python" if extension else ROOT / "python", tmp_path / "source",
                             ignore=shutil.ignore_patterns("__pycache__", "build", "*.egg-info"))
    pip = (sys.executable, "-m", "pip", "--disable-pip-version-check", "--no-input")
    call(*pip, "wheel", "--no-index", "--no-deps", "--no-build-isolation", "-w", tmp_path, source)
    [wheel] = tmp_path.glob("*.whl")
    assert wheel.name.startswith(f"talus-{talus.__version__}-{'cp3' if extension else 'py3-none-any'}")
    call(*pip, "install", "--no-index", "--no-deps", "--no-compile", "--target", tmp_path / "site", wheel)
    check_installed(tmp_path / "site", analysed, extension)


def test_cmake_installs_the_package_beside_the_program(analysed, tmp_path):
    call("cmake", "--install", BUILD, "--prefix", tmp_path, "--component", "python")
    [package] = tmp_path.glob("lib/python3*/dist-packages")
    check_installed(package, analysed, has_extension())
