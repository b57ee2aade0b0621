"""Studies: their tables against those of a program that made them without this package, and the parts of the tables."""

import csv
import json
import math
import re
import subprocess
import sys

import numpy as np
import pytest
from conftest import BED, ROOT, run_talus

from talus import page, study
from talus.ensemble import mean_of

REFERENCE = ROOT / "tests/python/reference"
#: A slope that fails within a second, with two settings varied one at a time.
WORDS = ("study", "bed.toml", "--seeds", "1-3", "--vary", "contact.friction=0.3", "--vary", "tilt.rate:tilt.step=8:0.008",
         "-o", "study")
VARIANTS = ["baseline", "contact.friction=0.3", "tilt.rate=8,tilt.step=0.008"]


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """Returns a folder with a study."""
    place = tmp_path_factory.mktemp("studied")
    (place / "bed.toml").write_text(BED)
    (place / "printed.md").write_text(run_talus(*WORDS, folder=place))
    return place


def rows_of(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


@pytest.mark.chosen
def test_numbers_and_tables_are_those_of_the_reference(place):
    found, expected = rows_of(place / "study/study.csv"), rows_of(REFERENCE / "study.csv")
    assert len(found) == len(expected) == 9
    for row, known in zip(found, expected):
        for name in ("variation", "seed", "state_hash"):
            assert row[name] == known[name]
        for name in set(known) - {"variation", "state_hash"}:
            assert float(row[name]) == pytest.approx(float(known[name]), rel=1e-9, abs=1e-12), name
    tables = (place / "study/study.md").read_text()
    assert tables.endswith((REFERENCE / "study.md").read_text())
    assert (place / "printed.md").read_text() == tables + "\n"


def test_a_complete_study_gives_the_same_bytes(place):
    files = [place / "study/study.csv", place / "study/study.md"]
    before = [file.read_bytes() for file in files]
    run_talus(*WORDS, folder=place)
    assert [file.read_bytes() for file in files] == before


def test_json_is_what_the_module_reads(place):
    printed = json.loads(run_talus(*WORDS, "--json", "--reference", "10", folder=place))
    found = study.read(place / "study", reference=10, scenario="bed.toml")
    assert printed == json.loads(page.json_text(study.as_json(found)))
    assert list(printed["variations"]) == found.variants == VARIANTS
    assert found.baseline == "contact.friction=0.5,tilt.rate=4,tilt.step=0.004"
    value, difference = found.compare("theta_c_deg", VARIANTS[1])
    assert printed["variations"][VARIANTS[1]]["theta_c_deg"]["difference"] == pytest.approx(difference.mean)
    assert value.mean == pytest.approx(found.values["theta_c_deg"][1].mean())


def test_only_the_named_seeds_and_variations_are_compared(place):
    found = study.read(place / "study", [2, 3], VARIANTS[::2])
    assert found.values["theta_c_deg"].shape == (2, 2) and len(found.runs) == 4
    assert found.reference == 22, "the run that fails at 18.3 deg is not among them"
    assert "contact.friction=0.3" not in study.markdown(found)
    named = study.read(place / "study", scenario="<img src=x>.toml")
    assert study.markdown(named).startswith("# Study of &lt;img src=x>.toml\n"), "text and not HTML"


def test_an_angle_that_no_bed_reaches_and_an_unknown_variation_are_stated(place):
    text = study.markdown(study.read(place / "study", reference=89.0))
    assert "## The bed at 89 deg\n\nNo run has values here.\n\n## The bed at theta_c\n\n| variation" in text
    with pytest.raises(study.Error, match="has no variant 'friction'"):
        study.read(place / "study", variants=["friction"])


def test_a_study_without_a_complete_run_is_refused(place):
    run_talus(*WORDS[:-1], "waiting", "--jobs", "0", folder=place)
    done = subprocess.run([sys.executable, "-m", "talus.study", "waiting"], cwd=place, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (
        65, "talus: error: no run of the study is complete; nothing can be compared\n")
    assert not (place / "waiting/study.csv").exists()


def test_results_are_documented_as_they_are():
    names = re.findall(r"^\| `(\w+)` \|", (ROOT / "docs/study.md").read_text(), re.MULTILINE)
    assert names == [quantity.name for quantity in study.QUANTITIES]


def test_the_reference_angle_is_the_smallest_that_all_beds_reach():
    assert study.common_angle([(16.9, 17.5), (15.3, 16.0)]) == 15
    assert study.common_angle([(math.nan, 3.0000000000000004), (math.nan, 5.0)]) == 3
    assert study.common_angle([(16.9, 17.5), (math.nan, 12.0)]) == 12
    assert study.common_angle([(16.9, 17.5), (math.nan, 60.0)]) == 16


@pytest.mark.parametrize(("differences", "verdict"), [
    ([1.0, 3.5, 4.0], "within error"), ([2.5, 3.5, 4.0], "differs"), ([0.0, 0.0], "within error"), ([5.0], "unknown"), ([], "unknown")])
def test_a_verdict_goes_by_the_interval_of_95_percent(differences, verdict):
    assert study.Comparison(mean_of(differences), mean_of(differences)).verdict == verdict


def test_equal_differences_have_no_error():
    # Fractions of 500 grains: each seed has 20 grains fewer, and each subtraction rounds differently.
    found = study.paired_difference(np.array([0.152, 0.164, 0.236, 0.31]), np.array([0.192, 0.204, 0.276, 0.35]))
    assert found.mean == pytest.approx(-0.04) and found.error == 0
    assert study.Comparison(found, found).verdict == "unknown"
    assert study._difference_cell(study.Comparison(found, found), 1, 4) == "-0.04 ± 0, the same for all seeds: without an error"


def test_cells_count_the_seeds_that_have_a_value():
    assert study._mean_text(mean_of([1.0, 2.0, math.nan]), 1, 3) == "1.50 ± 0.50 (2 seeds)"
    assert study._mean_text(mean_of([2.0]), 100, 1) == "200"
    assert study._mean_text(mean_of([]), 1, 3) == "-"


# Pages


def test_html_escapes_everything_and_marks_cells():
    table = page.Table(["name", "value"], [["p_o | all", page.Cell("0.3", "agrees", "good")], ["", page.Cell("", "not run", "muted")]],
                       frozenset({1}))
    text = page.page("Title & more", "a < b with `x_1 < y`", page.heading(2, "What was run?") + page.heading(3, "Not in it")
                     + page.heading(2, "l_c & theta_d") + page.bullets(["two_2"]) + page.commands(["talus run a.toml"]) + table.html())
    for part in ("<title>Title &amp; more</title>", "<p>a &lt; b with <code>x_1 &lt; y</code></p>", "<li>two_2</li>",
                 "<pre>talus run a.toml\n</pre>", '<th class="number">value</th>', "<td>p_o | all</td>",
                 '<td class="number good">0.3<span class="note">agrees</span></td>',
                 '<td class="number muted"><span class="note">not run</span></td>',
                 '<nav><ol>\n<li><a href="#what-was-run-">What was run?</a></li>\n'
                 '<li><a href="#l-c-theta-d">l_c &amp; theta_d</a></li>\n</ol></nav>',
                 '<h2 id="what-was-run-">', '<h3 id="not-in-it">'):
        assert part in text


def test_a_table_that_is_written_again_keeps_its_mode_and_its_link(tmp_path):
    (tmp_path / "private.csv").write_text("old")
    (tmp_path / "private.csv").chmod(0o600)
    (tmp_path / "study.csv").symlink_to("private.csv")
    page.write_text(tmp_path / "study.csv", "new")
    assert (tmp_path / "study.csv").is_symlink() and (tmp_path / "private.csv").read_text() == "new"
    assert (tmp_path / "private.csv").stat().st_mode & 0o777 == 0o600


def test_a_picture_is_built_into_the_page(tmp_path):
    (tmp_path / "p.png").write_bytes(b"\xff\xfe\xfb")
    assert page.picture(tmp_path / "p.png", 'A "picture"', "Shows it.", True) == (
        '<figure class="wide"><img alt="A &quot;picture&quot;" src="data:image/png;base64,//77">\n'
        "<figcaption><strong>A &quot;picture&quot;.</strong> Shows it.</figcaption></figure>\n")
    with pytest.raises(OSError):
        page.picture(tmp_path / "none.png", "", "", False)


def test_texts_of_a_user_are_no_markup():
    assert page.markdown_escaped("<img src=x>&[a](b)|`c`\n\x1b\udcff") == r"&lt;img src=x>&amp;\[a\](b)\|\`c\` \x1b\xff"
    assert page.csv_quoted('a "b", c') == '"a ""b"", c"'


def test_a_table_of_markdown_is_aligned():
    assert page.Table(["a", "bb"], [["1 ± 2", "3"]]).markdown() == "| a     | bb  |\n|-------|-----|\n| 1 ± 2 | 3   |\n"
