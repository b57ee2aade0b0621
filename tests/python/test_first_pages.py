"""The commands and the files of docs/quickstart.md, docs/tutorial.md, docs/questions.md and docs/gallery.md run as
printed, in order, as a reader types them. Only the bed of the demo is smaller."""

import importlib.machinery
import importlib.util
import os
import re
import shutil
import subprocess
import sys

import pytest
from conftest import PACKAGE, PROGRAM, ROOT

PAGES = ["quickstart", "tutorial", "questions", "gallery"]

#: Replacement for demo.toml: 84 grains, which fail above 10 deg within a second of computing.
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

#: Fake commands ahead of those of the system: all packages are present, and nothing is installed or built.
STAND_INS = {
    "dpkg-query": "shift 3\nprintf '%s installed\\n' \"$@\"",
    "cmake": "exit 0",
    "apt-get": "exit 1",
    "sudo": "exit 1",
    "python3": f'exec {sys.executable} "$@"',
}


def pieces(page):
    """Returns what the reader of a page types, in order: (None, command), or (NAME, text) of a file
    to be saved."""
    text = (ROOT / f"docs/{page}.md").read_text()
    found = re.finditer(r"^```(?:python|toml)\n(?P<code>.*?)^```$|^ {4}(?P<command>\S[^\n]*)$", text, re.MULTILINE | re.DOTALL)
    for piece in found:
        if piece["code"]:
            yield re.findall(r"as `(\w+\.(?:py|toml))`", text[: piece.start()])[-1], piece["code"]
        else:
            yield None, piece["command"]


@pytest.fixture
def checkout(tmp_path):
    """Creates a checkout with only what the pages need."""
    shutil.copy(ROOT / "bootstrap", tmp_path)
    (tmp_path / "build/release").mkdir(parents=True)
    (tmp_path / "build/release/talus").symlink_to(PROGRAM)
    (tmp_path / "build/release/python").symlink_to(PACKAGE)
    for name in ("docs", "python"):
        (tmp_path / name).symlink_to(ROOT / name)
    shutil.copytree(ROOT / "assets/scenarios", tmp_path / "assets/scenarios")
    (tmp_path / "assets/scenarios/demo.toml").write_text(SMALL_DEMO)
    (tmp_path / "bin").mkdir()
    for name, script in STAND_INS.items():
        (tmp_path / "bin" / name).write_text(f"#!/bin/bash\n{script}\n")
        (tmp_path / "bin" / name).chmod(0o755)
    return tmp_path


