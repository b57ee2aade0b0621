"""Curves over the tilt, or over the angle left to failure: means over the runs of each group."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from talus.figures.angles import Estimator, estimators_of
from talus.figures.data import Data, GroupTable, Wanted, reading, runs_text, shows_paper
from talus.figures.groups import Group
from talus.figures.means import SAME_ANGLE, Abscissa, Series, mean_columns, run_curve, series_of, shown_series
from talus.figures.panels import (Key, Page, arrange, band, begin_at_zero, draw_curves, has_numbers, key_of_curves, mark_panels, panels,
                                  points_with_errors, set_range)
from talus.figures.runs import AnalysedRun, quantities
from talus.figures.style import AXIS, COLOURS, CROSS, LAW, MARK, as_math, curve_style, letter, set_title
from talus.figures.tables import Column, Table, column, short_text
from talus.ensemble import mean_of
from talus.paper import CHAIN, PACKING

THETA = "$θ$"
ANGLE_LEFT = "$θ_c − θ$"
TEXTS = {"theta": "the tilt theta", "angle_left": "theta_c - theta, the angle left to failure"}


def all_runs(group: Group) -> list[AnalysedRun]:
    return group.runs


def failed_runs(group: Group) -> list[AnalysedRun]:
    return group.select(lambda run: run.failed)


def overloaded_runs(group: Group) -> list[AnalysedRun]:
    """Returns the runs of a periodic group that have a threshold, and hence overloaded grains."""
    return group.select(lambda run: run.periodic and run.thresholds)


@dataclass(frozen=True)
class Curves:
    """Data of a figure that shows quantities over an angle, by group."""

    caption: str
    columns: tuple[tuple[str, str], ...]  #: names of columns with their quantities
    runs: Callable[[Group], list[AnalysedRun]] = all_runs
    by_threshold: bool = False  #: a column NAME_FACTOR for each threshold
    paper: tuple[tuple[str, str, str, tuple[float, ...]], ...] = ()  #: name, unit, meaning and values of the paper at ITS_TILTS

    def __call__(self, groups: Sequence[Group], wanted: Wanted) -> Data | None:
        data = Data(self.caption)
        chosen = [(group, runs) for group in groups if (runs := self.runs(group))]
        shows = bool(self.paper) and shows_paper([group for group, _ in chosen], wanted)
        if shows:
            data.caption += PAPER_TEXT
        if self.by_threshold and chosen:
            data.caption += " " + reading(chosen[0][1][0])
        for group, runs in chosen:
            data.add_curves(group, runs, self.series(runs[0], data))
        if shows:
            data.tables.append(Table("paper", [column("theta", "deg", "tilt", ITS_TILTS), *(column(*row) for row in self.paper)]))
        if not chosen:
            return None
        data.describe_means(wanted)
        return data

    def series(self, run: AnalysedRun, data: Data) -> list[Series]:
        """Returns the columns; sets the thresholds of a figure that depends on them."""
        if not self.by_threshold:
            return [series_of(name, quantity) for name, quantity in self.columns]
        data.facts["factors"] = [short_text(factor) for factor in run.values("threshold_factor")]
        return [series_of(f"{name}_{factor}", quantity, f, f", for gamma >= {factor} Gamma_c")
                for f, factor in enumerate(data.facts["factors"]) for name, quantity in self.columns]


#: The paper's tilts 0, theta_d and theta_c, deg.
ITS_TILTS = (0.0, CHAIN["theta_d_by_jump"].value, PACKING["theta_c"].value)
PAPER_TEXT = (" Crosses: the paper's values at 0, theta_d = 15 deg and theta_c = 20 deg, the middle of its range of 19 to 21 deg, in "
              "each panel.")


def its(*keys: str) -> tuple[float, ...]:
    """Returns values of the paper."""
    return tuple(CHAIN[key].value for key in keys)


shear_stress = Curves(
    "Shear over normal stress of the packing, sigma_T / sigma_N, over the tangent of the tilt theta, up to theta_c. Dotted: sigma_T "
    "/ sigma_N = tan(theta), equilibrium of a periodic bed (paper, Eq. 10).", (("ratio", "packing/sigma_t_over_n"),))
stress_ratio = Curves(
    "Stress ratio Gamma = Q/P of the packing over the sine of the tilt theta, up to theta_c. Dotted: Gamma = sin(theta), the least "
    "value for a periodic bed in equilibrium without rolling friction (paper, Eq. 11).", (("ratio", "packing/stress_ratio"),))
overloaded_fraction = Curves(
    "Fraction p_o of overloaded grains among those that carry something over the tilt theta, for each threshold: gamma >= Gamma_c = "
    "sin(theta_c) as printed in the paper, and multiples of it.", (("p_o", "overloaded/fraction"),), overloaded_runs, True,
    (("p_o", "1", "overloaded fraction", its("overloaded_at_0", "overloaded_at_theta_d", "overloaded_at_theta_c")),))
_lengths = Curves(
    "Coarse-graining length l_c, a diameter, of the overloaded grains over the tilt theta, with a panel for each threshold: first "
    "the mean, then the largest. Dashed lines: the cut of each bed at which the search for l_c ends.",
    (("mean", "lc/mean"), ("max", "lc/max")), overloaded_runs, True,
    (("mean", "D", "mean l_c", its("lc_mean_at_0", "lc_mean_at_theta_d", "lc_mean_at_theta_c")),
     ("max", "D", "largest l_c", its("lc_max_at_0", "lc_max_before_jump", "lc_max_after_jump"))))


def coarse_graining_length(groups: Sequence[Group], wanted: Wanted) -> Data | None:
    data = _lengths(groups, wanted)
    if data is not None:
        of_groups = [runs for group in groups if (runs := overloaded_runs(group))]
        for table, runs in zip(data.groups, of_groups):
            table.facts["cut"] = max(run.number("lc/cut") for run in runs)
    return data


def draw_over_sine(data: Data, page: Page, function: Callable[[np.ndarray], np.ndarray], titles: tuple[str, str], law: str) -> Figure:
    """Draws a ratio over tan(theta) or sin(theta), which it equals in equilibrium."""
    axes = panels(page, 1, row=0.75 * page.width)
    key = key_of_curves(data)
    key.line(law, **LAW)
    draw_curves(axes[0], data, "ratio", x=lambda theta: function(np.radians(theta)))
    end = 1.05 * function(np.radians(largest_angle(data)))
    axes[0].plot([0, end], [0, end], **LAW)
    axes[0].set_xlim(0, end)
    begin_at_zero(axes[0], np.concatenate([group.table["ratio"] for group in data.groups]))
    set_title(axes[0], "x", titles[0])
    set_title(axes[0], "y", titles[1])
    return arrange(axes, key, page=page)


def draw_shear_stress(data: Data, page: Page) -> Figure:
    return draw_over_sine(data, page, np.tan, (r"$\mathrm{tan}\ θ$", "$σ_T$ / $σ_N$"), r"$σ_T$ / $σ_N$ = $\mathrm{tan}\ θ$")


def draw_stress_ratio(data: Data, page: Page) -> Figure:
    return draw_over_sine(data, page, np.sin, (r"$\mathrm{sin}\ θ$", "Γ"), r"Γ = $\mathrm{sin}\ θ$")


def largest_angle(data: Data) -> float:
    """Returns the largest angle of the curves, deg; 1 if all are 0, because an axis needs a length."""
    return max((group.table.columns[0].values.max(initial=0) for group in data.groups), default=0) or 1.0


def threshold_title(factor: str) -> str:
    return f"$γ$ ≥ {'' if factor == '1' else factor + ' '}Γ$_c$"


def shown_factors(data: Data, name: str) -> list[str]:
    """Returns the thresholds at which a column has a number other than 0: no grain reaches a threshold above 1."""
    return [factor for factor in data.facts["factors"]
            if any(np.nan_to_num(group.table[f"{name}_{factor}"]).any() for group in data.groups
                   if f"{name}_{factor}" in group.table)] or data.facts["factors"][:1]


def paper_table(data: Data) -> Table | None:
    return next((table for table in data.tables if table.name == "paper"), None)


def tilt_end(data: Data) -> float:
    return 1.04 * max(largest_angle(data), 21.0 if paper_table(data) else 0.0)


def draw_overloaded_fraction(data: Data, page: Page) -> Figure:
    factors = shown_factors(data, "p_o")
    axes = panels(page, len(factors), row=5 if page.narrow else 6.2, wide=2, narrow=1, share_x=True, share_y=True)
    draw_thresholds(data, axes, "p_o", factors, 0)
    for each in axes:
        each.set_ylim(0, 1)
        if has_numbers(each, "y"):
            set_title(each, "y", "$p_o$")
    return arrange(axes, key_with_paper(data), page=page)


def draw_thresholds(data: Data, axes: Sequence[Axes], name: str, factors: Sequence[str], first: int) -> None:
    """Draws a column at each threshold in a panel of its own, with the paper's values. `first`: number of panels before."""
    paper = paper_table(data)
    for k, (each, factor) in enumerate(zip(axes, factors), first):
        draw_curves(each, data, f"{name}_{factor}")
        if paper is not None:
            each.plot(paper["theta"], paper[name], **CROSS)
        each.set_xlim(0, tilt_end(data))
        mark = f"{letter(k)} " if first or len(axes) > 1 else ""
        each.set_title(mark + threshold_title(factor), loc="left")
        if has_numbers(each, "x"):
            set_title(each, "x", THETA, "deg")


