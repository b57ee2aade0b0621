"""`talus reproduce`: the values of the paper and ours, in a report (docs/reproduce.md).

    from talus import reproduce
    found = reproduce.read("reproduction")
    reproduce.summary(found)
    reproduce.agreement_figure(found)                # a figure of matplotlib

The folder is that of an ensemble whose variants are the paper's beds. `python3 -m talus.reproduce FOLDER` writes values.csv,
the figures and report.html, and prints the summary."""

import argparse
import json
import math
import shlex
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from talus import agreement, page, paper
from talus.ensemble import Mean, Member, mean_of, open_ensemble, parse_seeds
from talus.errors import Error
from talus.figures import read_groups
from talus.figures.catalogue import CATALOGUE, Recipe
from talus.figures.command import Count, draw_into
from talus.figures.data import Data, Wanted
from talus.figures.files import figure_files, provenance, write_figure
from talus.figures.groups import Group
from talus.figures.style import TWO_COLUMNS
from talus.figures.tables import short_text
from talus.figures.walls import fit_wall_law
from talus.page import Cell, listed, plus_minus
from talus.paper import BASES, CHAIN, PACKING, READINGS, STORED, WALLS, Measured, PaperValue, Reading, Result, Spread
from talus.simulation import _extension
from talus.start import run as run_module

TONES = {"agrees": "good", "differs": "bad", "absent": "bad", "not comparable": "muted"}
PREPARATIONS = {"pour": "poured grains", "geometric": "grains set down geometrically", "collapse": "grains that collapse",
                "file": "grains placed by a file"}
TITLE = "Talus and the paper"


class Bed(NamedTuple):
    """A bed of the paper, or one prepared in another way."""

    name: str  #: variant of the ensemble: "pbc-collapse"
    periodic: bool
    length: float  #: D
    depth: float  #: D
    preparation: str  #: "poured grains"

    @property
    def text(self) -> str:
        return f"{'periodic' if self.periodic else 'walls'}, L = {short_text(self.length)} D"


class Outcome(NamedTuple):
    """A complete run."""

    bed: int  #: index
    member: Member
    values: dict[str, list[dict[str, Measured]]]  #: by analysis, threshold and quantity (paper.measure)
    wall: tuple[float, float]  #: H / L and stress ratio at failure


@dataclass(frozen=True)
class Reproduction:
    """The complete runs of a reproduction."""

    folder: Path
    beds: list[Bed]  #: the periodic ones first, the paper's before other preparations
    seeds: list[int]
    outcomes: list[Outcome]  #: by seed, and by bed for each seed

    @property
    def quick(self) -> bool:
        """Whether the beds are not as deep as the paper's."""
        return self.beds[0].depth != paper.DEPTH

    @property
    def preparations(self) -> list[int]:
        """The periodic beds."""
        return [k for k, bed in enumerate(self.beds) if bed.periodic]

    def outcomes_of(self, bed: int) -> list[Outcome]:
        return [outcome for outcome in self.outcomes if outcome.bed == bed]

    def values(self, bed: int, reading: Reading = STORED) -> list[dict[str, Measured]]:
        """Returns the values of each run of a bed under a reading."""
        name = paper.analysis_name(reading, self.beds[bed].depth)
        return [outcome.values.get(name, [{}, {}])[reading.threshold] for outcome in self.outcomes_of(bed)]

    def spread(self, bed: int, key: str, reading: Reading = STORED) -> Spread:
        return paper.spread_of([values.get(key, Measured(math.nan)) for values in self.values(bed, reading)])

    def results(self) -> list[Result]:
        """Returns the chain of every preparation that has a complete run under every reading."""
        return [paper.judge_reading(bed, k, self.values(bed, reading), self.beds[bed].depth)
                for bed in self.preparations if self.outcomes_of(bed) for k, reading in enumerate(READINGS)]

    def wall_points(self) -> list[tuple[float, float]]:
        """Returns the points at failure of all runs between walls that have failed."""
        return [outcome.wall for bed, each in enumerate(self.beds) if not each.periodic for outcome in self.outcomes_of(bed)
                if not math.isnan(outcome.wall[1])]

    def depth_over_length(self, bed: int) -> float:
        """Returns the mean H / L of a bed at failure, or that of its scenario if none has failed."""
        found = [outcome.wall[0] for outcome in self.outcomes_of(bed) if not math.isnan(outcome.wall[0])]
        return mean_of(found).mean if found else self.beds[bed].depth / self.beds[bed].length

    def wall_coefficient(self) -> Spread:
        """Returns k_L - k_0 of all beds between walls, with the standard error of the fit as its deviation."""
        points = self.wall_points()
        if not points:
            return Spread(sum(not self.beds[outcome.bed].periodic for outcome in self.outcomes), mean_of([]))
        fit = fit_wall_law(*np.array(points).T)
        return Spread(len(points), Mean(len(points), fit.k, fit.error, fit.error))


