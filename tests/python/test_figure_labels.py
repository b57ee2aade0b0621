"""No text of a figure is clipped or overlaps another, for any bed, numbers and names. Figures are plain
data: those of small runs are redrawn with other sizes, numbers and names, and the ink of their texts is
measured."""

import csv
import json
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

pytest.importorskip("fitz", reason="PyMuPDF is not installed: python3-fitz")
if shutil.which("gnuplot") is None:
    pytest.skip("gnuplot is not installed: gnuplot-nox", allow_module_level=True)

import figure_ink  # noqa: E402
from conftest import ROOT, run_talus  # noqa: E402

WIDTHS = {1: 8.6, 2: 17.8}  # cm
LONG_NAME = (
    "PBC, L = 2500 D, deposition.method = collapse, contact.friction = 0.35, deposition.arrival_speed = 12, "
    "a-folder-with-a-very-long-name-in-which-there-is-no-blank-to-break-it-at-anywhere-at-all (100 runs)"
)
#: Variables of a script with one value per group, by the beginnings of their names.
OF_GROUPS = re.compile(
    r"(data|label|every|runs|drawn|cut|several|gamma_c|theta_d|sizes|waits|size_law|wait_law|line"
    r"|summary_\d+|mean_\d+|r_\d+_\d+)_1"
)
#: Columns that are not quantities: the horizontal axis is not changed either, except for angles.
COUNTS = "n|seed|cycle|estimator|factor|series|row|agrees|group|critical|radius|x|y"
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


