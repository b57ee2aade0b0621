"""Comparison with the paper: values of a run, verdicts, readings and the report, also against those of a program that made
them without this package."""

import csv
import html
import math
import re
from types import SimpleNamespace

import numpy as np
import pytest
from conftest import ROOT

matplotlib = pytest.importorskip("matplotlib", reason="matplotlib is not installed: python3-matplotlib")

from talus import agreement, paper, reproduce  # noqa: E402
from talus.ensemble import Member, mean_of  # noqa: E402
from talus.figures.tables import csv_text  # noqa: E402
from talus.page import plus_minus  # noqa: E402
from talus.paper import CHAIN, PACKING, READINGS, WALLS, Measured, PaperValue, Spread, judge, spread_of  # noqa: E402
from talus.reproduce import Bed, Outcome, Reproduction  # noqa: E402

REFERENCE = ROOT / "tests/python/reference"
NAN = math.nan
SECTIONS = ("agreement", "packing", "overload", "walls", "further")


# Made-up reproductions


def beds_of(depth):
    scale = depth / 40
    return [*(Bed(name, True, 200 * scale, depth, text) for name, text in (
                ("pbc", "poured grains"), ("pbc-geometric", "grains set down geometrically"), ("pbc-collapse", "grains that collapse"))),
            *(Bed(f"wbc-{length * scale:.0f}", False, length * scale, depth, "poured grains") for length in (100, 150, 200, 250, 300))]


def made_up(values_of, wall_of, seeds=(1, 2), depth=40.0, folder="folder"):
    """Returns a reproduction with values_of(bed, seed), the values by analysis, in every run."""
    beds = beds_of(depth)
    outcomes = [Outcome(k, Member(bed.name, seed, f"seed-{seed}.h5", "done", version="9.9.9 (abc)", seconds=10.0),
                        values_of(bed, seed), wall_of(bed)) for seed in seeds for k, bed in enumerate(beds)]
    return Reproduction(folder, beds, list(seeds), outcomes)


def like_the_paper(spread=0.0, depth=40.0):
    """Returns two seeds with all values of the paper, varied by `spread` of each."""
    def values_of(bed, seed):
        found = {}
        for key, value in (PACKING | CHAIN | WALLS).items():
            value = paper.wall_value(key, bed.depth / bed.length) if key in WALLS else value
            found[key] = Measured(value.value * (1 - spread if seed == 1 else 1 + spread) + 0.01 * value.above)
        analyses = {paper.analysis_name(reading, depth) for reading in READINGS} if bed.periodic else {"stored", paper.OF_ALL}
        return {name: [dict(found), dict(found)] for name in sorted(analyses)}

    return made_up(values_of, lambda bed: (bed.depth / bed.length, paper.wall_law(2.5, bed.depth / bed.length)), depth=depth)


def set_everywhere(found, key, value):
    for outcome in found.outcomes:
        for thresholds in outcome.values.values():
            for values in thresholds:
                values[key] = Measured(value)


def without(found, bed):
    return Reproduction(found.folder, found.beds, found.seeds, [outcome for outcome in found.outcomes if not bed(found.beds[outcome.bed])])


def page_of(found):
    return reproduce.report(found, {section: [] for section in SECTIONS}, "talus 9.9.9")


def conclusions(found):
    return "\n".join(reproduce.conclusions(found, found.results()))


# Against the reference


@pytest.fixture(scope="module")
def reference():
    """Returns the beds of half the depth with the values of the reference."""
    rows = list(csv.DictReader((REFERENCE / "reproduction.csv").open(newline="")))

    def values_of(bed, seed):
        found = {}
        for row in rows:
            if row["bed"] == bed.name:
                values = {key: Measured(float(text.removeprefix("<=")), text.startswith("<=")) for key, text in row.items()
                          if key in PACKING | CHAIN | WALLS and text}
                found.setdefault(row["analysis"].replace(";", ",").replace("stored,", "stored;"), [{}, {}])[int(row["threshold"]) - 1] = values
        return found

    def wall_of(bed):
        row = next(row for row in rows if row["bed"] == bed.name)
        return float(row["depth_over_length"] or NAN), float(row["shear_over_tangent_of_walls"] or NAN)

    return made_up(values_of, wall_of, (1,), 20.0)


