"""Report and figure of `talus perturb`: the weakest push that starts an avalanche, over the distance to failure."""

import math
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import talus
from talus.errors import MissingPackage
from talus.figures.data import Data, runs_text
from talus.figures.groups import Group, group_runs
from talus.figures.runs import AnalysedRun, read_runs
from talus.figures.tables import Table, column, csv_text
from talus.optional import need
from talus.page import write_text
from talus.perturb import STRONGEST, WEAKEST, Bracket, State, bracket, stored_states

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from talus.figures.panels import Page

TITLE = "Weakest push that starts an avalanche"
#: Seeds up to which each has its own symbol.
MOST_SEEDS = 8


def state_row(run: AnalysedRun, state: State) -> list[float]:
    """Returns the row of a state in the table of the report."""
    found = bracket(state.trials)
    searched = found.held and len(state.trials) > 1
    by_strength = {trial.strength: trial for trial in reversed(state.trials)} if searched else {}
    without, with_ = by_strength.get(found.without), by_strength.get(found.with_)
    return [run.seed, state.tilt, run.theta_c, run.theta_c - state.tilt, found.held, found.without,
            math.nan if math.isinf(found.with_) else found.with_, without.energy if without else 0.0,
            with_.energy if with_ else math.nan if found.held else 0.0, without.moved if without else math.nan,
            with_.moved if with_ else math.nan, found.monotone, len(state.trials)]


def table_of_states(runs: Sequence[AnalysedRun], states: Sequence[Sequence[State]]) -> Table:
    """Returns a row for each state of each run."""
    columns = (
        ("seed", "1", "seed of the run"),
        ("theta", "deg", "tilt of the state"),
        ("theta_c", "deg", "angle of repose of the run"),
        ("distance", "deg", "theta_c - theta"),
        ("holds", "1", "1 if the bed comes to rest at this tilt by itself, else 0"),
        ("v_without", "sqrt(g D)", "largest push of the bisection that started no avalanche; 0: none"),
        ("v_with", "sqrt(g D)", "smallest push that did; NaN: none did; 0: no push was needed"),
        ("energy_without", "m g D", "kinetic energy of the first; m is the mass of a disk of diameter D"),
        ("energy_with", "m g D", "the same of the second"),
        ("moved_without", "1", "free grains that the first moved by more than D"),
        ("moved_with", "1", "the same of the second, when the avalanche counted as one"),
        ("monotone", "1", "0 if a weaker push started an avalanche, or a stronger one did not"),
        ("trials", "1", "number of trials, including the one without a push"))
    rows = [state_row(run, state) for run, some in zip(runs, states) for state in some]
    values = np.array(rows, dtype=float).reshape(-1, len(columns)).T
    return Table("", [column(*each, found) for each, found in zip(columns, values)])


def push_text(strength: float) -> str:
    if math.isinf(strength):
        return f"> {STRONGEST:.3g}"
    return f"< {WEAKEST:.3g}" if strength <= WEAKEST else f"{strength:.2f}"