def read(folder: str | Path, seeds: Sequence[int] | None = None, variants: Sequence[str] | None = None) -> Reproduction:
    """Reads the complete runs of a reproduction, of all its seeds and beds or of some. Raises Error as open_ensemble does, and
    if the run of a periodic bed lacks the further analyses."""
    ensemble = open_ensemble(folder)
    seeds, variants = list(seeds or ensemble.seeds), list(variants or ensemble.variants)
    beds = []
    for name in variants:
        scenario = ensemble.scenario(name)
        bed = scenario["bed"]
        beds.append(Bed(name, bed["boundary"] == "periodic", bed["length"], bed["depth"],
                        PREPARATIONS[scenario["deposition"]["method"]]))
    outcomes = []
    for member in ensemble.done():
        if member.seed in seeds and member.variant in variants:
            k = variants.index(member.variant)
            needed = {paper.analysis_name(reading, beds[k].depth) for reading in READINGS if beds[k].periodic}
            with member.open() as run:
                values = paper.measure(run, member.numbers) if member.numbers else {}
                if not values or values["stored"][0] and not needed <= values.keys():
                    raise Error(f"{member.path}: lacks analyses of this version of Talus; repeat `talus reproduce`, which adds "
                                "them")
                outcomes.append(Outcome(k, member, values, paper.wall_point(run, member.numbers)))
    return Reproduction(Path(folder), beds, seeds, outcomes)


def values_csv(found: Reproduction) -> str:
    """Returns one row of CSV for each run, analysis, threshold and quantity, in full digits. Analyses other than the stored one
    have the values of the chain."""
    text = "run,seed,analysis,threshold_over_gamma_c,quantity,unit,value,at_most\n"
    quantities = PACKING | CHAIN | WALLS
    for outcome in found.outcomes:
        for analysis, thresholds in outcome.values.items():
            for f, values in enumerate(thresholds, 1):
                for key, (value, at_most) in values.items():
                    if not math.isnan(value) and (analysis == "stored" or key in CHAIN):
                        name, analysed = (each.replace(",", ";") for each in (quantities[key].name, analysis))
                        text += (f"{outcome.member.variant}/seed-{outcome.member.seed},{outcome.member.seed},{analysed},{f},"
                                 f"{name},{quantities[key].unit},{short_text(value)},{at_most:d}\n")
    return text


# Texts


def three_digits(value: float) -> str:
    """Returns "0.300", "15.0", "119", "7.4e-05"."""
    return f"{value:.0f}" if 99.95 <= abs(value) < 999.5 else f"{value:#.3g}"


def spread_text(spread: Spread) -> str:
    """Returns "0.815 ± 0.012"; "<= 0.00" for an upper bound; "-" without a value; "(1 of 2)" is added if runs have none."""
    count, mean, deviation, _ = spread.values
    if count == 0:
        return "-"
    text = plus_minus(mean, deviation) if count > 1 and deviation > 0 else three_digits(mean) + " ± 0" * (count > 1)
    return "<= " * spread.at_most + text + (f" ({count} of {spread.runs})" if count < spread.runs else "")


