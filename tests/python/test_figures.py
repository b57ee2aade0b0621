"""Figures in Python: their numbers against stored tables, the same bytes for the same data, their arguments and messages."""

import copy
import csv
import json
import os
import shutil
import subprocess
import sys
import threading
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip("matplotlib", reason="matplotlib is not installed: python3-matplotlib")

import talus  # noqa: E402
from conftest import BED, run_talus  # noqa: E402
from talus import figures  # noqa: E402
from talus.figures import means  # noqa: E402
from talus.figures.catalogue import CATALOGUE, find  # noqa: E402
from talus.figures.command import parse_size  # noqa: E402
from talus.figures.data import Wanted, rounded, shows_paper  # noqa: E402
from talus.figures.files import figure_files, table_file  # noqa: E402
from talus.figures.tables import Table, column, csv_text, short_text  # noqa: E402

SETS = {"two": "two", "walls": "walls", "flow": "flow.h5", "cycles": "cycles.h5"}


@pytest.fixture(scope="session")
def beds(tmp_path_factory):
    """Returns a folder with two ensembles, of two frictions and of two lengths between walls, a flow and cycles."""
    folder = tmp_path_factory.mktemp("beds")
    (folder / "bed.toml").write_text(BED.replace("frame_every = 0.5", "frame_every = 2\nobservable_every = 0.2"))
    walls = ["--set", "bed.boundary=walls", "--vary", "bed.length=12,15"]
    run_talus("ensemble", "bed.toml", "--seeds", "1-3", "--vary", "contact.friction=0.3,0.5", "-o", "two", folder=folder)
    run_talus("ensemble", "bed.toml", "--seeds", "1-2", *walls, "-o", "walls", folder=folder)
    flow = ["--set", "tilt.after_failure=lower", "--set", "tilt.lowering_rate=2"]
    run_talus("run", "bed.toml", "-q", *flow, "-o", "flow.h5", folder=folder)
    run_talus("run", "bed.toml", "-q", "--set", "tilt.program=to 6, to 0, 2 times, to repose", "-o", "cycles.h5", folder=folder)
    return folder


@pytest.fixture(scope="session")
def groups(beds):
    return {name: figures.read_groups(beds / path) for name, path in SETS.items()}


def stored_tables():
    """Returns the tables that the previous program made of these runs, up to 12 digits: those in figure_tables.txt, by the set
    of runs and the name of the file, with their number of rows."""
    tables = {}
    for line in (Path(__file__).parent / "figure_tables.txt").read_text().splitlines():
        if line.startswith("# "):
            _, name, file, rows = line.split()
            tables[name, file, int(rows)] = []
        else:
            tables[list(tables)[-1]].append(line)
    return tables


@pytest.mark.parametrize("name, file, rows", stored_tables())
def test_numbers_are_those_of_the_stored_tables(groups, name, file, rows):
    recipe = next(recipe for recipe in CATALOGUE if file.startswith(recipe.name))
    data = recipe.data(groups[name], Wanted())
    table = next(table for table in data.tables if table_file(recipe, table) == file + ".csv")
    head, *expected = csv.reader(stored_tables()[name, file, rows])
    assert [each.name for each in table.columns] == head
    assert len(table) == rows
    found = np.array([each.values for each in table.columns]).T[: len(expected)]
    np.testing.assert_allclose(found, np.array(expected, dtype=float), rtol=1e-9, atol=1e-9)


def test_the_same_runs_give_the_same_bytes(beds, tmp_path):
    for folder in ("one", "two"):
        done = run_figures(beds, "flow.h5", "-o", tmp_path / folder, "--only", "4,10,11,force-chains,events", "--add", "svg", "-q")
        assert done is None
    names = sorted(path.name for path in (tmp_path / "one").iterdir() if path.suffix != ".json")
    assert {Path(name).suffix for name in names} == {".csv", ".pdf", ".png", ".svg"}
    for name in names:
        assert (tmp_path / "one" / name).read_bytes() == (tmp_path / "two" / name).read_bytes(), name


def run_figures(folder, *words):
    """Carries out `talus figures` in this process."""
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        return figures.main([str(word) for word in words])