def key_with_paper(data: Data, cut: str = "") -> Key:
    key = key_of_curves(data)
    if cut:
        key.line(cut, **MARK)
    if paper_table(data) is not None:
        key.line("paper", **CROSS)
    return key


def draw_coarse_graining_length(data: Data, page: Page) -> Figure:
    """Draws the mean above, the largest value below; a panel for each threshold, with one range for each row."""
    factors = shown_factors(data, "mean")
    count = len(factors)
    axes = panels(page, 2 * count, row=4.4 if page.narrow else 5.2, wide=count, narrow=1, share_x=True)
    cuts = [group.facts["cut"] for group in data.groups]
    one_cut = len(set(cuts)) == 1
    paper = paper_table(data)
    for row, name in enumerate(("mean", "max")):
        of_row = axes[row * count : (row + 1) * count]
        draw_thresholds(data, of_row, name, factors, row * count)
        if count == 1:
            of_row[0].set_title(f"{letter(row)} {threshold_title(factors[0])}", loc="left")
        if name == "max":
            for each in of_row:
                for k, cut in enumerate(cuts[:1] if one_cut else cuts):
                    each.axhline(cut, **(MARK if one_cut else MARK | {"color": COLOURS[k % len(COLOURS)]}))
            top = 1.2 * max([*cuts, *(paper["max"] if paper is not None else [])])
        else:
            highest = max(each.dataLim.y1 for each in of_row)
            top = 1.05 * highest if np.isfinite(highest) and highest > 0 else 1.0
        for each in of_row:
            each.set_ylim(0, top)
            set_title(each, "y", f"$ℓ_c$, {'mean' if name == 'mean' else 'largest'}", "D")
    return arrange(axes, key_with_paper(data, "cut" if one_cut else "cut of each bed, in its colour"), page=page)


