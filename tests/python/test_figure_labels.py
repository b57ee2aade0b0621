"""No text of a figure is clipped or overlaps another, for any bed, numbers and names. Figures are drawn from plain data:
those of small runs are drawn with other sizes, numbers and names, and the ink of their texts is measured."""

import copy
import re

import pytest

pytest.importorskip("fitz", reason="PyMuPDF is not installed: python3-fitz")
pytest.importorskip("matplotlib", reason="matplotlib is not installed: python3-matplotlib")

import figure_ink  # noqa: E402
from conftest import ROOT, run_talus  # noqa: E402
from talus.figures.catalogue import CATALOGUE, find  # noqa: E402
from talus.figures.data import Wanted  # noqa: E402
from talus.figures.groups import read_groups  # noqa: E402
from talus.figures.panels import Page  # noqa: E402
from talus.figures.style import new_figure, styled, write  # noqa: E402

WIDTHS = {1: 8.6, 2: 17.8}  # cm
LONG_NAME = (
    "PBC, L = 2500 D, deposition.method = collapse, contact.friction = 0.35, deposition.arrival_speed = 12, "
    "a-folder-with-a-very-long-name-in-which-there-is-no-blank-to-break-it-at-anywhere-at-all (100 runs)"
)
#: Columns that are not quantities: the horizontal axis is not changed either, except for angles.
COUNTS = "n|seed|second|cycle|estimator|factor|critical|radius|x|y|contact.friction|bed.depth|share.*"
ANGLES = {"theta", "angle_left"}
#: Differences between a tested bed and the computed one.
BEDS = {
    "small numbers, deep and short": dict(columns=1, length=10, depth=60, times=1e-12),
    "large numbers, shallow and short": dict(columns=2, length=10, depth=3, times=1e12, name=LONG_NAME),
    "long names in one column": dict(columns=1, length=60, depth=30, name=LONG_NAME),
    "tiny strains and tilts": dict(columns=2, length=60, depth=30, times=1.7e-5, angles=1e-4),
    "very long bed in one column": dict(columns=1, length=2500, depth=3, times=3e12, name=LONG_NAME, angles=1e-3),
    "very long and deep bed": dict(columns=2, length=2500, depth=60, times=1e-9),
    "many groups, numbers nearly alike": dict(columns=2, length=100, depth=20, times=1e-4, plus=1000, groups=6),
    "many groups in one column": dict(columns=1, length=100, depth=20, name=LONG_NAME, groups=5),
}