def name_text(value: PaperValue) -> str:
    """Returns the name with its unit: "theta_c [deg]"."""
    return value.name + ("" if value.unit == "1" else f" [{value.unit}]")


def duration_text(seconds: float) -> str:
    """Returns "8 s", "2 min 05 s", "3 h 10 min"."""
    whole = math.floor(seconds + 0.5)
    if whole >= 3600:
        return f"{whole // 3600} h {whole // 60 % 60:02} min"
    return f"{whole // 60} min {whole % 60:02} s" if whole >= 60 else f"{whole} s"


def paper_cell(value: PaperValue) -> Cell:
    """Returns the paper's words, and below them how far off a value may be, and where it stands."""
    unit = "" if value.unit == "1" else f" {value.unit}"
    return Cell(value.text, ("" if value.above else f"{value.value:.3g} ± {value.accuracy:.2g}{unit}; ") + value.where)


def judged_cell(value: PaperValue, ours: Spread, depth: float) -> Cell:
    """Returns a value of ours with the verdict below it."""
    found = paper.judge(value, ours, depth)
    return Cell(spread_text(ours), found.text, TONES[found.verdict])


# Tables


def values_table(found: Reproduction, quantities: dict[str, PaperValue], readings: Sequence[Reading] | None = None) -> str:
    """Returns the table of some values, one column for each preparation, under the stored reading or under several."""
    titles = ["quantity", "paper", *(["overloaded are"] if readings else [])]
    rows: list[list[str | Cell]] = []
    for key, value in quantities.items():
        by_reading = readings and key != "theta_d_by_dilation"
        for k, reading in enumerate((readings or [STORED]) if by_reading or not readings else readings[:1]):
            head: list[str | Cell] = [name_text(value), paper_cell(value)] if k == 0 else ["", ""]
            if readings:
                head.append(reading.base if by_reading else "none needed")
            rows.append(head + [judged_cell(value, found.spread(bed, key, reading), found.beds[bed].depth)
                                for bed in found.preparations])
    numbers = frozenset(range(len(titles), len(titles) + len(found.preparations)))
    return page.Table(titles + [found.beds[bed].preparation for bed in found.preparations], rows, numbers).html()


def wall_table(found: Reproduction) -> str:
    rows: list[list[str | Cell]] = []
    for key in WALLS:
        for k, bed in enumerate(found.beds):
            if not bed.periodic:
                value = paper.wall_value(key, found.depth_over_length(k))
                ours = judged_cell(value, found.spread(k, key), bed.depth)
                rows.append([bed.text, name_text(value), paper_cell(value), ours])
    value = paper.COEFFICIENT
    rows.append(["all between walls", value.name, paper_cell(value), judged_cell(value, found.wall_coefficient(), paper.DEPTH)])
    return page.Table(["bed", "quantity", "paper", "ours"], rows, frozenset({3})).html()


def beds_table(found: Reproduction) -> str:
    rows = []
    for k, bed in enumerate(found.beds):
        runs = found.outcomes_of(k)
        rows.append([bed.text, f"{short_text(bed.depth)} D", f"{bed.length * bed.depth:.0f}", bed.preparation,
                     f"{len(runs)} of {len(found.seeds)}", spread_text(found.spread(k, "theta_c")),
                     duration_text(sum(outcome.member.seconds for outcome in runs))])
    return page.Table(["bed", "H", "grains", "preparation", "seeds complete", "theta_c [deg]", "processor time"], rows,
                      frozenset({1, 2, 4, 5, 6})).html()


