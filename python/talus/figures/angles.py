"""Characteristic angles of runs: theta_c, the first slide, theta_r, and theta_d by each estimator; their distributions over
the runs of an ensemble, and their correlations."""

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from talus.ensemble import mean_of
from talus.figures.data import Data, Wanted
from talus.figures.groups import Group
from talus.figures.means import correlation_of
from talus.figures.panels import ABOVE, Key, Page, arrange, has_numbers, panels
from talus.figures.runs import AnalysedRun
from talus.figures.style import COLOURS, as_math, curve_style, letter, set_title
from talus.figures.tables import Column, Table, column, short_text
from talus.simulation import _extension
from talus.table import numbered

FEWEST_RUNS = 2
MOST_BINS = 60


@dataclass(frozen=True)
class Estimator:
    """An estimator of theta_d, for one strain or threshold."""

    quantity: str
    k: int
    label: str
    meaning: str

    def theta_d(self, run: AnalysedRun) -> float:
        return run.number(self.quantity, self.k)


def estimators_of(runs: Sequence[AnalysedRun]) -> list[Estimator]:
    """Returns the onset of dilation, percolation and the jump of the largest l_c, for either strain and for each threshold
    of the runs, in reverse order."""
    run = next((run for run in runs if run.thresholds), runs[0])
    factors = ["" if factor == 1 else short_text(factor) + " " for factor in run.values("threshold_factor")]
    found = [Estimator("theta_d/dilation", 1, "$ε_y$", "onset of dilation, centre of mass"),
             Estimator("theta_d/dilation", 0, "$ε_V$", "onset of dilation, free surface")]
    for quantity, label, meaning in (("theta_d/percolation", "span, ", "percolation at "),
                                     ("theta_d/lc_jump", "$ℓ_c$, ", "jump of the largest l_c at ")):
        found += [Estimator(quantity, f, f"{label}{factor}Γ$_c$", f"{meaning}{factor}Gamma_c")
                  for f, factor in reversed(list(enumerate(factors)))]
    return found


@dataclass
class RunAngle:
    """An angle of each run."""

    name: str  #: as in members.csv, "theta_d/lc_jump[1]"
    label: str
    meaning: str
    values: list[np.ndarray]  #: deg, by group and run; NaN for a run without the angle

    @property
    def known(self) -> np.ndarray:
        """All values that are numbers."""
        values = np.concatenate(self.values)
        return values[~np.isnan(values)]


def run_angles(groups: Sequence[Group]) -> list[RunAngle]:
    """Returns the angles that at least two runs of a group have."""
    rows: list[tuple[str, str, str, Callable[[AnalysedRun], float]]] = [
        ("theta_c", "$θ_c$", "theta_c, angle of repose", lambda run: run.theta_c),
        ("first_slide", "first slide", "first slide of the surface layer", lambda run: run.number("first_slide")),
        ("theta_r", "$θ_r$", "theta_r, angle at rest after failure", lambda run: run.theta_r)]
    if groups:
        rows += [(numbered(each.quantity, each.k), f"$θ_d$ ({each.label})", "theta_d, " + each.meaning, each.theta_d)
                 for each in reversed(estimators_of([run for group in groups for run in group.runs]))]
    angles = [RunAngle(name, label, meaning, [np.array([value(run) for run in group.runs]) for group in groups])
              for name, label, meaning, value in rows]
    return [angle for angle in angles if any((~np.isnan(values)).sum() >= FEWEST_RUNS for values in angle.values)]


def add_angle_tables(data: Data, groups: Sequence[Group], angles: Sequence[RunAngle]) -> None:
    for g, group in enumerate(groups):
        seeds = column("seed", "1", "seed of the run", [run.seed for run in group.runs])
        data.add_group(group, group.runs, [seeds, *(column(angle.name, "deg", angle.meaning, angle.values[g]) for angle in angles)])
    data.facts["angles"] = [(angle.name, angle.label) for angle in angles]


# Distributions.


def round_step(most: float) -> float:
    """Returns the largest of 1, 2, 2.5 and 5 times a power of ten that does not exceed `most` > 0."""
    decade = 10.0 ** math.floor(math.log10(most))
    return max(factor * decade for factor in (1, 2, 2.5, 5) if factor == 1 or factor * decade <= most)