def text_of(page):
    """Returns the texts of a page: cells of a row separated by bars, notes by slashes."""
    text = re.sub(r"</t[dh]>(?=<t[dh])", " | ", page.replace('<span class="note">', " / "))
    return html.unescape("\n".join(line for line in re.sub(r"<[^>]+>", "", text).split("\n") if line.strip()) + "\n")


@pytest.mark.chosen
def test_tables_and_conclusions_are_those_of_the_reference(reference):
    page = page_of(reference)
    start, end = page.index('<h2 id="in-short"'), page.index('<h2 id="what-was-run"')
    assert text_of(page[start:end]) == (REFERENCE / "reproduction.txt").read_text()


@pytest.mark.chosen
def test_the_data_of_the_chart_are_those_of_the_reference(reference):
    for table in agreement.data_of(reference, []).tables:
        found, expected = (list(csv.DictReader(text.splitlines()))
                           for text in (csv_text(table), (REFERENCE / f"agreement-{table.name}.csv").read_text()))
        assert len(found) == len(expected)
        for row, known in zip(found, expected):
            assert row.keys() == known.keys()
            for name in row:
                assert float(row[name]) == pytest.approx(float(known[name]), rel=1e-9, abs=1e-9, nan_ok=True)


# Values of a run: frames at 0, 5, 10, 15, 20 and 25 deg, failure at 21 deg


class MadeUpRun:
    frames_of_tilt, length, quantities = 6, 2.0, ()

    def __init__(self, **changes):
        tilts = np.radians([0, 5, 10, 15, 20, 25])
        peaks = np.radians(np.tile([2.0, 61, 119], (6, 1)))
        peaks[0, 0] = np.radians(177)
        sections = np.ones((6, 4))
        sections[4] = 1, 1, 3, 3
        self.tilts = changes.pop("tilts", tilts)
        self.analysis = {"theta_c": np.radians(21), "packing/volume_strain": 1e-3 * np.array([0.0, 1, -2, 3, 4, 5]),
                         "packing/stress_ratio": 0.5 * np.sin(tilts), "sections/sigma_xx": sections, "packing/volume": np.full(6, 0.38),
                         "contacts/direction_peak": peaks, "theta_d/dilation": np.radians([10.0, 0]),
                         "theta_d/dilation_low": np.radians([8.0, 0]), "theta_d/dilation_high": np.radians([12.0, 0])} | changes

    def __getitem__(self, name):
        assert name == "frames/tilt"
        return self.tilts


NUMBERS = {"theta_c": 21.0, "packing/failure_ratio": 0.7, "packing/solid_fraction@0": 0.8, "overloaded/fraction@0": 0.5,
           "overloaded/fraction@0[1]": 0.3, "overloaded/fraction_of_all@0": 0.4, "overloaded/fraction@percolation": 0.55,
           "overloaded/fraction@percolation[1]": 0.32, "theta_d/percolation": 0.0, "theta_d/percolation[1]": 10.0,
           "theta_d/percolation_error": NAN, "theta_d/percolation_error[1]": 5.0, "theta_d/lc_jump": 15.0, "lc/max@theta_d": 36.0,
           "lc/max@theta_d[1]": NAN}


def stored(run=None, f=0, analysis="stored", **numbers):
    return paper.measure(run or MadeUpRun(), NUMBERS | numbers)[analysis][f]


def test_numbers_are_those_of_the_threshold():
    assert stored()["solid_fraction"].value == stored(f=1)["solid_fraction"].value == 0.8
    assert stored()["overloaded_at_0"].value == 0.5 and stored(f=1)["overloaded_at_0"].value == 0.3
    assert stored(analysis=paper.OF_ALL)["overloaded_at_0"].value == 0.4
    assert stored()["lc_max_after_jump"].value == 30, "cut as in the paper"
    assert math.isnan(stored(f=1)["lc_max_after_jump"].value) and math.isnan(stored(f=1)["theta_d_by_jump"].value)


def test_a_cluster_that_spans_from_the_first_frame_on_gives_a_bound():
    assert stored()["theta_d_by_percolation"] == (0, True) and stored()["overloaded_at_percolation"] == (0.55, True)
    assert stored(f=1)["theta_d_by_percolation"] == (10, False) and stored(f=1)["overloaded_at_percolation"] == (0.32, False)