def chain_table(results: Sequence[Result], preparation: int) -> str:
    """Returns the chain of a preparation under every reading. A value has no count of its seeds: columns are narrow."""
    values = list(CHAIN.values())
    titles = ["reading", *(name_text(value) for value in values), "agree", "half within"]
    its = [Cell(f"{value.value:.3g}", tone="muted") for value in values]
    rows: list[list[str | Cell]] = [[Cell("the paper", tone="muted"), *its, "", ""]]
    for result in results:
        if result.preparation == preparation:
            reading = READINGS[result.reading]
            cells = [Cell(spread_text(spread), "agrees" if each.verdict == "agrees" else "",
                          {"agrees": "good", "not comparable": "muted"}.get(each.verdict, ""))
                     for spread, each in zip(result.spreads, result.judgements)]
            name = Cell("", reading.change) if reading.change else Cell(reading.base)
            rows.append([name, *cells, score_text(result), deviation_text(result)])
    return page.Table(titles, rows, frozenset(range(1, len(titles)))).html()


def definition_table() -> str:
    values = [*PACKING.values(), *CHAIN.values(), *WALLS.values(), paper.COEFFICIENT]
    return page.Table(["quantity", "how ours is measured", "data set of a run file"],
                      [[value.name, value.definition, f"`/analysis/{value.source.partition('@')[0]}`"] for value in values]).html()


# Conclusions


def score_text(result: Result) -> str:
    return f"{result.agreeing} of {result.comparable}"


def deviation_text(result: Result) -> str:
    """Returns "27 %"; "-" where half of the values do not occur."""
    return f"{100 * result.deviation:.0f} %" if math.isfinite(result.deviation) else "-"


def reading_text(reading: Reading) -> str:
    return f"{reading.base}, {reading.change}" if reading.change else reading.base


def result_text(found: Reproduction, result: Result) -> str:
    return f"`{reading_text(READINGS[result.reading])}` with {found.beds[result.preparation].preparation}"


def verdict(found: Reproduction, results: Sequence[Result]) -> list[str]:
    """Returns the nearest reading, and whether it reconciles the paper's chain with ours."""
    if not results:
        return ["No periodic bed is complete, so nothing can be concluded about the threshold."]
    conclusion = paper.conclude(results)
    best, most = conclusion.best, 3
    names = [result_text(found, result) for result in best[:most]] + [f"{len(best) - most} more"] * (len(best) > most)
    several = len(best) > 1
    return [f"Nearest to the paper's chain {'are' if several else 'is'} {listed(names)}: {score_text(best[0])} values agree, half lie "
            f"within {deviation_text(best[0])} of the paper's{', in each.' if several else '.'}",
            "So the nearest reading reconciles the paper's chain with ours." if conclusion.complete else
            "So no reading that was tried reconciles the paper's chain with ours."]


def conclusions(found: Reproduction, results: Sequence[Result]) -> list[str]:
    """Returns every conclusion from the scores of all readings and preparations."""
    sentences = verdict(found, results)
    if not results:
        return sentences
    conclusion = paper.conclude(results)
    more = []
    least = conclusion.smallest_deviation
    if least and math.isfinite(least.deviation) and not any(result is least for result in conclusion.best):
        more.append(f"{result_text(found, least)} has the smallest median deviation: {deviation_text(least)}, with "
                    f"{score_text(least)} that agree.")
    scores, bases = conclusion.reading_scores, [k for k, reading in enumerate(READINGS) if not reading.change]
    preparations = [f"{score:.1f} with {found.beds[bed].preparation}" for bed, score in conclusion.preparation_scores.items()]
    more.append(f"Mean number of values that agree, over all readings: {listed(preparations)}; over preparations, with nothing else "
                f"changed: {listed([f'{scores[k]:.1f} for `{READINGS[k].base}`' for k in bases])}.")
    raised = []
    for base in bases:
        best = max((k for k in scores if READINGS[k].base == READINGS[base].base), key=lambda k: scores[k])
        raised.append(f"no change raises that of `{READINGS[base].base}`" if best == base else
                      f"`{READINGS[best].change}` raises that of `{READINGS[base].base}` most, to {scores[best]:.1f}")
    more.append(f"Of the changes to a reading, {listed(raised)}.")
    missed, chain = [], list(CHAIN.values())
    for v, nearest in conclusion.missed:
        text = (f"paper {chain[v].value:.3g}, nearest {spread_text(nearest.spreads[v])}, {result_text(found, nearest)}" if nearest
                else "occurs in none")
        missed.append(f"{chain[v].name} ({text})")
    if missed:
        more.append(f"No combination reaches {listed(missed)}.")
    return [sentences[0], *more, sentences[1]]


