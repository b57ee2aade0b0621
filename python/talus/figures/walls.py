"""Effect of side walls on the stress of a bed (paper, section IV)."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure

from talus.ensemble import mean_of
from talus.figures.data import Data, Wanted, rounded, runs_text, shown_frames, shows_paper
from talus.figures.groups import Group, parts_by_length
from talus.figures.means import mean_rows
from talus.figures.panels import Key, Page, arrange, begin_at_zero, panels, points_with_errors
from talus.figures.runs import AnalysedRun
from talus.figures.style import LAW, as_math, curve_style, set_title
from talus.figures.tables import Table, column, literal
from talus.paper import WALL_COEFFICIENT, wall_law


def mean_weight(run: AnalysedRun) -> float:
    """Returns M g / (2 L), Pa, the mean of sigma_yy in a horizontal bed whose walls carry no weight; M is the mass of its free
    grains."""
    return float(run.core.mass * run.core.gravity / (2 * run.length * run.core.diameter))


def downslope(run: AnalysedRun, sections: np.ndarray) -> np.ndarray:
    """Returns values of sections in their order from the upper wall."""
    return sections[::-1] if run.rise[2] else sections


def wall_stress(groups: Sequence[Group], wanted: Wanted) -> Data | None:
    chosen = [(group, runs) for group in groups if not group.periodic and (runs := group.select(lambda run: run.failed and run.has_file))]
    if not chosen:
        return None
    group, runs = chosen[0]  # the shortest bed
    data = Data(f"Normal stress sigma_xx of sections along the bed over their distance x from the upper wall, {group.label}, in units "
                "of M g / (2 L), the mean of sigma_yy in a horizontal bed whose walls carry no weight (M: mass of the grains). Means over "
                f"{runs_text(len(runs))}, error bars: standard errors over these runs, none for a single run.", runs=list(runs))
    edges = runs[0].values("sections/edge")
    table = Table("", [column("x", "D", "middle of the section, from the upper wall downslope", 0.5 * (edges[1:] + edges[:-1]))])
    shown = [frames for frames in shown_frames([runs], wanted.at, ("0", "10", "repose"))[0] if len(frames.runs) == len(runs)]
    for frames in shown:
        mean, error = mean_rows([downslope(run, run.values("sections/sigma_xx")[k]) / mean_weight(run) for run, k in zip(runs, frames.frames)])
        name = "sigma_xx_" + frames.name
        table.columns += [column(name, "M g / (2 L)", "mean sigma_xx of the section", mean),
                          column(name + "_error", "M g / (2 L)", "its standard error over the runs", error)]
    data.caption += f" Shown {', '.join(frames.text for frames in shown)}."
    data.tables = [table]
    data.facts = {"shown": [(frames.name, frames.label) for frames in shown], "length": runs[0].length,
                  "bed": f"{literal(group.label)} ({runs_text(len(runs))})"}
    return data


def draw_wall_stress(data: Data, page: Page) -> Figure:
    axes = panels(page, 1, row=0.75 * page.width)
    table, key = data.tables[0], Key()
    key.line(data.facts["bed"], linestyle="none")
    for k, (name, label) in enumerate(data.facts["shown"]):
        name = "sigma_xx_" + name
        points_with_errors(axes[0], table["x"], table[name], dy=table[name + "_error"], **curve_style(k))
        key.line(label, **curve_style(k))
    axes[0].set_xlim(0, data.facts["length"])
    axes[0].set_ylim(0)
    set_title(axes[0], "x", "$x$", "D")
    set_title(axes[0], "y", "$σ_{xx}$ / ($M g$ / 2$L$)")
    return arrange(axes, key, page=page)


@dataclass(frozen=True)
class WallFit:
    """k_L - k_0 of the law 1 - (k_L - k_0)/3 H/L (T26) (paper, Eq. 15), fitted by least squares, and its standard error."""

    k: float
    error: float  #: NaN for a single point

    def __str__(self) -> str:
        return rounded(self.k) + ("" if np.isnan(self.error) else f" ± {rounded(self.error)}")


def fit_wall_law(depth_over_length: np.ndarray, ratio: np.ndarray) -> WallFit:
    """Fits the law to the ratios (sigma_T / sigma_N) / tan(theta) of beds."""
    x = depth_over_length
    k = float(3 * (x @ (1 - ratio)) / (x @ x))
    residual = ratio - wall_law(k, x)
    return WallFit(k, float(3 * np.sqrt(residual @ residual / (len(x) - 1) / (x @ x))) if len(x) > 1 else np.nan)


def mean_depth(run: AnalysedRun) -> float:
    """Returns the mean height V / L of a bed just before failure, D."""
    return float(run.series("packing/volume")[run.repose] / run.core.diameter**2 / run.length)


@dataclass
class WallSeries:
    """Beds between walls that differ only in their length."""

    name: str  #: what differs from other series: "μ = 0.2"; may be empty for a single one
    rows: slice  #: of the table
    fit: WallFit
    depth: float  #: mean height of the beds, D


def fit_text(series: WallSeries, several: bool) -> str:
    """Returns k_L - k_0 with what its error is, if it has one, and of which of several series it is."""
    notes = ["standard error"] * bool(np.isfinite(series.fit.error)) + [series.name] * several
    return f"{series.fit} ({'; '.join(notes)})" if notes else str(series.fit)


def wall_ratio(groups: Sequence[Group], wanted: Wanted) -> Data | None:
    data = Data()
    rows: list[tuple[float, ...]] = []
    series: list[WallSeries] = []
    # Sparse rows may leave none in the last 0.5 deg.
    of_group = {id(group): group.select(lambda run: run.failed and not np.isnan(run.number("packing/failure_ratio"))) for group in groups}
    walled = [group for group in groups if not group.periodic and of_group[id(group)]]
    if not walled:
        return None
    for name, part in parts_by_length(walled):
        first, depths, ratios, seen = len(rows), [], [], set()
        for group in part:
            # Runs that differ only in what followed their failure are one bed, and have the same ratio to the last bit.
            beds = {(run.length, run.seed, run.number("packing/failure_ratio")): run for run in of_group[id(group)]}
            runs = [run for bed, run in beds.items() if bed not in seen]
            seen |= beds.keys()
            if not runs:
                continue
            heights = [mean_depth(run) for run in runs]
            each = [run.number("packing/failure_ratio") for run in runs]
            spread = np.sqrt(np.mean([run.number("packing/failure_ratio_spread") ** 2 for run in runs]))
            mean = mean_of(each)
            rows.append((runs[0].length, len(runs), mean.mean, mean.error, spread, mean.error if len(runs) > 1 else spread, np.mean(heights)))
            depths += [height / run.length for height, run in zip(heights, runs)]
            ratios += each
            data.runs += runs
        height = float(np.mean([row[-1] for row in rows[first:]]))
        series.append(WallSeries(name, slice(first, len(rows)), fit_wall_law(np.array(depths), np.array(ratios)), height))
    names = (("L", "D", "length of the bed"), ("n", "1", "number of runs in the row"),
             ("ratio", "1", "(sigma_T / sigma_N) / tan(theta), mean over the last 0.5 deg before theta_c and over runs"),
             ("ratio_error", "1", "its standard error over the runs"),
             ("ratio_spread", "1", "standard deviation within these 0.5 deg, rms over the runs"),
             ("bar", "1", "what the error bar shows: ratio_error, or ratio_spread for a single run"),
             ("H", "D", "mean height V / L of the bed before failure"))
    data.tables = [Table("", [column(*name, values) for name, values in zip(names, np.transpose(rows))])]
    several = len(series) > 1
    if several:
        numbers = [k for k, each in enumerate(series, 1) for _ in range(each.rows.start, each.rows.stop)]
        meaning = "beds that differ only in their length: " + "; ".join(f"{k} {each.name}" for k, each in enumerate(series, 1))
        data.tables[0].columns.append(column("series", "1", meaning, numbers))
    paper = shows_paper(walled, wanted)
    its = ", and with the paper's 2.5" if paper else ""
    fits = "; ".join(fit_text(each, several) for each in series)
    means = ", ".join(rounded(each.depth, 1) for each in series)
    data.caption = (
        "(sigma_T / sigma_N) / tan(theta) of beds between walls over their length L, mean over the last 0.5 deg before theta_c and "
        f"over the runs of each length ({runs_text(len(data.runs))} in total). Error bars: standard error over the runs; for a single "
        "run the standard deviation within the 0.5 deg. Lines: 1 - (k_L - k_0)/3 H/L (paper, Eq. 15), fitted to all runs "
        f"{'of a series ' if several else ''}by least squares, k_L - k_0 = {fits}{its}. H is the mean height V/L of each bed before "
        f"failure, as in the paper's integral over the depth; the lines use its mean, H = {means} D.")
    data.facts = {"series": series, "paper": paper}
    return data


def draw_wall_ratio(data: Data, page: Page) -> Figure:
    axes = panels(page, 1, row=0.75 * page.width)
    table, key, series = data.tables[0], Key(), data.facts["series"]
    at = np.linspace(0.8 * table["L"].min(), 1.1 * table["L"].max(), 200)
    for k, each in enumerate(series):
        law = f"$k_L − k_0$ = {each.fit}"
        line, points = curve_style(k if len(series) > 1 else 1, symbols=False), curve_style(k) | {"linestyle": "none"}
        if len(series) > 1:
            key.line(as_math(f"{each.name}: ") + law, **curve_style(k))
        else:
            key.line("beds between walls", **points)
            key.line(f"fit, {law}", **line)
        axes[0].plot(at, wall_law(each.fit.k, each.depth / at), **line)
        points_with_errors(axes[0], table["L"][each.rows], table["ratio"][each.rows], dy=table["bar"][each.rows], **points)
    if data.facts["paper"]:
        key.line(f"paper, $k_L − k_0$ = {WALL_COEFFICIENT}", **LAW)
        depth = float(np.mean([each.depth for each in series]))
        axes[0].plot(at, wall_law(WALL_COEFFICIENT, depth / at), **LAW)
    axes[0].set_xlim(at[0], at[-1])
    begin_at_zero(axes[0], table["ratio"] - np.nan_to_num(table["bar"]))
    set_title(axes[0], "x", "$L$", "D")
    set_title(axes[0], "y", r"($σ_T / σ_N$) / $\mathrm{tan}\ θ$ at $θ_c$")
    return arrange(axes, key, page=page)