def test_files_have_their_data_and_their_sources(beds, tmp_path):
    run_figures(beds, "two", "-o", tmp_path, "--only", "fig9", "-q", "--add", "paper", "--set", "lc_cut=5")
    provenance = json.loads((tmp_path / "fig09-overloaded-fraction.json").read_text())
    assert provenance["command"].startswith("talus figures two -o ")
    assert {float(run["analysis"]["lc_cut"]) for run in provenance["runs"]} == {5}
    assert len(provenance["runs"]) == 6
    files = {table["file"] for table in provenance["tables"]}
    assert files == {path.name for path in tmp_path.glob("*.csv")} and "fig09-overloaded-fraction-paper.csv" in files
    assert b"/Type /Font" in (tmp_path / "fig09-overloaded-fraction.pdf").read_bytes()


def test_existing_files_are_kept(beds, tmp_path):
    run_figures(beds, "flow.h5", "-o", tmp_path, "--only", "4", "-q")
    provenance = tmp_path / "fig04-shear-stress.json"
    provenance.write_text("mine")
    with pytest.raises(talus.Error, match="exists; give --overwrite") as refused:
        run_figures(beds, "flow.h5", "-o", tmp_path, "--only", "4", "-q")
    assert refused.value.exit_code == 73 and provenance.read_text() == "mine"
    command = [sys.executable, "-m", "talus.figures", "flow.h5", "-o", tmp_path, "--only", "4", "-q"]
    refused = subprocess.run(command, cwd=beds, capture_output=True, text=True)
    assert refused.returncode == 73 and refused.stderr.startswith("talus: error: ")
    done = subprocess.run([*command, "--overwrite"], cwd=beds, check=True, capture_output=True, text=True)
    assert done.stdout == done.stderr == "" and provenance.read_text() != "mine"
    assert not list(tmp_path.glob("*.part"))


@pytest.mark.parametrize("words, code, message", [
    (["--only", "fig09-overloaded-friction"], 64, "did you mean 'fig09-overloaded-fraction'"),
    (["--only", "3"], 64, "--only 3: no such figure"),
    (["--only", "5", "--at", "1"], 64, "--at: no requested figure shows single frames"),
    (["--only", "8", "--at", "80"], 65, "--at 80: no run of .* has such a frame"),
    (["--only", "6"], 65, "no figure can be made of these runs"),
    (["--size", "3cm"], 64, "expected a width from 8 to 60 cm"),
    (["--size", "8.6"], 64, "such as 8.6cm"),
    (["--size", "12x6x"], 64, "expected a width"),
    (["--set", "nothing=1"], 65, "nothing"),
    (["-o", "x.pdf"], 64, "x.pdf: expected a folder"),
    (["--add", "papers"], 64, "--add papers: expected one of paper, spread, svg")])
def test_requests_are_refused(beds, tmp_path, words, code, message):
    with pytest.raises(talus.Error, match=message) as refused:
        run_figures(beds, "flow.h5", "-o", tmp_path / "out", "-q", *words)
    assert refused.value.exit_code == code
    assert not (tmp_path / "out").exists()