def test_the_volume_contracts_and_dilates():
    found = stored()
    assert found["theta_d_by_dilation"] == (pytest.approx(10), False)
    assert (found["contraction"].value, found["dilation"].value) == pytest.approx((2e-3, 6e-3))
    early = stored(MadeUpRun(**{"theta_d/dilation": np.radians([2.0, 0]), "theta_d/dilation_low": np.zeros(2),
                                "theta_d/dilation_high": np.radians([9.0, 0])}))
    assert math.isnan(early["contraction"].value) and early["dilation"].value > 0
    assert early["theta_d_by_dilation"] == (pytest.approx(9), True), "the end of the range, not its minimum"
    none = np.full(2, NAN)
    never = stored(MadeUpRun(**{f"theta_d/dilation{end}": none for end in ("", "_low", "_high")}))
    assert math.isnan(never["dilation"].value) and math.isnan(never["theta_d_by_dilation"].value)
    assert never["contraction"].value == pytest.approx(-4e-3), "up to theta_c, where the volume had grown"


def test_ratios_are_means_over_the_last_half_degree():
    tilts = np.radians([0, 10, 20.4, 20.6, 20.9, 22])
    run = MadeUpRun(tilts=tilts, **{"packing/stress_ratio": np.array([0, 0.1, 0.2, 0.6, 0.8, 0.3]) * np.sin(tilts)})
    assert stored(run)["stress_ratio_over_sine"].value == pytest.approx(0.7)
    assert stored()["shear_over_tangent"].value == stored()["shear_over_tangent_of_walls"].value == 0.7


def test_directions_and_the_gradient_along_walls():
    found = stored()
    assert [found[f"normals_near_{angle}"].value for angle in (0, 60, 120)] == pytest.approx([-3, 61, 119])
    assert found["wall_gradient"].value == pytest.approx(1)


def test_a_slope_that_stands_has_no_values():
    assert paper.measure(MadeUpRun(), {"theta_c": NAN}) == {"stored": [{}, {}], paper.OF_ALL: [{}, {}]}
    assert np.isnan(paper.wall_point(MadeUpRun(), {"theta_c": NAN})).all()
    assert paper.wall_point(MadeUpRun(), NUMBERS) == pytest.approx((0.38 / 4, 0.7))


def test_further_analyses_have_the_values_of_the_chain():
    run = MadeUpRun()
    run.quantities = ("theta_c", "readings/key/l_min=0", "readings/key/l_min=4")
    values = {"readings/key/l_min=0": "2 0123", "readings/key/l_min=4": "1 of an earlier version", "readings/value/l_min=0": np.arange(24.0).reshape(2, 12) + 20, "readings/at_most/l_min=0": np.eye(2, 12, 11, dtype=np.int8),
              "frames/tilt": run.tilts}
    found = paper.measure(SimpleNamespaceRun(run, values), NUMBERS)
    assert list(found) == ["stored", paper.OF_ALL, "l_min=0"]
    found = found["l_min=0"]
    assert list(found[0]) == list(CHAIN) and found[0]["overloaded_at_0"] == (20, False)
    assert found[0]["theta_d_by_percolation"] == (31, True) and found[1]["theta_d_by_percolation"] == (43, False)
    assert found[0]["lc_max_after_jump"].value == 29 and found[1]["lc_max_after_jump"].value == 30
    assert found[0]["theta_d_by_dilation"] == (pytest.approx(10), False), "which no reading changes"


class SimpleNamespaceRun(SimpleNamespace):
    def __init__(self, run, values):
        super().__init__(frames_of_tilt=6, quantities=run.quantities, analysis=run.analysis)
        self.values = values

    def __getitem__(self, name):
        return self.values[name]


def test_the_columns_of_the_readings_are_documented():
    text = (ROOT / "docs/reproduce.md").read_text()
    names = re.findall(r"`([^`]+)`", text[text.index("one column for each of"):])
    assert names == [value.source for key, value in CHAIN.items() if key != "theta_d_by_dilation"]


# Verdicts


def equal_to(value, accuracy, unit="1"):
    return PaperValue("name", "where", "text", value, accuracy, unit, "theta_c", "")


def spread(*values):
    return spread_of([Measured(*(value if isinstance(value, tuple) else (value,))) for value in values])