# Volume strain (paper, Fig. 14).


def volume_strain(groups: Sequence[Group], wanted: Wanted) -> Data | None:
    data = Data("Strain of periodic beds since the start of the tilt: (a) of the volume below the free surface, (b) of the height of "
                "the centre of mass; negative: contraction. (c) theta_d by each estimator, mean and standard error over the runs that "
                "have one: jump of the largest l_c and first cluster that spans from floor to surface, for each threshold, and onset "
                "of dilation by either strain")
    periodic = [group for group in groups if group.periodic]
    if not periodic:
        return None
    data.facts["paper"] = shows_paper(periodic, wanted)
    data.caption += "; dashed: the paper's 15 deg." if data.facts["paper"] else "."
    for group in periodic:
        data.add_curves(group, group.runs, [series_of("volume_strain", "packing/volume_strain"),
                                            series_of("centre_of_mass_strain", "packing/centre_of_mass_strain")])
    estimators = estimators_of([run for group in periodic for run in group.runs])
    data.facts["estimators"] = [each.label for each in estimators]
    for added, group in zip(data.groups, periodic):
        added.facts["theta_d"] = theta_d_table("theta_d-" + added.table.name, group.runs, estimators)
        data.tables.append(added.facts["theta_d"])
    data.describe_means(wanted)
    return data