def agreement_count(found: Reproduction, bed: int) -> str:
    judged = [paper.judge(value, found.spread(bed, key), found.beds[bed].depth).verdict for key, value in PACKING.items()]
    return f"{judged.count('agrees')} of {len(judged) - judged.count('not comparable')}"


def summary(found: Reproduction) -> list[str]:
    """Returns how many values agree in each preparation, the wall law, and the nearest reading; one sentence an item."""
    counts = [f"{agreement_count(found, bed)} with {found.beds[bed].preparation}" for bed in found.preparations]
    items = [f"Of the paper's values for the packing, these agree: {listed(counts)}."] if counts else []
    coefficient = found.wall_coefficient()
    if coefficient.values.count > 1:
        items.append(f"Between walls, k_L - k_0 = {coefficient.values.mean:.2f} ± {coefficient.values.error:.2f} over "
                     f"{coefficient.values.count} runs; in the paper about 2.5.")
    return items + verdict(found, found.results())


# The report


INTRODUCTION = (
    'What L. Staron, J.-P. Vilotte and F. Radjai report in "Multiscale Analysis of the Stress State in a Granular Slope in '
    'Transition to Failure" (2005), and what Talus finds in beds made and tilted in the same way. Written by `talus reproduce`.')
OF_WALLS = ("Deposition friction 0.5. The paper's Eq. 15: (sigma_T/sigma_N)/tan(theta) = 1 - (k_L - k_0)/3 H/L; its values for each "
            "length are this with k_L - k_0 = 2.5 and H = V/L, the mean height of our beds before failure.")
OF_READINGS = (
    "The paper leaves open how its beds were made and some details of its data processing. Here its definitions are varied for "
    "each preparation, one factor at a time, from three readings: single grains with the printed threshold, single grains with "
    'twice it, and grains taken together with their first neighbours, within 1.5 D, with the printed threshold. "Agree" counts '
    'the values of the chain that agree with the paper\'s, each by the rule above; "half within" is the median of |ours - paper| '
    "/ paper over the chain. They show how near a reading comes, not why; the values of one chain are not independent.")
CHANGES = (
    "p_o over all grains: not only over those that carry a force.",
    "Grains with 3 contacts or more: a grain held by two contacts has gamma near 1 whatever its load; here it does not count.",
    "Moments averaged over 1 deg: the internal moment of each grain is a mean over 1 deg of tilt.",
    "Neighbours joined: overloaded grains form a cluster if their centres are closer than 1.1 times the sum of their radii, in "
    "contact or not.",
    "l_c cut as in the paper: at 30 D of 40 D, so at 3/4 of the depth; otherwise at the depth.",
    "l_c ends at Gamma_c: grains are overloaded if gamma >= 2 Gamma_c, but their neighbourhoods grow until the stress ratio is "
    "Gamma_c.",
    "Neighbourhoods of at least 4 D: a grain is taken together with all within 2 D of it, and l_c is at least 4 D.",
)
QUICK = ("Quick: beds of half the paper's depth with the same H / L between walls. Angles and ratios can be compared with the "
         "paper's, lengths cannot. Without `--quick` the beds are the paper's.")