@pytest.mark.parametrize(("value", "ours", "verdict"), [
    (equal_to(15, 0.5), spread(15.5), "agrees"), (equal_to(15, 0.5), spread(14.5), "agrees"),
    (equal_to(15, 0.5), spread(15.51), "differs"), (equal_to(15, 0.5), spread(14.49), "differs"),
    (equal_to(15, 0.5), spread(15, 17), "agrees"), (equal_to(14, 0.5), spread(15, 17), "differs"),
    (equal_to(0, 0)._replace(above=True), spread(1e-6), "agrees"), (equal_to(0, 0)._replace(above=True), spread(-1, 0.5), "differs"),
    (equal_to(15, 0.5), spread(NAN, NAN), "absent"), (equal_to(15, 0.5), spread(), "not comparable"),
    (equal_to(15, 0.5), spread((0, True)), "differs"), (equal_to(0.45, 0.025), spread((0.8, True)), "not comparable"),
    (equal_to(0.45, 0.025), spread((0.45, True)), "not comparable"), (equal_to(5, 0.5, "D"), spread(5), "agrees")])
def test_verdicts_follow_their_rules(value, ours, verdict):
    assert judge(value, ours, 40).verdict == verdict


def test_verdicts_in_words():
    assert judge(equal_to(0.3, 0.025), spread(0.31), 40).text == "agrees"
    assert judge(equal_to(0.3, 0.025), spread(0.92), 40).text == "differs by +0.62 (tolerance 0.025)"
    assert judge(equal_to(0.3, 0.025), spread(NAN), 40).text == "does not occur"
    assert judge(equal_to(5, 0.5, "D"), spread(5), 20).text == "not comparable: H = 20 D, not 40 D"
    assert judge(equal_to(5, 0.5, "D"), spread(), 40).text == "not comparable: no such run is complete"


def test_spreads_have_the_digits_of_their_deviation():
    def text(runs, values, at_most=False):
        return reproduce.spread_text(Spread(runs, mean_of(values), at_most))

    assert text(2, [0.806, 0.824]) == "0.815 ± 0.013"
    assert text(3, [14.0, 16.2, NAN]) == "15.1 ± 1.6 (2 of 3)"
    assert (text(1, [0.99996]), text(1, [0.0], True), text(1, [119.2])) == ("1.00", "<= 0.00", "119")
    assert (text(2, [7.0, 7.0]), text(2, [NAN, NAN])) == ("7.00 ± 0", "-")
    assert plus_minus(-0.5, 12) == "-0 ± 12" and plus_minus(0.25, 0.1, True) == "+0.25 ± 0.10"
    assert plus_minus(1, 1e-30) == "1.000000000000 ± 0.000000000000"
    assert [reproduce.duration_text(seconds) for seconds in (7.6, 125, 11400)] == ["8 s", "2 min 05 s", "3 h 10 min"]


def test_values_of_walls_follow_the_law_of_the_paper():
    at_100 = paper.wall_value("shear_over_tangent_of_walls", 0.4)
    assert at_100.value == pytest.approx(0.667, abs=5e-4) and at_100.accuracy == pytest.approx(0.0333, abs=1e-4)
    assert paper.wall_value("theta_c_of_walls", 0.4).value == 20


# Readings


def test_readings_change_one_factor_from_their_base():
    assert len(READINGS) == 20 and [reading.base for reading in paper.BASES] == list(dict.fromkeys(reading.base for reading in READINGS))
    for reading in READINGS:
        base = next(each for each in paper.BASES if each.base == reading.base)
        assert base.threshold == reading.threshold and (base.analysis == reading.analysis) == (not reading.change)
        assert reading.analysis.startswith("l_min=0") == reading.base.startswith("single")
    assert paper.analysis_name(READINGS[5], 40) == "l_min=0,lc_cut=30" and paper.analysis_name(READINGS[5], 20) == "l_min=0,lc_cut=15"


def test_analyses_are_those_that_the_program_makes():
    source = (ROOT / "src/ensemble/member_task.cpp").read_text()
    block = source[source.index("  return {\n", source.index("settings_of_readings")):]
    made = [re.sub(r'[{}" ]', "", line).strip(",").replace("cut", "lc_cut=CUT") for line in block[: block.index("};")].splitlines()[1:]]
    assert f"reading_version = {paper.READING_VERSION.strip()};" in source
    assert set(filter(None, made)) == {reading.analysis for reading in READINGS} - {"stored", paper.OF_ALL}


def result_of(values, preparation=0, reading=0, depth=40):
    own = {key: Measured(value.value) for key, value in CHAIN.items()} | {key: Measured(value) for key, value in values.items()}
    return paper.judge_reading(preparation, reading, [own], depth)