def theta_d_table(name: str, runs: Sequence[AnalysedRun], estimators: Sequence[Estimator]) -> Table:
    """Returns a row for each estimator: theta_d as a mean over the runs that have one."""
    means = [mean_of([estimator.theta_d(run) for run in runs]) for estimator in estimators]
    meanings = "; ".join(f"{k} {each.meaning}" for k, each in enumerate(estimators, 1))
    return Table(name, [column("estimator", "1", meanings, np.arange(1, len(means) + 1)),
                        column("n", "1", "runs that have a theta_d by this estimator", [mean.count for mean in means]),
                        column("theta_d", "deg", "theta_d, mean over these runs", [mean.mean for mean in means]),
                        column("theta_d_error", "deg", "its standard error over these runs", [mean.error for mean in means])])


def draw_volume_strain(data: Data, page: Page) -> Figure:
    axes = panels(page, 3, row=page.width * 0.45 if page.narrow else 5.2, wide=1, narrow=1, share_x=True)
    key = key_of_curves(data)
    if data.facts["paper"]:
        key.line("paper, $θ_d$ = 15°", **MARK)
        axes[2].axvline(15, **MARK)
    for each, name, title in zip(axes, ("volume_strain", "centre_of_mass_strain"), ("$ε_V$", "$ε_y$")):
        each.axhline(0, **AXIS)
        draw_curves(each, data, name)
        set_range(each)
        set_title(each, "y", title)
    names = data.facts["estimators"]
    for k, group in enumerate(data.groups):
        table = group.facts["theta_d"]
        rows = table["estimator"] + 0.2 * (0.5 * (len(data.groups) - 1) - k)
        points_with_errors(axes[2], table["theta_d"], rows, dx=table["theta_d_error"], **curve_style(k) | {"linestyle": "none"})
    axes[2].set_ylim(0.4, len(names) + 0.6)
    axes[2].set_yticks(range(1, len(names) + 1), names)
    axes[2].tick_params(axis="y", length=0)
    longest = max(largest_angle(data), 15.0 if data.facts["paper"] else 0.0)
    axes[2].set_xlim(-0.02 * longest, 1.04 * longest)
    set_title(axes[2], "x", THETA, "deg")
    mark_panels(axes)
    return arrange(axes, key, page=page)


# Every quantity that has a title, in panels.

PRECURSORS = ("contacts/critical_share", "contacts/critical_share_of_bound", "contacts/critical_mean", "texture/contacts",
              "rigid/redundant", "rigid/largest_share")


@dataclass(frozen=True)
class Quantities:
    """Data of a figure with a panel for each quantity of frames that curves show, or for some of them."""

    caption: str
    abscissa: Abscissa = "theta"
    only: tuple[str, ...] = ()

    def __call__(self, groups: Sequence[Group], wanted: Wanted) -> Data | None:
        data = Data(self.caption)
        for group in groups:
            if runs := runs_over(group, self.abscissa):
                data.add_curves(group, runs, quantity_columns(self.only), self.abscissa)
        if not data.groups:
            return None
        data.describe_means(wanted)
        data.facts["panels"] = quantities_with_values([group.table for group in data.groups])
        return data


def runs_over(group: Group, abscissa: Abscissa) -> list[AnalysedRun]:
    return group.runs if abscissa == "theta" else failed_runs(group)


def quantity_columns(only: Sequence[str] = ()) -> list[Series]:
    return [shown_series(row) for row in quantities().values() if row.title and row.shape in ("T", "T F") and (not only or row.name in only)]


def quantities_with_values(tables: Sequence[Table]) -> list[str]:
    """Returns the quantities that have a number in a table."""
    return [row.name for row in quantity_columns() if any(row.name in table and not np.isnan(table[row.name]).all() for table in tables)]


