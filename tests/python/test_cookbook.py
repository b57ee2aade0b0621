"""Each recipe of docs/cookbook.md runs as printed and draws its picture, and its statements hold."""

import csv
import functools
import re
import subprocess

import make
import numpy as np
import pytest
from conftest import ROOT

import talus

PAGE = (ROOT / "docs/cookbook.md").read_text()
NEEDED = {"contacts-and-gamma": ["pandas"], "network": ["networkx"]}


@pytest.fixture(scope="module")
def drawn(book):
    """Draws the picture of a recipe and returns its path."""
    pytest.importorskip("matplotlib.pyplot", reason="matplotlib is not installed: python3-matplotlib")
    return functools.cache(lambda name: make.make_picture(name, book))


def size_of(picture):
    """Returns width and height from the header of a PNG."""
    begin = picture.read_bytes()[:24]
    assert begin.startswith(b"\x89PNG\r\n")
    return tuple(int.from_bytes(begin[i : i + 4], "big") for i in (16, 20))


@pytest.mark.chosen
def test_a_recipe_draws_any_run(analysed, tmp_path):
    pytest.importorskip("matplotlib.pyplot", reason="matplotlib is not installed: python3-matplotlib")
    (tmp_path / "runs").mkdir()
    (tmp_path / "runs/cookbook.h5").symlink_to(analysed)
    name = next(name for name, code in make.recipes().items() if 'talus.open("runs/cookbook.h5"' in code)
    assert size_of(make.make_picture(name, tmp_path)) == size_of(make.PICTURES / f"{name}.png")


@pytest.mark.parametrize("name", make.recipes())
def test_recipe_runs_and_draws_the_picture_of_the_page(drawn, name):
    for package in NEEDED.get(name, []):
        pytest.importorskip(package, reason=f"{package} is not installed: python3-{package}")
    assert size_of(drawn(name)) == size_of(make.PICTURES / f"{name}.png")


def test_page_shows_ten_recipes_each_with_its_picture_below_it():
    headings = re.findall(r"^## (\d+)\. ", PAGE, re.MULTILINE)
    assert headings == [str(n) for n in range(1, 11)]
    sections = re.split(r"^## \d+\. ", PAGE, flags=re.MULTILINE)[1:]
    for section, name in zip(sections, make.recipes(), strict=True):
        assert re.search(rf"^```$\n\n!\[[^]]{{20,}}\]\(images/cookbook/{name}\.png\)$", section, re.MULTILINE), name


def test_pictures_are_small_and_all_shown():
    pictures = {path.stem: path.stat().st_size for path in make.PICTURES.glob("*.png")}
    assert pictures.keys() == make.recipes().keys()
    assert max(pictures.values()) < 60_000, pictures


def test_command_of_the_page_draws_again_what_is_named(book):
    assert "    docs/images/cookbook/make.py " in PAGE
    reported = subprocess.run([make.__file__, "--help"], capture_output=True, text=True)
    assert reported.returncode == 0 and "NAME" in reported.stdout


def test_run_of_the_page_is_what_it_says(book):
    with talus.open(book / "runs/cookbook.h5", units="D") as run:
        assert run.free.sum() == 384 and run.theta_c > 15
        assert run.analysis["overloaded/fraction"].shape[1] == 2


def test_neighbourhoods_of_the_recipe_are_those_of_the_analysis(book):
    """At the scale of talus analyze, the function of the page gives the same gamma."""
    code = make.recipes()["neighbourhoods"]
    names = {}
    exec(code[: code.index("\nrun = ")].replace("import matplotlib.pyplot as plt", "").replace(
        "from matplotlib.collections import EllipseCollection", ""), names)
    with talus.open(book / "runs/cookbook.h5") as run:
        for frame in run.frames[::20]:
            gamma = names["neighbourhood_ratio"](frame, 3 * run.D)
            gamma = gamma[~np.isnan(gamma)]
            k = frame.index
            assert gamma.mean() == pytest.approx(run.analysis["gamma/mean"][k], rel=1e-5)
            for threshold, share in zip(run.analysis["threshold"], run.analysis["overloaded/fraction"][k]):
                assert np.mean(gamma >= threshold) == pytest.approx(share, abs=1.5 / len(gamma))


def test_exported_table_has_a_row_for_each_grain(drawn, book):
    pytest.importorskip("pandas", reason="pandas is not installed: python3-pandas")
    drawn("contacts-and-gamma")
    with (book / "grains.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    with talus.open(book / "runs/cookbook.h5", units="D") as run:
        assert len(rows) == len(run.id) and [int(row["id"]) for row in rows] == list(run.id)
        ends = np.bincount(run.frame_at(10).contacts.pair.ravel(), minlength=len(rows))
        assert [int(row["z"]) for row in rows] == list(ends)