def range_rows(states: Sequence[tuple[float, Bracket]]) -> list[list[str]]:
    """Returns a row for each range of the distance to theta_c (deg). Beds that need no push, or less than the weakest, count
    with the weakest; beds that no push sets off count as infinite."""
    rows, edges = [], (0.0, 0.5, 1.0, 2.0, 3.0, 4.0, 6.0, 60.0)
    for low, high in zip(edges, edges[1:]):
        near = [found for distance, found in states if low < distance <= high]
        if near:
            middles = sorted(math.sqrt(max(each.without, WEAKEST) * max(each.with_, WEAKEST)) for each in near)
            counts = (len(near), sum(not each.held for each in near), sum(math.isinf(each.with_) for each in near),
                      sum(not each.monotone for each in near))
            median = 0.5 * (middles[(len(middles) - 1) // 2] + middles[len(middles) // 2])
            rows.append([f"{low:.3g} - {high:.3g}" if high < edges[-1] else f"> {low:.3g}", *map(str, counts),
                         *map(push_text, (middles[0], median, middles[-1]))])
    return rows


def bracket_text(found: Bracket) -> str:
    if not found.held:
        return "does not hold"
    text = f"> {found.without:.3g}" if math.isinf(found.with_) else f"{found.without:.3g} ... {found.with_:.3g}"
    return text + ("" if found.monotone else ", erratic")


def each_row(run: AnalysedRun, state: State) -> list[str]:
    found = bracket(state.trials)
    moved = next((trial.moved for trial in reversed(state.trials) if trial.strength == found.with_), 0)
    distance = "-" if math.isnan(run.theta_c) else f"{run.theta_c - state.tilt + 0.0:.2f}"
    return [str(run.seed), f"{state.tilt:.2f}", "0.00" if distance == "-0.00" else distance, bracket_text(found),
            str(moved) if moved > 0 else "-"]


def markdown(titles: Sequence[str], rows: Sequence[Sequence[str]], texts: Sequence[str]) -> str:
    """Returns an aligned Markdown table; columns other than `texts` are aligned to the right."""
    widths = [max(3, *map(len, cells)) for cells in zip(titles, *rows)]

    def line(cells: Sequence[str]) -> str:
        return "| " + " | ".join(cell.ljust(width) if title in texts else cell.rjust(width)
                                 for title, cell, width in zip(titles, cells, widths)) + " |\n"

    rule = "|".join("-" * (width + 2) if title in texts else "-" * (width + 1) + ":" for title, width in zip(titles, widths))
    return line(titles) + f"|{rule}|\n" + "".join(map(line, rows))


def report_text(label: str, patch: str, runs: Sequence[AnalysedRun], states: Sequence[Sequence[State]]) -> str:
    """Returns the tables of the report in Markdown: the thresholds by their distance to theta_c, and each state."""
    pairs = [(run, state) for run, some in zip(runs, states) for state in some]
    ranges = range_rows([(run.theta_c - state.tilt, bracket(state.trials)) for run, state in pairs])
    first = markdown(["theta_c - theta", "states", "do not hold", "no avalanche", "erratic", "least", "median", "largest"], ranges,
                     ["theta_c - theta"])
    each = markdown(["seed", "theta", "theta_c - theta", "bracket", "grains moved"], [each_row(*pair) for pair in pairs],
                    ["bracket"])
    return (f"# Weakest push that starts an avalanche\n\n{label}, patch of {patch} D, {len(pairs)} states of "
            f"{runs_text(len(runs))}. Pushes in sqrt(g D), angles in deg. Least, median and largest refer to the midpoints of the "
            f"brackets.\n\n{first}\n{each}")


def refuse_no_states(runs: Sequence[AnalysedRun], first: str) -> None:
    """Raises Error because no state was perturbed, so that the figure would be empty."""
    angles = [run.theta_c for run in runs if run.failed]
    end = f"the beds failed at {min(angles):.2f} to {max(angles):.2f} deg" if angles else "none of the beds failed"
    raise talus.Error(f"no copy was pushed: no tilt of at least {first} deg (--from) was reached before failure, and {end}; use a "
                      "lower --from and another folder")


def caption_of(label: str, patch: str, count: int) -> str:
    return ("Velocity, and kinetic energy, of the weakest push that starts an avalanche, over the distance to the angle of repose; "
            f"{label}, {runs_text(count)}. The grains of a patch of {patch} D at the free surface are pushed downslope, in copies of "
            "the bed at rest. Bars go from the largest push of a bisection that started no avalanche to the smallest that did. Open "
            "triangles up: no avalanche up to the largest push; triangles down: beds that the weakest push set off. Lines: theta_d as "
            "the mean distance over the runs, by the jump of l_c max and by the end of the range in which the volume strain exceeds "
            "its minimum by at most its noise.")


def draw(data: Data, page: "Page") -> "Figure":
    """Draws the thresholds of a table of states, as velocities and as energies, over theta_c - theta. Points are the middles of
    the brackets. The fact "estimates" has theta_c - theta_d (deg) by the name of its estimator."""
    from talus.figures import style
    from talus.figures.panels import Key, arrange, mark_panels, panels

    table = data.tables[0]
    seeds = list(dict.fromkeys(table["seed"].tolist()))
    many = len(seeds) > MOST_SEEDS
    looks: list[dict[str, Any]] = [{**style.curve_style(0 if many else k), "markersize": 2, "alpha": 0.4 if many else 1} for k in range(len(seeds))]
    key = Key()
    for seed, look in zip([seeds[0]] if many else seeds, looks):
        key.line(f"{len(seeds)} beds" if many else f"seed {seed:.0f}", **{**look, "linewidth": 0.7})
    hollow: dict[str, Any] = {"linestyle": "none", "markerfacecolor": "none", "markersize": 3.5}
    key.line("no avalanche", marker="^", color="#606060", **hollow)
    key.line("weakest push suffices", marker="v", color="#606060", **hollow)
    lines = [(name, at, look) for (name, at), look in zip(data.facts["estimates"].items(), (style.LAW, style.MARK)) if at > 0]
    for name, _, look in lines:
        key.line(f"$θ_d$ ({name})", **look)
    axes = panels(page, 2, row=5.5, share_x=True)
    for panel, name, title in zip(axes, ("v", "energy"), ("$v$ / $(gD)^{1/2}$", "$E$ / $mgD$")):
        panel.set_yscale("log")
        for seed, look in zip(seeds, looks):
            of_seed = (table["seed"] == seed) & ~np.isnan(table["distance"])
            x, low, high = (table[column][of_seed] for column in ("distance", f"{name}_without", f"{name}_with"))
            none, both = np.isnan(high), (low > 0) & (high > 0)
            middle = np.where(both, np.sqrt(low * high), np.nan)
            panel.vlines(x[both], low[both], high[both], color=look["color"], linewidth=0.8, alpha=look["alpha"])
            panel.plot(x, middle, **{**look, "linewidth": 0.7})
            for shown, marker, values in ((none, "^", low), ((low == 0) & (high > 0), "v", high)):
                panel.plot(x[shown], values[shown], marker=marker, color=look["color"], alpha=look["alpha"], **hollow)
        for _, at, look in lines:
            panel.axvline(at, **look)
        panel.set_xlim(left=0)
        style.logarithmic(panel.yaxis)
        style.set_title(panel, "x", "$θ_c − θ$", "deg")
        style.set_title(panel, "y", title)
    mark_panels(axes)
    return arrange(axes, key, page=page)


def mean_distance(runs: Sequence[AnalysedRun], estimator: str) -> float:
    """Returns theta_c - theta_d, deg, as the mean over the runs that have it; NaN if none has."""
    known = [each for run in runs if not math.isnan(each := run.theta_c - run.number(f"theta_d/{estimator}"))]
    return sum(known) / len(known) if known else math.nan


def write_picture(folder: Path, table: Table, groups: Sequence[Group], patch: str, command: str) -> None:
    """Writes the figure, its table and its provenance. Raises MissingPackage without matplotlib."""
    need("matplotlib", "the figure")
    from talus.figures.catalogue import Recipe
    from talus.figures.files import write_figure
    from talus.figures.style import TWO_COLUMNS

    runs = [run for group in groups for run in group.runs]
    data = Data(caption_of(groups[0].label, patch, len(runs)), tables=[table], runs=runs,
                facts={"estimates": {"$l_c$": mean_distance(runs, "lc_jump"), "dilation": mean_distance(runs, "dilation_high")}})
    recipe = Recipe("perturb", TITLE, "", lambda groups, wanted: data, draw, TWO_COLUMNS)
    write_figure(recipe, data, groups, folder, command=command)


def report(folder: str, patch: str, first: str, command: str, *paths: str) -> None:
    """Reports the trials of runs: prints the tables, and writes them and the figure into a folder."""
    runs = read_runs(paths)
    states = [stored_states(run.path) for run in runs]
    groups, table = group_runs(runs), table_of_states(runs, states)
    text = report_text(groups[0].label, patch, runs, states)
    write_text(Path(folder) / "perturb.csv", csv_text(table))
    write_text(Path(folder) / "perturb.md", text)
    if not len(table):
        refuse_no_states(runs, first)
    sys.stdout.write(text)
    sys.stdout.flush()
    try:
        write_picture(Path(folder), table, groups, patch, command)
    except MissingPackage as missing:
        print(f"talus: warning: the figure is left out: {missing}", file=sys.stderr)