def draw_quantities(data: Data, page: Page) -> Figure:
    names = data.facts["panels"]
    axes = panels(page, len(names), row=3.2 if page.narrow else 3.6, share_x=True)
    for k, (each, name) in enumerate(zip(axes, names)):
        draw_curves(each, data, name, symbols=False)
        finish_quantity(each, name, data.groups[0].table.columns[0].name, largest_angle(data), letter(k) if len(names) > 1 else "")
    return arrange(axes, key_of_curves(data, symbols=False), page=page)


def finish_quantity(axes: Axes, name: str, abscissa: str, largest: float, mark: str) -> None:
    """Sets ranges and titles of the panel of a quantity, up to the failure of each run at the right."""
    row = quantities()[name]
    share = row.unit == "1" and "share of" in row.definition
    set_range(axes, (100.0 if row.percent else 1.0) if share else None)
    axes.set_xlim((0, 1.04 * largest) if abscissa == "theta" else (1.04 * largest, 0))
    set_title(axes, "y", as_math(row.title), "%" if row.percent else row.unit, heading=mark)
    if has_numbers(axes, "x"):
        set_title(axes, "x", THETA if abscissa == "theta" else ANGLE_LEFT, "deg")


# Differences of two groups.


@dataclass(frozen=True)
class Differences:
    """Data of the means of the second of two groups minus those of the first."""

    abscissa: Abscissa = "theta"

    def __call__(self, groups: Sequence[Group], wanted: Wanted) -> Data | None:
        chosen = [runs_over(group, self.abscissa) for group in groups]
        if len(groups) != 2 or not all(chosen):
            return None
        series = quantity_columns()
        means = [mean_columns([run_curve(run, series, self.abscissa) for run in runs], series, self.abscissa) for runs in chosen]
        table = Table("", difference_columns(Table("", means[0]), Table("", means[1]), series))
        if not len(table):
            return None
        first, second = (group.label for group in groups)
        data = Data(
            f"Difference of the means of two groups of runs over {TEXTS[self.abscissa]}, {second} minus {first}, at the angles that "
            "both have, as long as at least half of the runs of each have not failed; at the first threshold if they depend on one. "
            "The dark band is the standard error of the difference, the root of the sum of the squares of both standard errors, the "
            "light one twice that; there are no bands if a group has a single run.",
            [GroupTable(f"{groups[1].legend} − {groups[0].legend}", table)], [table], chosen[0] + chosen[1])
        data.facts["panels"] = quantities_with_values([table])
        return data


def difference_columns(first: Table, second: Table, series: Sequence[Series]) -> list[Column]:
    """Returns the angles that both tables have, then the difference of each quantity and its error."""
    at, other = first.columns[0], second.columns[0]
    a = np.array([k for k, angle in enumerate(at.values) if np.any(np.abs(other.values - angle) < 1e-4)], int)
    b = np.array([int(np.argmin(np.abs(other.values - angle))) for angle in at.values[a]], int)
    columns = [column(at.name, at.unit, at.meaning, at.values[a])]
    for each in series:
        error = each.name + "_error"
        columns += [
            column(each.name, each.unit, "mean of the second group minus that of the first", second[each.name][b] - first[each.name][a]),
            column(error, each.unit, "root of the sum of the squares of both standard errors", np.hypot(second[error][b], first[error][a]))]
    return columns


def draw_differences(data: Data, page: Page) -> Figure:
    names, table = data.facts["panels"], data.groups[0].table
    look = {"color": COLOURS[1]}
    axes = panels(page, len(names), row=3.2 if page.narrow else 3.6, share_x=True)
    at = table.columns[0].values
    for k, (each, name) in enumerate(zip(axes, names)):
        band(each, at, table[name], 2 * table[name + "_error"], alpha=0.13, **look)
        band(each, at, table[name], table[name + "_error"], alpha=0.4, **look)
        each.axhline(0, **AXIS)
        each.plot(at, table[name], **look)
        finish_quantity(each, name, table.columns[0].name, at.max(initial=0) or 1.0, letter(k) if len(names) > 1 else "")
    key = Key()
    key.line(as_math(data.groups[0].legend), **look)
    key.box("± its standard error", alpha=0.4, **look)
    key.box("± twice that", alpha=0.13, **look)
    return arrange(axes, key, page=page)