RULES = (
    "Ours is the mean over the seeds ± their standard deviation (that of one bed, not of the mean).",
    "The accuracy of a value of the paper, printed below it, is half a step of the number as it is printed, or of the scale that "
    "it was read from. For theta_c, which the paper gives as one range for all its beds, about 19 to 21 deg, the value is the "
    "middle of the range and the accuracy half its width.",
    "theta_c falls with the length of a periodic bed, because the weakest place decides. The threshold Gamma_c = sin(theta_c) "
    "falls with it, so that p_o at equal tilt is higher in a longer bed.",
    "The tolerance is this accuracy plus one standard deviation of ours, and a value within it agrees. A wide spread thus makes "
    "it easier to agree, so the spread is printed with the value.",
    '"Does not occur" means that no run shows it; "not comparable" is followed by the reason. `<=` marks an upper bound: the '
    "event has already happened in the first frame.",
    "Every value that depends on which grains are overloaded is given in three readings: single grains with the printed "
    "threshold, gamma >= Gamma_c = sin(theta_c); single grains with twice that threshold; and grains taken together with all "
    "neighbours within 1.5 D, with the printed threshold. theta_c is that of the same run.",
)
OF_DEFINITIONS = (
    "`talus analyze BED/seed-N.h5` prints the series of a run and, with `--json`, all of them; they are in the run file under the "
    "path given here. Definitions are those of docs/analysis.md and docs/notation.md; `values.csv` has the value of each run.")


def report(found: Reproduction, pictures: dict[str, list[str]], program: str) -> str:
    """Returns the page: the result with its chart, the sections, and finally how it was made. `pictures`: their HTML by
    section. `program`: version of Talus that wrote it."""
    results = found.results()
    parts = [page.heading(2, "In short"), page.bullets(summary(found)), *pictures["agreement"],
             page.heading(2, "The packing"), values_table(found, PACKING), *pictures["packing"],
             page.heading(2, "Overloaded grains, lengths and the transition"), values_table(found, CHAIN, BASES),
             *pictures["overload"],
             page.heading(2, "Beds between walls"), page.paragraph(OF_WALLS), wall_table(found), *pictures["walls"],
             page.heading(2, "Settling which grains are overloaded"), page.paragraph(OF_READINGS), page.bullets(CHANGES)]
    for preparation in dict.fromkeys(result.preparation for result in results):
        parts += [page.heading(3, f"The bed with {found.beds[preparation].preparation}"), chain_table(results, preparation)]
    parts += [page.heading(3, "What follows"), page.bullets(conclusions(found, results))]
    if pictures["further"]:
        parts += [page.heading(2, "Further figures"), *pictures["further"]]
    parts += [page.heading(2, "What was run"), *([page.paragraph(QUICK)] if found.quick else []),
              page.paragraph("Rigid disks, friction 0.5, no restitution, diameters within a ratio of 1.5, tilted by 1 deg/s in steps "
                             f"of 0.001 deg until the slope fails. Seeds: {', '.join(map(str, found.seeds))}. The paper says no "
                             "more of its deposition than that it is random, so the periodic bed is prepared in three ways: "
                             "poured, set down geometrically, and as a collapse (`deposition.method`)."),
              beds_table(found),
              page.paragraph(f"Runs by Talus {', '.join(dict.fromkeys(outcome.member.version for outcome in found.outcomes))}; their "
                             f"steps took {duration_text(sum(outcome.member.seconds for outcome in found.outcomes))} on one thread "
                             f"each. Analysed and drawn by {program}."),
              page.paragraph("The same by hand, in the folder of this report, for each seed N:"),
              page.commands([*(f"talus run scenarios/{bed.name}.toml --seed N -o {bed.name}/seed-N.h5" for bed in found.beds),
                             "talus analyze */seed-*.h5"]),
              page.heading(2, "How values are compared"), page.bullets(RULES),
              page.heading(2, "How each number is measured"), page.paragraph(OF_DEFINITIONS), definition_table()]
    return page.page(TITLE, INTRODUCTION, "".join(parts))


# Figures


FORMATS = ("pdf", "png")
#: Sections of the report for the figures of the catalogue; all others are further ones.
SECTIONS = {
    "packing": ("fig04-shear-stress", "fig05-stress-ratio", "fig14-volume-strain", "contact-directions"),
    "overload": ("fig08-stress-ratio-density", "fig09-overloaded-fraction", "fig10-stress-ratio-maps", "fig11-neighbourhoods",
                 "fig12-coarse-graining-length", "fig13-overloaded-maps", "overloaded-over-scale"),
    "walls": ("fig06-wall-stress", "fig07-wall-ratio"),
}