def test_the_error_of_a_process_is_told_while_others_end(tmp_path):
    """A process that is stopped writes into no pipe of the one that stops it."""
    (tmp_path / "example.py").write_text("""
import time
from talus import Error
from talus.figures.command import in_processes
from talus.start import stop_on_signals

def fail():
    time.sleep(0.5)
    raise Error("the disk is full")

def work():
    try:
        time.sleep(30)
    finally:
        time.sleep(1)

stop_on_signals()
try:
    in_processes([fail, work], 2, lambda done, count: None)
except Error as error:
    print(error)
""")
    done = subprocess.run([sys.executable, tmp_path / "example.py"], capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (0, "the disk is full\n", "")


def test_sizes():
    assert parse_size("") == (0, 0) and parse_size("8.6cm") == (8.6, 0) and parse_size("17.8x10cm") == (17.8, 10)


def test_groups_are_named_by_what_differs(groups):
    assert [group.label for group in groups["two"]] == ["PBC, L = 15 D, contact.friction = 0.3", "PBC, L = 15 D, contact.friction = 0.5"]
    assert [group.legend for group in groups["two"]] == ["μ = 0.3", "μ = 0.5"]
    assert [group.label for group in groups["walls"]] == ["WBC, L = 12 D", "WBC, L = 15 D"]
    assert groups["flow"][0].legend == "PBC, L = 15 D"
    with pytest.raises(talus.Error, match="are the same run"):
        figures.group_runs(groups["flow"][0].runs * 2)


def made_up(path="a/1.h5", seed=1, state="", commands=(), own=(), departures=(), **keys):
    """Returns a run of which only the description is known. `commands`: texts of those of its scenario."""
    sections = {"bed": {"boundary": "periodic", "length": 12.0}, "contact": {"friction": 0.5, "wall_friction": 0.5}, "tilt": {"program": "none"},
                "deposition": {"wall_friction": "contact"}}
    for key, value in keys.items():
        section, name = key.split("__")
        sections[section] = sections[section] | {name: value}
    if commands:
        sections["command"] = [{"kind": text.split()[0], "text": text} for text in commands]
    bed = sections["bed"]
    return SimpleNamespace(path=path, seed=seed, state_hash=state or f"{path} {seed}", has_file=True, scenario=sections, length=bed["length"],
                           periodic=bed["boundary"] == "periodic", departures=list(departures),
                           core=SimpleNamespace(commands=list(commands), own_commands=list(own)))


PUSH, RUB, TILT, TILT_BACK = "push grain 3 by (1, 0) m/s at 2 deg", "friction 0.3 at 5 deg", "tilt rate 1 deg/s at 8 deg", "tilt rate -1 deg/s at 8 deg"
GIVEN, GIVEN_BACK = "tilt rate 1 deg/s at 8.00 deg, 9.00 s", "tilt rate -1 deg/s at 8.00 deg, 9.00 s"
WALLS = {"bed__boundary": "walls"}


@pytest.mark.parametrize("runs, legends", [
    ([dict(commands=[RUB, TILT]), dict(commands=[RUB, TILT_BACK])], ["tilt rate 1°/s at 8°", "tilt rate −1°/s at 8°"]),
    ([dict(), dict(commands=[RUB]), dict(commands=[RUB, TILT])], ["no command", "friction 0.3 at 5°", "friction 0.3 at 5°, tilt rate 1°/s at 8°"]),
    ([dict(commands=[RUB]), dict(commands=[RUB, TILT])], ["no command 2", "tilt rate 1°/s at 8°"]),
    ([dict(departures=[PUSH, GIVEN]), dict(departures=[PUSH, GIVEN_BACK])],
     ["push grain 3 by (1, 0) m/s at 2°; tilt rate 1°/s at 8°", "push grain 3 by (1, 0) m/s at 2°; tilt rate −1°/s at 8°"]),
    ([dict(departures=[PUSH, "release", GIVEN]), dict(departures=[PUSH, "release", GIVEN_BACK])],
     ["push grain 3 by (1, 0) m/s at 2°; tilt rate 1°/s at 8° and 1 more", "push grain 3 by (1, 0) m/s at 2°; tilt rate −1°/s at 8° and 1 more"]),
    ([dict(), dict(departures=[GIVEN]), dict(commands=[RUB], departures=[GIVEN])],
     ["no command", "tilt rate 1°/s at 8°", "friction 0.3 at 5°, tilt rate 1°/s at 8°"]),
    ([dict(), dict(departures=["computed by version 0.0.9"])], ["PBC, L = 12 D", "computed by version 0.0.9"]),
    ([dict(), dict(departures=["branch at 5.00 deg with a tilt rate of -1 deg/s"])], ["PBC, L = 12 D", "branch at 5° with a tilt rate of −1°/s"]),
    ([dict(tilt__program="to 6, to 0"), dict(tilt__program="to -6, to 0")], ["tilt.program = to 6, to 0", "tilt.program = to -6, to 0"]),
    ([dict(commands=[RUB]), dict(**WALLS), dict(contact__wall_friction=0.2, **WALLS)],
     ["PBC, L = 12 D, friction 0.3 at 5°", "WBC, L = 12 D, μ_w = 0.5, no command", "WBC, L = 12 D, μ_w = 0.2, no command"]),
    ([dict(path="a/1.h5"), dict(path="a/2.h5")], ["PBC, L = 12 D, 1.h5", "PBC, L = 12 D, 2.h5"]),
    ([dict(path="a$b$_c/1.h5"), dict(path="a/1.h5")], [r"PBC, L = 12 D, a\$b\$_c", "PBC, L = 12 D, a"]),
    ([dict(own=[(2, -1, 0.30001, 0.0)], departures=["friction 0.3"], path="a/1.h5"), dict(own=[(2, -1, 0.30002, 0.0)], departures=["friction 0.3"], path="a/2.h5")],
     ["PBC, L = 12 D, friction 0.3, 1.h5", "PBC, L = 12 D, friction 0.3, 2.h5"])])
def test_runs_that_differ_are_groups_of_their_own_with_names_of_their_own(runs, legends):
    groups = figures.group_runs(made_up(**run) for run in runs)
    assert [group.legend for group in groups] == legends
    assert len({group.label for group in groups}) == len({group.name for group in groups}) == len(runs)


def test_runs_of_two_folders_that_differ_in_their_bits_are_not_mixed():
    runs = [made_up(f"{folder}/{seed}.h5", seed) for folder, seeds in (("a", (1, 2, 3)), ("b", (1, 2, 3, 4, 5))) for seed in seeds]
    groups = figures.group_runs(runs)
    assert [(group.label, [run.path for run in group.runs]) for group in groups] == [
        ("PBC, L = 12 D, a", ["a/1.h5", "a/2.h5", "a/3.h5"]), ("PBC, L = 12 D, b", [f"b/{seed}.h5" for seed in (1, 2, 3, 4, 5)])]


def test_tables_of_groups_have_names_of_their_own(groups):
    runs = groups["two"][0].runs
    data = find("5").data([figures.Group(label, runs) for label in ("a b", "a-b", "日本", "paper", "Paper", "x" * 300, "a-b-runs")], Wanted(paper=True))
    names = [table.name for table in data.tables]
    assert len(set(names)) == len(names) == 14 and "" not in names and "paper" not in names
    assert max(map(len, names)) < 150


def test_walls_of_other_friction_have_a_law_of_their_own(beds, groups):
    one = find("7").data(groups["walls"], Wanted())
    assert "series" not in one.tables[0] and "fitted to all runs by least squares" in one.caption
    others = [copy.copy(run) for group in groups["walls"] for run in group.runs]
    for run in others:
        run.scenario = {**run.scenario, "contact": {**run.scenario["contact"], "wall_friction": 0.25}}
    two = find("7").data(figures.group_runs([run for group in groups["walls"] for run in group.runs] + others), Wanted())
    assert two.tables[0]["series"].tolist() == [1, 1, 2, 2] and [each.name for each in two.facts["series"]] == ["μ_w = 0.5", "μ_w = 0.25"]
    assert [each.fit for each in two.facts["series"]] == [one.facts["series"][0].fit] * 2
    texts = figures.fig07(figures.group_runs(others)).talus_legend.get_texts()
    assert texts[0].get_text() == "beds between walls"


def test_what_follows_a_failure_makes_no_other_bed(groups):
    """The ratio between walls counts a bed once."""
    runs = [run for group in groups["walls"] for run in group.runs]
    held = [copy.copy(run) for run in runs]
    for run in held:
        run.state_hash += "flow"
        run.scenario = {**run.scenario, "tilt": {**run.scenario["tilt"], "after_failure": "hold"}}
    one, two = (find("7").data(figures.group_runs(each), Wanted()) for each in (runs, runs + held))
    assert [each.values.tolist() for each in two.tables[0].columns] == [each.values.tolist() for each in one.tables[0].columns]
    assert two.facts["series"][0].fit == one.facts["series"][0].fit


def test_sections_are_shown_from_the_upper_wall(groups):
    run = copy.copy(groups["walls"][0].runs[0])
    table = find("6").data([figures.Group("forwards", [run])], Wanted()).tables[0]
    run.rise = (*run.rise[:2], True)
    mirrored = find("6").data([figures.Group("backwards", [run])], Wanted()).tables[0]
    assert mirrored["x"].tolist() == table["x"].tolist() and mirrored["sigma_xx_repose"].tolist() == table["sigma_xx_repose"].tolist()[::-1]


def test_a_periodic_bed_has_no_friction_of_walls():
    runs = [made_up(f"{k}/1.h5", state="same", **{f"{section}__wall_friction": 0.1 * k}) for section in ("contact", "deposition") for k in (1, 2)]
    [group] = figures.group_runs(runs)
    assert [run.path for run in group.runs] == ["1/1.h5"], "each bed once"


def test_curves_of_many_groups_differ():
    from talus.figures.style import COLOURS, curve_style

    assert len({str(curve_style(k)) for k in range(64)}) == len({str(curve_style(k, symbols=False)) for k in range(64)}) == 64
    assert [curve_style(k)["color"] for k in range(16)] == [*COLOURS, *COLOURS]


def test_axes_show_negative_values():
    from matplotlib.figure import Figure
    from talus.figures.panels import begin_at_zero

    axes = Figure().add_subplot()
    for values, low in (([0.1, 1], 0), ([-0.01, 1], 0), ([-0.5, 1, np.nan], -0.55), ([], 0)):
        begin_at_zero(axes, np.array(values))
        assert axes.get_ylim()[0] == pytest.approx(low)


@pytest.mark.parametrize("ending", ["pdf", "png", "svg"])
def test_a_full_disk_is_an_error_of_the_system(ending, tmp_path):
    from talus.figures.style import new_figure, styled, write

    with styled():
        figure = new_figure(8, 4)
        figure.add_axes((0, 0, 1, 1)).plot([0, 1])
    (tmp_path / f"a.{ending}").symlink_to("/dev/full")
    with pytest.raises(OSError, match="No space"):
        write(figure, [tmp_path / f"a.{ending}"], "a line")


def test_names_are_no_formulas():
    from talus.figures.panels import broken, text_width
    from talus.figures.style import as_math, new_figure, styled
    from talus.figures.tables import literal

    assert literal("a$b$") == r"a\$b\$" and as_math(r"μ = 1, a\$b") == r"$μ$ = 1, a\$b" and as_math("$x$, μ") == "$x$, μ"
    with styled():
        figure = new_figure(8, 4)
        figure.text(0, 0, literal("a$b$_{")).get_window_extent(figure.canvas.get_renderer())
        assert text_width(figure, literal("a$b$c"), 8) == pytest.approx(text_width(figure, "aSbSc", 8), abs=0.05)
        assert broken(figure, literal("one$two three$four ") * 2 + "$x^2$ y", 8, 3).replace("\n", " ") == (literal("one$two three$four ") * 2 + "$x^2$ y")


def test_a_style_sheet_with_faults_is_reported(beds, tmp_path, capsys):
    (tmp_path / "odd.mplstyle").write_text("axes.lablesize: 9\naxes.titlesize: banana\nfigure.constrained_layout.use: True\nfont.size 8\n")
    run_figures(beds, "flow.h5", "-o", tmp_path / "out", "--only", "4", "-q", "--style", tmp_path / "odd.mplstyle")
    notes = capsys.readouterr().err.splitlines()
    assert len(notes) == 3 and all(note.startswith(f"note: --style {tmp_path}/odd.mplstyle: matplotlib ignores a line: ") for note in notes)
    (tmp_path / "bytes.mplstyle").write_bytes(b"\xff\xfe: 1")
    with pytest.raises(talus.Error, match="is not a style sheet"):
        run_figures(beds, "flow.h5", "-o", tmp_path / "other", "--only", "4", "-q", "--style", tmp_path / "bytes.mplstyle")
    assert not (tmp_path / "other").exists()


def test_names_of_files_may_be_any_bytes(beds, tmp_path):
    folder = os.fsencode(tmp_path) + b"/\xff$a$_1\n\xe6\x97\xa5"
    os.mkdir(folder)
    for name in (b"/a.h5", b"/b.h5"):
        shutil.copy(beds / ("flow.h5" if name == b"/a.h5" else "cycles.h5"), folder + name)
    command = [sys.executable, "-X", "utf8", "-m", "talus.figures", folder + b"/a.h5", folder + b"/b.h5", "-o", folder + b"/out", "--only", "4,10"]
    done = subprocess.run(command, capture_output=True)
    assert done.returncode == 0 and b"Warning" not in done.stderr, done.stderr
    assert folder + b"/out: .pdf" in done.stdout and len(os.listdir(folder + b"/out")) == 9


def test_frames_may_be_those_of_one_of_two_beds(groups):
    runs = sorted((run for group in groups["two"] for run in group.runs), key=lambda run: run.theta_c)
    low, high = figures.Group("low", runs[:1]), figures.Group("high", runs[-1:])
    at = f"{2 * int(runs[-1].theta_c / 2)}"
    assert float(at) > runs[0].theta_c + 1
    for number in ("8", "overloaded-over-scale"):
        data = find(number).data([low, high], Wanted(at=["0", at]))
        assert [name for name, _ in data.facts["shown"]] == ["0", at]
        with pytest.raises(talus.Error, match=f"--at {at}: no run of .* has such a frame"):
            find(number).data([low], Wanted(at=[at]))
    with pytest.raises(talus.Error, match="--at 80: no run has such a frame"):
        find("8").data([low, high], Wanted(at=["80"]))
    early = copy.copy(runs[0])
    early.theta_c = 14.0
    data = find("overloaded-over-scale").data([figures.Group("early", [early])], Wanted())
    assert [name for name, _ in data.facts["shown"]] == ["0", "repose"]


def test_results_over_the_boundary(groups):
    """Only walls have the friction of walls."""
    walls = copy.copy(groups["walls"][0].runs[0])
    walls.scenario = {**groups["two"][0].runs[0].scenario, "bed": {**groups["two"][0].runs[0].scenario["bed"], "boundary": "walls"}}
    data = find("over-parameter").data(figures.group_runs([*groups["two"][0].runs, walls]), Wanted())
    assert data.facts["keys"] == ["bed.boundary", "contact.wall_friction"] and data.facts["texts"][0] == ["periodic", "walls"]


def test_a_figure_takes_axes_a_style_and_own_groups(groups):
    from matplotlib.figure import Figure

    axes = Figure().add_subplot()
    mine = figures.Group("mine", groups["two"][0].runs)
    assert figures.fig04([mine], ax=axes) is axes.figure
    assert axes.get_legend().get_texts()[0].get_text() == "mine (3 runs)"
    assert axes.get_ylabel() == "$σ_T$ / $σ_N$"
    with pytest.raises(ValueError, match="this figure has 20 panels|panels, and needs a figure of its own"):
        figures.over_tilt([mine], ax=axes)
    figure = figures.over_parameter(groups["two"], width=8.6, style={"axes.labelsize": 5, "font.size": 5})
    assert figure.get_size_inches()[0] == pytest.approx(8.6 / 2.54)
    assert figure.axes[-1].xaxis.label.get_fontsize() == 5
    with pytest.raises(talus.Error, match="fig06-wall-stress needs the file of a bed between walls"):
        figures.fig06(groups["two"])
    assert set(figures.recipes()) <= set(dir(figures))


def test_beyond_two_groups_there_are_no_deviations_unless_wanted(groups):
    three = groups["two"] + groups["walls"]
    for wanted, spread in ((Wanted(), False), (Wanted(spread=True), True)):
        data = find("fig05").data(three, wanted)
        assert data.facts["spread"] is spread and ("standard deviation" in data.caption) is spread
    assert find("fig05").data(groups["two"], Wanted()).facts["spread"]


def test_the_paper_is_shown_for_its_beds(groups):
    assert not shows_paper(groups["two"], Wanted()) and shows_paper(groups["two"], Wanted(paper=True))
    files = figure_files(find("12"), find("12").data(groups["two"], Wanted()), ("pdf",))
    assert "fig12-coarse-graining-length-paper.csv" not in files


def test_results_over_two_keys(groups):
    data = find("over-parameter").data(groups["two"], Wanted())
    table = data.tables[0]
    assert [each.name for each in table.columns[:3]] == ["contact.friction", "n", "theta_c"] and table["n"].tolist() == [3, 3]
    angles = [run.theta_c for run in groups["two"][1].runs]
    assert table["theta_c"][1] == pytest.approx(np.mean(angles)) and table["theta_c_error"][1] == pytest.approx(np.std(angles, ddof=1) / 3**0.5)
    assert find("over-parameter").data(groups["flow"], Wanted()) is None


def test_means_end_with_half_of_the_runs():
    curves = [means.RunCurve(np.arange(float(n)), np.array([np.full(n, float(n))])) for n in (2, 3, 5)]
    found = means.means_of(curves)
    assert found.at.tolist() == [0, 1, 2] and found.n.tolist() == [3, 3, 2]
    assert found.mean[0].tolist() == [10 / 3, 10 / 3, 4] and found.deviation[0][2] == pytest.approx(2**0.5)
    at = means.interpolated(np.array([0.0, 2, 4]), np.array([[0.0, 2, np.nan]]), np.array([-1, 0, 1, 2, 3, 5]))
    np.testing.assert_equal(at, [[np.nan, 0, 1, 2, np.nan, np.nan]])


def test_statistics():
    assert means.student_t(1) == 12.706 and means.student_t(30) == 2.042 and means.student_t(60) == pytest.approx(2.0003, abs=1e-4)
    assert means.half_interval(talus.mean_of([1, 2, 3])) == pytest.approx(4.303 / 3**0.5)
    assert means.paired_difference([1.1, 2.1, np.nan], [1, 2, 3])[2:] == (0, 0)
    assert means.correlation_of(np.array([1, 2, 3, np.nan]), np.array([3, 2, 1, 0])) == (pytest.approx(-1), 3)


def test_numbers_are_written_with_all_their_digits():
    numbers = [0.0, -0.0, 0.1, 1 / 3, 1e-5, 12345678.0, 1e22, np.nan, 20.0]
    assert [short_text(number) for number in numbers] == ["0", "-0", "0.1", "0.3333333333333333", "1e-05", "12345678", "1e+22", "NaN", "20"]
    table = Table("", [column("a", "1", "", [1, 1, 2]), column("b", "1", "", [1, 2, 3])], in_blocks=True)
    assert csv_text(table) == "a,b\n1,1\n1,2\n\n2,3\n"
    assert [rounded(21.625), rounded(-0.001), rounded(13.25), rounded(2.5, 0)] == ["21.63", "0", "13.25", "3"]


def test_a_range_of_frames_is_each_of_them():
    from talus.figures.data import single_words

    assert single_words("frame3-frame5") == ["frame3", "frame4", "frame5"]
    assert [single_words(word) for word in ("frame3", "repose", "5", "frame5-frame3")] == [["frame3"], ["repose"], ["5"], ["frame5-frame3"]]


def test_plots_of_the_window_are_figures(tmp_path):
    from talus.figures import plots

    def series(label, x, y):
        return {"label": label, "column": label, "unit": "%", "meaning": f"{label} of the bed", "law": label == "law", "x": x, "y": y}

    plot = {"name": "packing/strain", "title": "Strain ΔV/V (%)", "x_title": "θ (°)", "note": "", "run": "a.h5",
            "logarithmic": False, "falling": True, "range": [0.25, 0.75], "theta_c": 0.5,
            "series": [series("strain", [0, 1], [0, None]), series("law", [0, 1], [0, 1]), series("other", [0, 2], [1, 2])]}
    (tmp_path / "plots.json").write_text(json.dumps([plot]))
    plots.main([str(tmp_path / "plots.json"), str(tmp_path / "out"), "talus view"])
    assert (tmp_path / "out/plot-packing-strain.csv").read_text() == "x,strain,law\n0,0,0\n1,NaN,1\n"
    assert (tmp_path / "out/plot-packing-strain-2.csv").read_text() == "x,other\n0,1\n2,2\n"
    assert {path.suffix for path in (tmp_path / "out").iterdir()} == {".csv", ".json", ".pdf", ".png"}
    with pytest.raises(talus.Error, match="exists"):
        plots.main([str(tmp_path / "plots.json"), str(tmp_path / "out"), "talus view"])


@pytest.mark.chosen
def test_progress_of_an_analysis_is_reported_by_the_calling_thread_alone(copied):
    """The others do not hold the interpreter, and Python 3.13 crashes when they call it."""
    calls = []
    figures.read_runs([copied], ["gamma_c=0.31"], threads=2, progress=lambda *counts: calls.append((threading.get_ident(), *counts)))
    assert {thread for thread, _, _ in calls} == {threading.get_ident()}
    done = [number for _, number, _ in calls]
    assert done == sorted(set(done)) and calls[-1][1] == calls[-1][2]