def test_scores_count_what_agrees():
    assert (result_of({}).agreeing, result_of({}).comparable) == (13, 13)
    missing = result_of({"overloaded_at_0": 0.8, "theta_d_by_percolation": NAN})
    assert (missing.agreeing, missing.comparable) == (11, 13), "a missing event is a difference"
    assert result_of({}, depth=20).comparable == 7, "lengths of a shallow bed are left out"


def test_deviations_are_medians_of_the_chain():
    spreading = {key: value.value * (1 + 0.1 * k) for k, (key, value) in enumerate(CHAIN.items())}
    assert result_of({}).deviation == 0 and result_of(spreading).deviation == pytest.approx(0.6)
    assert result_of(spreading | dict.fromkeys(list(CHAIN)[:7], NAN)).deviation == math.inf, "half of them do not occur"


def test_conclusions_name_the_best_and_what_none_reaches():
    common = {"theta_d_by_percolation": NAN}
    far = {"overloaded_at_0": 0.8, "overloaded_at_theta_c": 0.9} | common
    results = [result_of(far), result_of({"overloaded_at_0": 0.4} | common, 0, 1), result_of(far, 1, 0)]
    found = paper.conclude(results)
    assert found.best == [results[1]] and not found.complete
    assert [(list(CHAIN)[v], nearest) for v, nearest in found.missed] == [("overloaded_at_0", results[1]), ("theta_d_by_percolation", None)]
    assert found.reading_scores == {0: 10, 1: 11} and found.preparation_scores == {0: 10.5, 1: 10}
    far, near = ({key: value.value * factor for key, value in CHAIN.items()} for factor in (1.7, 1.6))
    tied = [result_of(far), result_of(near, 0, 1), result_of(near, 1, 1)]
    assert paper.conclude(tied).best == tied[1:], "a tie of scores is broken by the deviation"
    assert paper.conclude([result_of({}), result_of({}, 1)]).complete


# The report


def test_the_papers_own_values_agree_everywhere():
    found = like_the_paper()
    page = page_of(found)
    assert "differs by" not in page and not re.search("does not occur</span>", page)
    summary = "\n".join(reproduce.summary(found))
    for part in ("these agree: 12 of 12 with poured grains, 12 of 12 with", "k_L - k_0 = 2.50", "reconciles the paper's chain with ours"):
        assert part in summary
    assert "No combination reaches" not in conclusions(found)
    for value in (PACKING | CHAIN | WALLS).values():
        assert f"<td>{html.escape(value.name)}" in page
    assert "talus run scenarios/wbc-250.toml" in page and "9.9.9 (abc)" in page and "2 of 2" in page


def test_conclusions_name_what_no_combination_reaches():
    found = like_the_paper()
    set_everywhere(found, "overloaded_at_0", 0.8)
    set_everywhere(found, "theta_d_by_percolation", NAN)
    text = conclusions(found)
    assert "No combination reaches p_o at 0 deg (paper 0.3, nearest 0.800 ± 0" in text
    assert "theta_d: percolation (occurs in none)" in text and "11 of 13 values agree" in text
    assert "So no reading that was tried reconciles the paper's chain with ours." in text
    for outcome in found.outcomes:
        if outcome.bed == 1:  # geometric
            outcome.values["l_min=0,min_contacts=3"][1]["overloaded_at_0"] = Measured(0.3)
    text = conclusions(found)
    assert ("is `single grains, gamma >= 2 Gamma_c, grains with 3 contacts or more` with grains set down geometrically: 12 of 13" in text
            and "no change raises that of `single grains, gamma >= Gamma_c`" in text
            and "`grains with 3 contacts or more` raises that of `single grains, gamma >= 2 Gamma_c` most" in text)


def test_a_bed_without_runs_is_named():
    collapse = without(like_the_paper(), lambda bed: bed.name == "pbc-collapse")
    assert "0 of 2" in page_of(collapse) and "not comparable: no such run is complete" in page_of(collapse)
    geometric = without(like_the_paper(), lambda bed: bed.name == "pbc-geometric")
    assert "over all readings: 13.0 with poured grains and 13.0 with grains that collapse;" in conclusions(geometric)
    assert "nothing can be concluded about the threshold" in reproduce.summary(without(like_the_paper(), lambda bed: True))[-1]