def agreement_recipe(found: Reproduction) -> Recipe:
    """Returns the recipe of the chart of the distance of each value from the paper's."""
    return Recipe("agreement", agreement.TITLE, "a value that can be compared",
                  lambda groups, wanted: agreement.data_of(found, [run for group in groups for run in group.runs]),
                  agreement.draw, TWO_COLUMNS)


def agreement_figure(found: Reproduction, width: float = 0) -> Figure:
    """Draws this chart, `width` cm wide."""
    return agreement_recipe(found)([], width=width)


def is_drawn(recipe: Recipe, data: Data, groups: Sequence[Group], folder: Path, command: str) -> bool:
    """Whether all files of a figure exist and were drawn from the same data by the same version."""
    if not all((folder / file).is_file() for file in figure_files(recipe, data, FORMATS)):
        return False
    try:
        stored = json.loads((folder / f"{recipe.name}.json").read_text(encoding="utf-8", errors="surrogateescape"))
    except ValueError:
        return False
    return bool(stored == provenance(recipe, data, groups, command))


def draw_figures(found: Reproduction, folder: Path, command: str, processes: int) -> dict[str, list[str]]:
    """Draws the chart of agreement and all figures of the catalogue that the complete runs allow, except those that exist with
    the same data, and returns their HTML by section."""
    # By bed, so that groups follow the order of the plan: the paper's preparation first.
    groups = read_groups([str(found.folder / outcome.member.variant / outcome.member.path.name)
                          for outcome in sorted(found.outcomes, key=lambda outcome: outcome.bed)])
    made, jobs = [], []
    for recipe in (agreement_recipe(found), *CATALOGUE):
        data = recipe.data(groups, Wanted(paper=True))
        if data is None:
            continue
        made.append((recipe, data))
        made_by = command if recipe.name == "agreement" else shlex.join(
            ["talus", "figures", *dict.fromkeys(run.path for run in data.runs), "--only", recipe.name, "-o", str(folder)])
        if not is_drawn(recipe, data, groups, folder, made_by):
            jobs.append(partial(write_figure, recipe, data, groups, folder, formats=FORMATS, command=made_by))
    draw_into(folder, jobs, processes, Count("figures", False))
    section = {name: part for part, names in SECTIONS.items() for name in names} | {"agreement": "agreement"}
    pictures: dict[str, list[str]] = {part: [] for part in ("agreement", *SECTIONS, "further")}
    for recipe, data in made:
        pictures[section.get(recipe.name, "further")].append(
            page.picture(folder / f"{recipe.name}.png", data.title or recipe.title, data.caption, recipe.width == TWO_COLUMNS))
    return pictures


def main(arguments: list[str]) -> int:
    """Writes the figures, values.csv and report.html into the folder of a reproduction, and prints the summary."""
    _extension()  # is it there?
    parser = argparse.ArgumentParser(prog="talus.reproduce",
                                     description="Report of a reproduction, from the complete runs in its folder")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--seeds", type=parse_seeds, help="only these, e.g. 1-2")
    parser.add_argument("--bed", action="append", help="only these variants, periodic ones first")
    parser.add_argument("--jobs", type=int, default=1, help="number of processes that draw")
    asked = parser.parse_args(arguments)
    found = read(asked.folder, asked.seeds, asked.bed)
    command = shlex.join(["talus", "reproduce", *(["--quick"] if found.quick else []),
                          "--seeds", ",".join(map(str, found.seeds)), "-o", str(asked.folder)])
    pictures = draw_figures(found, asked.folder / "figures", command, max(asked.jobs, 1))
    page.write_text(asked.folder / "values.csv", values_csv(found))
    page.write_text(asked.folder / "report.html", report(found, pictures, _extension().version_text))
    for item in summary(found):
        print("-", item)
    print("The report is", asked.folder / "report.html")
    return 0


if __name__ == "__main__":
    sys.exit(run_module("reproduce", sys.argv[1:]))