def bins_for(values: np.ndarray) -> np.ndarray:
    """Returns the edges of bins of equal width. The width follows Freedman and Diaconis (1981), 2 IQR n^(-1/3), rounded to
    a round number; there is one empty bin on either side."""
    lower, upper = np.percentile(values, (25, 75))
    low, high = values.min(), values.max()
    wanted = max(2 * (upper - lower) / np.cbrt(len(values)), (high - low) / MOST_BINS * 2.5)  # rounding may halve it
    width = round_step(wanted if wanted > 0 else 0.5)
    first = math.floor(low / width) - 1
    return (first + np.arange(math.floor(high / width) - first + 3)) * width


def histogram(angle: RunAngle) -> Table:
    """Returns the share of the runs of each group in each bin."""
    edges = bins_for(angle.known)
    columns = [column("from", "deg", "lower edge of a bin of " + angle.meaning, edges[:-1]),
               column("to", "deg", "its upper edge", edges[1:])]
    for g, values in enumerate(angle.values, 1):
        known = values[~np.isnan(values)]
        places = ((known - edges[0]) / (edges[1] - edges[0])).astype(int)
        shares = np.bincount(places, minlength=len(edges) - 1) / max(len(known), 1)
        columns.append(column(f"share_{g}", "1", f"share of the runs of group {g} that have it", shares))
    return Table("bins-" + re.sub(r"[/\[]", "-", angle.name).replace("]", ""), columns)


def summary(values: np.ndarray) -> str:
    """Returns "mean 19.16 ± 0.09, median 19.17, n = 50"."""
    found = mean_of(values)
    if not found.count:
        return "none"
    mean = _extension()._plus_minus(found.mean, found.error) if found.count > 1 and found.error > 0 else f"{found.mean:.2f}"
    return f"mean {mean}, median {np.nanmedian(values):.2f}, n = {found.count}"


def angle_distributions(groups: Sequence[Group], wanted: Wanted) -> Data | None:
    groups = [group for group in groups if len(group.runs) >= FEWEST_RUNS]
    angles = run_angles(groups)
    if not angles:
        return None
    data = Data("Histograms of the characteristic angles of a run: theta_c, the first slide of the surface layer (after theta_c if "
                "the tilt is fast compared with the acceleration of the flow), the angle at rest theta_r if a flow was followed, and "
                "theta_d by each estimator: jump of the largest l_c, first cluster that spans from floor to surface, for each "
                "threshold, and onset of dilation by either strain. Shares refer to the n runs of a group that have the angle; "
                "vertical lines are the means, ± their standard errors.")
    add_angle_tables(data, groups, angles)
    data.facts["bins"] = [histogram(angle) for angle in angles]
    data.tables += data.facts["bins"]
    return data


def draw_angle_distributions(data: Data, page: Page) -> Figure:
    count, several = len(data.facts["angles"]), len(data.groups) > 1
    axes = panels(page, count, row=(3.2 if page.narrow else 3.6) + 0.32 * len(data.groups), share_y=True)
    for k, (each, (name, label), bins) in enumerate(zip(axes, data.facts["angles"], data.facts["bins"])):
        lines = []
        for g, group in enumerate(data.groups):
            values = group.table[name]
            colour = COLOURS[g % len(COLOURS)]
            edges = [*bins["from"], bins["to"][-1]]
            each.stairs(bins[f"share_{g + 1}"], edges, fill=True, color=colour, alpha=0.2, linewidth=0)
            each.stairs(bins[f"share_{g + 1}"], edges, color=colour, linewidth=0.8)
            if not np.isnan(values).all():
                each.axvline(np.nanmean(values), **curve_style(g, symbols=False) | {"linewidth": 0.6})
            lines.append(summary(values))
        place_lines(each, lines, f"{letter(k)} " if count > 1 else "")
        each.set_xlim(max(0, bins["from"][0]) if bins["to"][0] >= 0 else bins["from"][0], bins["to"][-1])
        set_title(each, "x", label, "deg")
        if has_numbers(each, "y"):
            set_title(each, "y", "share of the runs")
    axes[0].set_ylim(0, 1.05 * max(each.dataLim.y1 for each in axes))
    return arrange(axes, key_of_groups(data), page=page)


def place_lines(axes: Axes, lines: Sequence[str], mark: str) -> None:
    """Puts a line for each group above a panel, in its colour, and the letter of the panel before the first."""
    for g, line in enumerate(lines):
        above = 3 + 8.5 * (len(lines) - 1 - g)
        axes.annotate(mark + line if g == 0 else line, (0, 1), (0, above), xycoords="axes fraction", textcoords="offset points",
                      fontsize=6, color=COLOURS[g % len(COLOURS)], gid=ABOVE)