def type_in(checkout, text):
    """Returns what a command prints that is typed in a checkout; if it fails, so does the test."""
    environment = os.environ | {"PATH": f"{checkout / 'bin'}:{checkout / 'build/release'}:{os.environ['PATH']}", "MPLBACKEND": "Agg"}
    done = subprocess.run(["bash", "-c", text], cwd=checkout, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, f"{text}\n{done.stdout}{done.stderr}"
    return done.stdout + done.stderr


@pytest.mark.parametrize("page", PAGES)
def test_page_can_be_typed_from_its_first_line_to_its_last(page, checkout):
    pytest.importorskip("matplotlib", reason="matplotlib is not installed: python3-matplotlib")
    if "talus.Simulation(" in (ROOT / f"docs/{page}.md").read_text():
        pytest.importorskip("talus._core", reason="the extension is not built: pybind11-dev, python3-dev")
    typed = list(pieces(page))
    assert typed
    for name, text in typed:
        if name:
            (checkout / name).write_text(text)
            continue
        if text.startswith("docs/data/campaign run "):  # hours: a few small beds in their place
            folder = f"runs/campaign/{text.split()[-1]}"
            text = f"build/release/talus ensemble assets/scenarios/demo.toml --seeds 1-5 -o {folder}"
        type_in(checkout, text)
        for output in re.findall(r"(?:-o|--screenshot) (\S+)", text):
            made = checkout / output
            assert any(made.iterdir()) if made.is_dir() else made.stat().st_size > 0, f"docs/{page}.md: {text}"


def test_the_demo_works_as_often_as_it_is_typed(checkout):
    pixels = []
    for seed in (1, 2):
        (checkout / "assets/scenarios/demo.toml").write_text(f"seed = {seed}\n{SMALL_DEMO}")
        assert "From deposition to avalanche" in type_in(checkout, "./bootstrap demo")
        pictures = sorted((checkout / "runs/demo-maps").iterdir())
        assert len(pictures) > 10
        pixels.append(pictures[0].read_bytes().partition(b"IDAT")[2])
    assert pixels[0] != pixels[1], "a picture is left over from the first run"


def test_commands_are_recognised():
    """Every step of the first pages is found by the test."""
    commands = [text for name, text in pieces("tutorial") if not name]
    for step in ["./bootstrap demo", "talus info", "talus panel", "talus run", "talus ensemble", "talus figures", "talus view", "python3"]:
        assert any(step in command for command in commands), step
    assert [name for name, _ in pieces("tutorial") if name] == ["first.py", "hold.py"]
    assert [name for name, _ in pieces("quickstart") if name] == ["own.toml", "share.py", "back.py"]


@pytest.mark.chosen
def test_pictures_are_made_by_the_commands_next_to_them():
    """docs/make finds the command of each picture on the page that shows it; the runs are made by printed commands too."""
    make = docs_make()
    texts = {name: path.read_text() for name, path in make.pages().items()}
    shown = {picture for text in texts.values() for picture in make.pictures_of(text) if not picture.startswith("cookbook/")}
    assert shown == set(make.PICTURES)
    folder = ROOT / "docs/images"
    kept = {str(path.relative_to(folder).with_suffix("")) for path in folder.rglob("*.png")}
    assert {name for name in kept if not name.startswith("cookbook/")} == shown
    for picture in shown:
        make.command_of(picture)
    assert len({file for file, _ in make.PICTURES.values()}) == len(make.PICTURES), "pictures are drawn in parallel"
    printed = {line.strip() for text in texts.values() for line in text.splitlines() if line.startswith("    ")}
    for run, commands in make.RUNS.items():
        missing = {line.strip() for line in commands.splitlines()} - printed
        assert not missing, f"{run} is made by what no page prints: {missing}"


@pytest.mark.chosen
def test_small_pictures_keep_the_colours_of_legends():
    from PIL import Image

    picture = Image.new("RGB", (256, 200), "white")
    for k in range(256):
        picture.paste((k, k, k), (k, 40, k + 1, 200))
    amber, vermilion = (230, 159, 0), (213, 94, 0)
    picture.paste(amber, (10, 10, 16, 16))
    picture.paste(vermilion, (30, 10, 36, 16))
    shown = docs_make().with_palette(picture, 16).convert("RGB")
    assert len(shown.getcolors()) <= 16
    assert [shown.getpixel(at) for at in [(12, 12), (32, 12), (2, 2)]] == [amber, vermilion, (255, 255, 255)]


@pytest.mark.chosen
def test_commands_name_the_program_where_a_build_leaves_it():
    """A new reader does not have `talus` on the path."""
    for path in docs_make().pages().values():
        bare = re.findall(r"^ {4,8}talus .*$", path.read_text(), re.MULTILINE)
        assert not bare, f"{path}: {bare}"


@pytest.mark.chosen
def test_pictures_of_first_pages_are_small():
    found = [path for name in ("tutorial", "gallery", "python") for path in (ROOT / f"docs/images/{name}").glob("*.png")]
    assert len(found) > 20
    for path in found:
        assert path.stat().st_size < 150_000, path


@pytest.mark.chosen
def test_a_number_or_picture_that_differs_is_found(tmp_path, monkeypatch):
    make = docs_make()
    monkeypatch.setattr(make, "ROOT", tmp_path)
    monkeypatch.setattr(make, "DOCS", tmp_path)
    monkeypatch.setattr(make, "TABLES", {"angles": lambda beds, *names: "| a |\n" + "".join(f"| {beds[name]} |\n" for name in names).rstrip()})
    page = tmp_path / "page.md"
    text = "It fails at 2.00<!--=a .2f--> deg,\nor 1.0 ± 0.2<!--=b ±.1f-->.\n<!--table angles x y-->\n| a |\n| 1 |\n| 2 |\n<!--end-->\n"
    page.write_text(text)
    (tmp_path / "README.md").write_text("")

    class Values(dict):
        beds = {"x": 1, "y": 2}

        def needs(self, name):
            return ["slow"] if name == "a" else []

    values = Values(a=2.0, b=(1.04, 0.18))
    assert make.settle_numbers(values, "page", True, {"slow"}) == []
    values["a"], values["b"], values.beds = 2.006, (1.06, 0.18), {"x": 1, "y": 3}
    assert len(make.settle_numbers(values, "page", True, {"slow"})) == 3
    assert len(make.settle_numbers(values, "page", True, set())) == 2, "a run that is not there is passed over"
    assert page.read_text() == text
    make.settle_numbers(values, "page", False, {"slow"})
    assert page.read_text() == text.replace("2.00<", "2.01<").replace("1.0 ±", "1.1 ±").replace("| 2 |", "| 3 |")
    for unmarked in ("no number<!--=a .2f-->", "2.0<!--=a-->"):
        page.write_text(unmarked)
        with pytest.raises(make.Failed, match="no number precedes it"):
            make.settle_numbers(values, "page", True, set())
    image = pytest.importorskip("PIL.Image").new("L", (50, 50), 255)
    other = image.copy()
    assert make.difference(image, other) == ""
    other.paste(0, (0, 0, 5, 5))
    assert make.difference(image, other) == "25 pixels differ"


def docs_make():
    """Returns docs/make as a module."""
    pytest.importorskip("PIL", reason="Pillow is not installed: python3-pil")
    loader = importlib.machinery.SourceFileLoader("docs_make", str(ROOT / "docs/make"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("docs_make", loader))
    loader.exec_module(module)
    return module