def changed_table(path, units, bed):
    """Returns the text of a table with other numbers, and about 20 rows."""
    rows = list(csv.reader(path.read_text().splitlines()))
    head, body = rows[0], rows[1:]
    keep = max(1, len(body) // 20)

    def changed(name, cell):
        value = float(cell)
        unit = units.get(name, "1")
        if name in ANGLES:
            value *= bed.get("angles", 1)
        elif name in ("x1", "x2") or (name == "x" and "surface" in path.name):
            value *= bed["length"] / bed["length_before"]
        elif name in ("y1", "y2") or (name == "y" and "surface" in path.name):
            value *= bed["depth"] / bed["depth_before"]
        elif unit != "deg" and name != head[0] and not re.fullmatch(COUNTS, name):
            value *= bed.get("times", 1)
            if not name.endswith(("_error", "_deviation")):
                value += bed.get("plus", 0)
        return repr(value) if value == value else "NaN"

    lines = [",".join(head)]
    for k, row in enumerate(body):
        if k % keep == 0:
            lines.append(",".join(changed(name, cell) for name, cell in zip(head, row)) if row else "")
    return "\n".join(lines) + "\n"


def changed_script(text, bed):
    """Returns the script with another width, bed and names, which draws the PDF and the SVG."""
    head, _, rest = text.partition("# Common part of all figures")
    variables = dict(line.split(" = ", 1) for line in head.splitlines() if " = " in line and not line.startswith("#"))
    number = {name: float(value) for name, value in variables.items() if re.fullmatch(r"-?[0-9.]+(e[-+]?\d+)?", value)}
    width, before = WIDTHS[bed["columns"]], float(variables["width"].split()[0])
    variables["height"] = f"{number['height'] / before * width:g}"
    variables["width"] = f"{width}"
    bed["length_before"], bed["depth_before"] = number.get("bed_length", 1), number.get("bed_top", 1)
    if "bed_length" in variables:
        variables["bed_length"] = f"{bed['length']}"
    if "aspect" in variables:
        variables["aspect"] = f"{bed['length'] / bed['depth']:g}"
    if number.get("map_height"):
        margin = 0.01 * bed["length"]
        variables.update(margin=f"{margin:g}", bed_top=f"{bed['depth']}")
        variables["map_height"] = f"{(bed['depth'] - number['bed_bottom'] + margin) / (bed['length'] + 2 * margin):g}"
    if "theta_max" in number:
        variables["theta_max"] = f"{number['theta_max'] * bed.get('angles', 1):g}"
    for name in ("energy_from", "energy_to", "largest_change"):
        if name in number:
            variables[name] = f"{abs(number[name] * bed.get('times', 1)):g}"
    if "groups" in bed and "groups" in variables:
        for name in [name for name in variables if OF_GROUPS.fullmatch(name)]:
            for g in range(2, bed["groups"] + 1):
                variables.setdefault(name[:-1] + str(g), variables[name])
        if "line_1" in variables:
            variables.update({f"line_{g}": f"{g}" for g in range(1, bed["groups"] + 1)}, lines=str(bed["groups"]))
        variables["groups"] = str(bed["groups"])
    if "name" in bed:
        for name in variables:
            if re.fullmatch(r"label_\d+|label|bed", name):
                variables[name] = "'" + bed["name"].replace("_", r"\_") + "'"
    last = re.sub(r"if \(pass <= 3\)", "if (pass <= 2)", rest)
    return "".join(f"{name} = {value}\n" for name, value in variables.items()) + "# Common part of all figures" + last


def faults_of(figures, folder, bed):
    """Redraws all figures of a folder in another one, and lists the faults of their texts."""
    found = []
    for script in sorted(figures.glob("*.gp")):
        tables = json.loads((figures / (script.stem + ".json")).read_text())["tables"]
        units = {table["file"]: {column["name"]: column["unit"] for column in table["columns"]} for table in tables}
        (folder / script.name).write_text(changed_script(script.read_text(), bed))
        for table in units:
            (folder / table).write_text(changed_table(figures / table, units[table], bed))
        done = subprocess.run(["gnuplot", "-d", script.name], cwd=folder, capture_output=True, text=True)
        if done.returncode != 0:
            found.append(f"{script.stem}: gnuplot gave up: {done.stderr[-300:]}")
            continue
        texts = figure_ink.faults(folder / (script.stem + ".pdf"), folder / (script.stem + ".svg"))
        found += [f"{script.stem}: {text}" for text in texts]
    return found


def put_stand_in_for_gnuplot(folder):
    """Creates a program in `folder` that leaves the same small picture for every script: only data and
    scripts of the figures are needed, and each is redrawn for each bed."""
    kinds = (("pdf", "pdfcairo"), ("svg", "svg"), ("png", "pngcairo"))
    lines = [f'set terminal {terminal}; set output "empty.{ending}"; plot 0; unset output' for ending, terminal in kinds]
    (folder / "empty.gp").write_text("\n".join(lines))
    subprocess.run(["gnuplot", "-d", "empty.gp"], cwd=folder, check=True)
    copies = "\n".join(f'cp "{folder}/empty.{ending}" "${{2%.gp}}.{ending}"' for ending, _ in kinds)
    program = folder / "gnuplot"
    program.write_text(f'#!/bin/sh\n[ "$1" = --version ] && exit 0\n{copies}\n')
    program.chmod(0o755)


def draw(folder, runs, only, *more):
    """Makes figures in folder/figures."""
    words = ["figures", *runs, "--only", only, *more, "-q", "--overwrite", "-o", "figures"]
    if not (folder / "gnuplot").exists():
        put_stand_in_for_gnuplot(folder)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PATH", f"{folder}:{os.environ['PATH']}")
        run_talus(*words, folder=folder)
    return folder / "figures"


@pytest.fixture(scope="session")
def figures_of_a_bed(analysed, tmp_path_factory):
    """Tests some figures of each kind: panels, grains, lines between grains, curves."""
    only = "over-tilt,fig11,fig12,force-chains,force-distribution"
    return draw(tmp_path_factory.mktemp("some"), [analysed], only)


@pytest.mark.parametrize("name", ["small numbers, deep and short", "many groups in one column"])
def test_texts_of_some_figures_are_whole(figures_of_a_bed, tmp_path, name):
    assert faults_of(figures_of_a_bed, tmp_path, dict(BEDS[name])) == []


def test_a_figure_of_very_many_groups_is_drawn(figures_of_a_bed, tmp_path):
    """As for an ensemble of 8 x 8 values: its key is long and may be crowded."""
    one = tmp_path / "one"
    one.mkdir()
    for file in figures_of_a_bed.glob("fig12*"):
        (one / file.name).write_bytes(file.read_bytes())
    found = faults_of(one, tmp_path, dict(columns=2, length=100, depth=20, groups=64))
    assert not [text for text in found if "gave up" in text]


@pytest.mark.chosen
def test_ink_is_found(tmp_path):
    """Texts that are clipped, leave the page, overlap or are crossed are found, also vertical ones."""
    lines = [
        'set encoding utf8; set terminal pdfcairo size 8cm,6cm font "DejaVu Sans,8" fontscale 0.75; set output "a.pdf"',
        "set lmargin at screen 0.2; set rmargin at screen 0.9; set bmargin at screen 0.5; set tmargin at screen 0.9",
        'set label "1.5" at screen 0.5, screen 0.2; set label "2.5" at screen 0.53, screen 0.2',
        'set label "uphill" at screen 0.1, screen 0.1 rotate by 90; set label "across" at screen 0.07, screen 0.14',
        'set label "cut off" at screen 0.95, screen 0.3; set label "stem" at screen 0.7, screen 0.95 rotate by 90',
        'set label "framed" at screen 0.17, screen 0.7; set label "alone" at screen 0.3, screen 0.3; set xtics ("" 0)',
        "set ytics (\"\" 0); unset key; plot [0:1] [0:1] x",
    ]
    (tmp_path / "a.gp").write_text("\n".join(lines))
    subprocess.run(["gnuplot", "-d", "a.gp"], cwd=tmp_path, check=True)
    faults = "\n".join(figure_ink.faults(tmp_path / "a.pdf"))
    for part in ("'1.5' meets '2.5'", "meets 'uphill'", "crosses the edge", "'framed' is crossed"):
        assert part in faults, faults
    assert re.search("'ste?m?' crosses the edge", faults), faults
    assert "alone" not in faults


@pytest.fixture(scope="session")
def all_figures(tmp_path_factory):
    """Every figure, drawn from small beds."""
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
    run_talus("events", "grains.h5", "-q", folder=folder)
    draw(folder, ["two"], "angle-distributions,angle-correlations")
    draw(folder, ["walls.h5"], "6,7")
    draw(folder, ["cycles.h5"], "cycles")
    draw(folder, ["flow.h5"], "dynamic-angle")
    draw(folder, ["two"], "4,5,9,12,14,over-tilt,before-failure,precursors,difference-over-tilt,difference-before-failure")
    # A small bed has few overloaded grains; a low threshold gives some in its middle.
    draw(folder, ["grains.h5"], "11", "--set", "gamma_c=0.15")
    of_a_run = "8,10,13,overloaded-over-scale,contact-directions,force-chains,force-distribution,critical-contacts"
    return draw(folder, ["grains.h5"], of_a_run + ",correlations,weak-contacts,persistence,events")


@pytest.mark.parametrize("name", BEDS)
def test_texts_of_all_figures_are_whole(all_figures, tmp_path, name):
    catalogue = re.findall(r"^\| `([\w-]+)` \|", (ROOT / "docs/figures.md").read_text(), re.M)
    assert {provenance.stem for provenance in all_figures.glob("*.json")} == set(catalogue)
    assert faults_of(all_figures, tmp_path, dict(BEDS[name])) == []