def key_of_groups(data: Data, symbols: bool = False, **look: Any) -> Key:
    key = Key()
    for g, group in enumerate(data.groups):
        key.line(as_math(group.legend), **curve_style(g, symbols) | look)
    return key


# Correlations.


def angle_correlations(groups: Sequence[Group], wanted: Wanted) -> Data | None:
    groups = [group for group in groups if len(group.runs) >= FEWEST_RUNS]
    angles = [angle for angle in run_angles(groups) if not angle.name.endswith("]") or angle.name.startswith("theta_d/dilation")]
    if len(angles) < 2:
        return None
    data = Data("Each characteristic angle of a run over each other one, with a point for each run that has both; r is Pearson's "
                "correlation coefficient, given for at least three runs. theta_d is that at the first threshold if it depends on one.")
    add_angle_tables(data, groups, angles)
    data.facts["coefficients"] = coefficients(angles, len(groups))
    data.tables.append(data.facts["coefficients"])
    return data


def coefficients(angles: Sequence[RunAngle], groups: int) -> Table:
    """Returns Pearson's coefficients of all pairs of angles, for each group."""
    pairs = [(first, second) for second in range(1, len(angles)) for first in range(second)]
    numbers = "; ".join(f"{k} {angle.meaning}" for k, angle in enumerate(angles, 1))
    columns = [column("first", "1", "number of the angle on the horizontal axis: " + numbers, [first + 1 for first, _ in pairs]),
               column("second", "1", "number of the angle on the vertical axis", [second + 1 for _, second in pairs])]
    for g in range(groups):
        found = [correlation_of(angles[first].values[g], angles[second].values[g]) for first, second in pairs]
        columns += [column(f"r_{g + 1}", "1", f"Pearson's coefficient of group {g + 1}", [each.coefficient for each in found]),
                    column(f"n_{g + 1}", "1", "runs that have both angles", [each.count for each in found])]
    return Table("coefficients", columns)


def draw_angle_correlations(data: Data, page: Page) -> Figure:
    """Draws a triangle of panels or, in one column, which is too narrow for it, a sequence of them."""
    angles, table = data.facts["angles"], data.facts["coefficients"]
    shown = [g for g in range(len(data.groups)) if not np.isnan(table[f"r_{g + 1}"]).all()]
    size, lines = len(angles) - 1, 0.3 * len(shown)
    if page.narrow:
        axes = panels(page, len(table), row=3.2 + lines)
    else:
        grid = panels(page, size * size, row=2.2 + lines, wide=size)
        places = [(second - 1) * size + first for second in range(1, size + 1) for first in range(second)]
        axes = [grid[k] for k in places]
        for k in set(range(size * size)) - set(places):
            grid[k].remove()
    for k, each in enumerate(axes):
        first, second = int(table["first"][k]) - 1, int(table["second"][k]) - 1
        for g, group in enumerate(data.groups):
            each.plot(group.table[angles[first][0]], group.table[angles[second][0]],
                      **curve_style(g) | {"linestyle": "none", "markersize": 2.2, "markeredgewidth": 0.6})
        for row, g in enumerate(shown):
            r = table[f"r_{g + 1}"][k]
            each.annotate("" if np.isnan(r) else f"$r$ = {r:.2f}".replace("-", "−"), (0, 1), (0, 2 + 8.5 * (len(shown) - 1 - row)),
                          xycoords="axes fraction", textcoords="offset points", fontsize=6.5, color=COLOURS[g % len(COLOURS)], gid=ABOVE)
        each.set_xlim(limits(data, angles[first][0]))
        each.set_ylim(limits(data, angles[second][0]))
        each.locator_params(nbins=4)
        each.tick_params(labelbottom=page.narrow or second == size, labelleft=page.narrow or first == 0)
        if has_numbers(each, "x"):
            set_title(each, "x", angles[first][1], "deg")
        if has_numbers(each, "y"):
            set_title(each, "y", angles[second][1], "deg")
    return arrange(axes, key_of_groups(data, True, linestyle="none"), page=page)


def limits(data: Data, name: str) -> tuple[float, float]:
    """Returns the range of all values of an angle, with room at both ends."""
    values = np.concatenate([group.table[name] for group in data.groups])
    low, high = np.nanmin(values), np.nanmax(values)
    room = 0.08 * (high - low) if high > low else 0.5
    return float(low - room), float(high + room)