def test_figures_are_in_their_sections():
    page = reproduce.report(like_the_paper(), {section: [f'<img alt="{section}">'] for section in SECTIONS}, "talus 9.9.9")
    parts = ["<nav>", ">In short<", 'alt="agreement"', ">The packing</h2>", 'alt="packing"', ">Overloaded grains, lengths and the transition</h2>",
             'alt="overload"', ">Beds between walls</h2>", 'alt="walls"', ">Further figures</h2>", 'alt="further"', ">What was run</h2>",
             ">How values are compared</h2>", ">How each number is measured</h2>"]
    assert [page.index(part) for part in parts] == sorted(page.index(part) for part in parts)
    names = {recipe.name for recipe in reproduce.CATALOGUE}
    assert {name for section in reproduce.SECTIONS.values() for name in section} <= names


def test_values_are_listed_with_all_digits():
    lines = reproduce.values_csv(like_the_paper(0.1)).splitlines()
    assert "pbc/seed-1,1,stored,1,p_o at 0 deg,1,0.27,0" in lines
    chain, stored_values = 2 * len(CHAIN), 2 * len(PACKING | CHAIN | WALLS)
    assert len(lines) == 1 + 6 * (stored_values + 13 * chain) + 10 * (stored_values + chain)


# The chart


def test_scores_are_differences_in_units_of_the_tolerance():
    found = like_the_paper()
    for table in agreement.data_of(found, []).tables:
        assert np.abs(table["score"]).max() < 1e-6 and table["agrees"].all()
    set_everywhere(found, "theta_c", 18.0)  # of 20 +- 1
    set_everywhere(found, "overloaded_at_0", NAN)
    packing, chain = agreement.charts_of(found)
    rows = [row for row in packing.values if row[0] == packing.labels.index("theta_c") + 1]
    assert [(row[6], row[7]) for row in rows] == [(-2, False)] * 3
    assert np.isnan([row[2] for row in chain.values if row[0] == 1]).all()
    assert "dilation from theta_d to theta_c" not in packing.labels, "the paper gives no number"


def test_what_cannot_be_compared_is_left_out():
    assert "mean l_c at 0 deg" not in agreement.charts_of(like_the_paper(depth=20.0))[1].labels
    packing, chain = agreement.charts_of(without(like_the_paper(), lambda bed: bed.periodic))
    assert packing.labels and not chain.labels, "beds between walls"
    assert agreement.data_of(without(like_the_paper(), lambda bed: True), []) is None


@pytest.mark.parametrize("width", [8.6, 17.8])
def test_the_chart_has_room_for_its_texts(reference, width):
    figure = reproduce.agreement_figure(reference, width)
    renderer, size = figure.canvas.get_renderer(), figure.bbox
    for axes in figure.axes:
        assert axes.bbox.width > 0.3 * size.width * (1 if width < 12 else 0.5)
        for text in axes.texts:
            box = text.get_window_extent(renderer)
            assert box.x0 >= 0 and box.x1 <= size.width and box.y0 >= 0 and box.y1 <= size.height, text.get_text()
    assert len(figure.legends[0].get_texts()) == 6


def test_beds_between_walls_that_have_not_failed_lack_the_coefficient():
    found = made_up(lambda bed, seed: {"stored": [{}, {}]}, lambda bed: (NAN, NAN))
    coefficient = found.wall_coefficient()
    assert (coefficient.runs, coefficient.values.count) == (10, 0)
    assert paper.judge(paper.COEFFICIENT, coefficient, 40.0).text == "does not occur"
    assert not any("k_L" in sentence for sentence in reproduce.summary(found))
    assert found.depth_over_length(3) == 0.4, "of the scenario"


def test_beds_between_walls_alone_are_compared():
    found = like_the_paper()
    walls = Reproduction(found.folder, found.beds[3:], found.seeds, [outcome._replace(bed=outcome.bed - 3) for outcome in found.outcomes if outcome.bed > 2])
    packing, chain = agreement.charts_of(walls)
    assert len(packing.labels) == 11 and chain.labels == []
    assert reproduce.summary(walls) == [
        "Between walls, k_L - k_0 = 2.50 ± 0.00 over 10 runs; in the paper about 2.5.",
        "No periodic bed is complete, so nothing can be concluded about the threshold."]
    reproduce.report(walls, {section: [] for section in SECTIONS}, "9.9.9")