def change_table(table, bed, scale):
    """Gives a table other numbers, and about 20 rows. `scale`: of lengths along and across the bed."""
    keep = max(1, len(table) // 20)
    for each in table.columns:
        if each.name in ANGLES:
            each.values = each.values * bed.get("angles", 1)
        elif each.name in ("x1", "x2") or (each.name == "x" and table.name == "surface"):
            each.values = each.values * scale[0]
        elif each.name in ("y1", "y2") or (each.name == "y" and table.name == "surface"):
            each.values = each.values * scale[1]
        elif each.unit != "deg" and each is not table.columns[0] and not re.fullmatch(COUNTS, each.name):
            plus = 0 if each.name.endswith(("_error", "_deviation")) else bed.get("plus", 0)
            each.values = each.values * bed.get("times", 1) + plus
        each.values = each.values[::keep]


def changed(data, bed):
    """Returns the data of a figure with another bed, numbers and names."""
    runs, data.runs = data.runs, []
    other = copy.deepcopy(data)
    data.runs = other.runs = runs
    facts = other.facts
    scale = (1, 1)
    if "top" in facts:
        scale = bed["length"] / facts["length"], bed["depth"] / facts["top"]
        facts |= {"length": bed["length"], "top": bed["depth"]}
    for table in {id(table): table for table in other.tables}.values():
        change_table(table, bed, scale)
    if bed.get("groups") and other.groups:
        other.groups = [other.groups[k % len(other.groups)] for k in range(bed["groups"])]
        other.groups = [copy.copy(group) for group in other.groups]
        for table in facts.get("bins", []):
            table.columns += [copy.copy(table.columns[2]) for _ in range(bed["groups"])]
            for k, each in enumerate(table.columns[2:], 1):
                each.name = f"share_{k}"
        if "coefficients" in facts:
            first = facts["coefficients"].columns[2]
            for k in range(1, bed["groups"] + 1):
                facts["coefficients"].columns.append(copy.copy(first))
                facts["coefficients"].columns[-1].name = f"r_{k}"
    if "name" in bed:
        for group in other.groups:
            group.legend = bed["name"]
        if "bed" in facts:
            facts["bed"] = bed["name"]
    return other


def faults_of(figures, folder, bed):
    """Draws all figures with another bed, and lists the faults of their texts."""
    found = []
    for recipe, data in figures:
        if recipe.write is not None:
            continue  # panels of the renderer have tests of their own
        path = folder / f"{recipe.name}.pdf"
        with styled():
            figure = recipe.draw(changed(data, bed), Page(WIDTHS[bed["columns"]]))
        write(figure, [path], recipe.title)
        found += [f"{recipe.name}: {text}" for text in figure_ink.faults(path)]
    return found


def made(groups, only="", **wanted):
    """Returns figures, named by their numbers or names, with their data."""
    recipes = [find(word) for word in only.split(",")] if only else CATALOGUE
    found = [(recipe, recipe.data(groups, Wanted(**wanted))) for recipe in recipes]
    assert all(data is not None for _, data in found), [recipe.name for recipe, data in found if data is None]
    return found


@pytest.fixture(scope="session")
def figures_of_a_bed(analysed):
    """Tests some figures of each kind: panels, lines between grains, curves."""
    return made(read_groups(analysed), "over-tilt,fig12,force-chains,force-distribution", paper=True)


@pytest.mark.parametrize("name", ["small numbers, deep and short", "many groups in one column"])
def test_texts_of_some_figures_are_whole(figures_of_a_bed, tmp_path, name):
    assert faults_of(figures_of_a_bed, tmp_path, BEDS[name]) == []


def test_a_figure_of_very_many_groups_is_drawn(figures_of_a_bed, tmp_path):
    """As for an ensemble of 8 x 8 values."""
    few = [(recipe, data) for recipe, data in figures_of_a_bed if recipe.name.startswith("fig12")]
    assert faults_of(few, tmp_path, dict(columns=2, length=100, depth=20, groups=64)) == []


@pytest.mark.chosen
def test_ink_is_found(tmp_path):
    """Texts that are clipped, leave the page, overlap or are crossed are found, also vertical ones."""
    with styled():
        figure = new_figure(8, 6)
        axes = figure.add_axes((0.2, 0.5, 0.7, 0.4), xticks=[], yticks=[])
        axes.plot([0, 1], [0, 1])
        for x, y, text, angle in ((0.5, 0.2, "1.5", 0), (0.53, 0.2, "2.5", 0), (0.1, 0.1, "uphill", 90), (0.07, 0.14, "across", 0),
                                  (0.95, 0.3, "cut off", 0), (0.7, 0.95, "stem", 90), (0.17, 0.7, "framed", 0), (0.3, 0.3, "alone", 0)):
            figure.text(x, y, text, rotation=angle)
    write(figure, [tmp_path / "a.pdf"], "ink")
    faults = "\n".join(figure_ink.faults(tmp_path / "a.pdf"))
    for part in ("'1.5' meets '2.5'", "meets 'uphill'", "crosses the edge", "'framed' is crossed"):
        assert part in faults, faults
    assert re.search("'ste?m?' crosses the edge", faults), faults
    assert "alone" not in faults


@pytest.fixture(scope="session")
def all_figures(tmp_path_factory):
    """Every figure, from small beds."""
    folder = tmp_path_factory.mktemp("all")
    (folder / "bed.toml").write_text(
        "[bed]\nlength = 15\ndepth = 6\n[tilt]\nrate = 10\nstep = 0.01\n[output]\nframe_every = 1\n"
    )

    def run(name, *settings):
        run_talus("run", "bed.toml", "-q", "-o", name, *[word for key in settings for word in ("--set", key)], folder=folder)

    run("grains.h5", "seed=3")
    run("walls.h5", "bed.boundary=walls")
    run("cycles.h5", "tilt.program=to 6, to 0, 3 times")
    run("flow.h5", "tilt.after_failure=lower", "output.frame_every=10")
    two = ["--seeds", "1-5", "--vary", "deposition.method=pour,collapse", "-o", "two"]
    run_talus("ensemble", "bed.toml", *two, folder=folder)
    of_two = "4,5,9,12,14,over-tilt,before-failure,precursors,difference-over-tilt,difference-before-failure,over-parameter"
    grains = "8,10,13,overloaded-over-scale,contact-directions,force-chains,force-distribution,critical-contacts"
    found = made(read_groups(folder / "two"), of_two + ",angle-distributions,angle-correlations", paper=True)
    found += made(read_groups(folder / "walls.h5"), "6,7", paper=True)
    found += made(read_groups(folder / "cycles.h5"), "cycles")
    found += made(read_groups(folder / "flow.h5"), "dynamic-angle")
    found += made(read_groups(folder / "grains.h5"), grains + ",correlations,weak-contacts,persistence,events", paper=True)
    # A small bed has few overloaded grains; a low threshold gives some in its middle.
    return found + made(read_groups(folder / "grains.h5", ["gamma_c=0.15"]), "11")


@pytest.mark.parametrize("name", BEDS)
def test_texts_of_all_figures_are_whole(all_figures, tmp_path, name):
    catalogue = re.findall(r"^\| `([\w-]+)` \|", (ROOT / "docs/figures.md").read_text(), re.M)
    assert {recipe.name for recipe, _ in all_figures} == {recipe.name for recipe in CATALOGUE} == set(catalogue)
    assert faults_of(all_figures, tmp_path, BEDS[name]) == []
