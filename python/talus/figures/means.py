"""Means over runs: of numbers, and of curves at the same tilt or at the same distance to failure."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from talus.ensemble import Mean, mean_of
from talus.figures.runs import AnalysedRun, Quantity, quantities
from talus.figures.tables import Column, column

#: Angles within this are equal, deg; frames of a run are in practice at least 0.01 deg apart.
SAME_ANGLE = np.degrees(1e-6)
#: Largest number of single runs that are drawn behind their mean.
MOST_RUNS = 100
#: Abscissa of curves: the tilt theta, or theta_c - theta, the angle left to the failure of each run.
Abscissa = Literal["theta", "angle_left"]


def student_t(freedom: int) -> float:
    """Returns the two-sided quantile of Student's t distribution at 95 %, freedom >= 1 (Abramowitz and Stegun 1964, table
    26.10; from 31 degrees of freedom on their expansion 26.7.5 to n^-2, within 1e-4)."""
    table = (12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145, 2.131,
             2.120, 2.110, 2.101, 2.093, 2.086, 2.080, 2.074, 2.069, 2.064, 2.060, 2.056, 2.052, 2.048, 2.045, 2.042)
    if freedom <= len(table):
        return table[freedom - 1]
    z = 1.959964
    return z + (z**3 + z) / (4 * freedom) + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * freedom**2)


def half_interval(mean: Mean) -> float:
    """Returns half the width of the 95 % confidence interval of a mean (Student's t); NaN for fewer than two values."""
    return student_t(mean.count - 1) * mean.error if mean.count > 1 else np.nan


def paired_difference(values: Sequence[float], baseline: Sequence[float]) -> Mean:
    """Returns the mean of values - baseline over the pairs without NaN, one for each seed. If the deviation is within
    round-off, deviation and error are 0."""
    one, other = np.asarray(values, float), np.asarray(baseline, float)
    known = ~np.isnan(one - other)
    found = mean_of((one - other)[known])
    largest = max(np.abs(one[known]).max(initial=0), np.abs(other[known]).max(initial=0))
    return found._replace(deviation=0.0, error=0.0) if found.deviation <= 1e-13 * largest else found


class Correlation(NamedTuple):
    coefficient: float  #: NaN for fewer than three pairs, or if one side does not vary
    count: int  #: pairs without NaN


def correlation_of(left: np.ndarray, right: np.ndarray) -> Correlation:
    """Returns Pearson's coefficient of correlation over the pairs without NaN."""
    known = ~np.isnan(left) & ~np.isnan(right)
    a, b = left[known], right[known]
    if len(a) < 3:
        return Correlation(np.nan, len(a))
    a, b = a - a.mean(), b - b.mean()
    scale = np.sqrt((a @ a) * (b @ b))
    return Correlation(float(a @ b / scale) if scale > 0 else np.nan, len(a))


@dataclass(frozen=True)
class Series:
    """A number for each frame of a run, as a column of figures."""

    name: str  #: "p_o"
    unit: str
    meaning: str
    values: Callable[[AnalysedRun], np.ndarray]  #: (frames,); NaN if there is none
    has_side: bool = False  #: its sign changes if the bed slopes backwards


def series_of(name: str, quantity: str, k: int = 0, more: str = "") -> Series:
    """Returns the column `name` of a quantity, at threshold k if it depends on one. `more` ends its meaning."""
    row = quantities()[quantity]
    return Series(name, row.unit, row.definition + more, lambda run: run.series(quantity, k), row.has_side)


def shown_series(row: Quantity) -> Series:
    """Returns the column of a quantity in the unit of curves, in which small shares are in percent."""
    factor, unit = (100, "%") if row.percent else (1, row.unit)
    return Series(row.name, unit, row.definition, lambda run: factor * run.series(row.name), row.has_side)


@dataclass
class RunCurve:
    """The columns of one run in the frames up to its theta_c, as if the bed sloped forwards."""

    at: np.ndarray  #: (points,) deg, ascending
    values: np.ndarray  #: (columns, points)


def interpolated(at: np.ndarray, values: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """Returns values (columns, points) at other angles, interpolated linearly between the points and not beyond; NaN if one
    of the two neighbours is NaN."""
    upper = np.searchsorted(at, wanted - SAME_ANGLE)
    inside = upper < len(at)
    k = np.minimum(upper, len(at) - 1)
    equal = inside & (at[k] <= wanted + SAME_ANGLE)
    between = inside & ~equal & (k > 0)
    below = np.where(between, k - 1, k)
    width = np.where(between, at[k] - at[below], 1)
    share = np.where(between, (wanted - at[below]) / width, 0)
    found = values[:, below] + np.where(share == 0, 0, share * (values[:, k] - values[:, below]))
    return np.where(equal | between, found, np.nan)


def run_curve(run: AnalysedRun, columns: Sequence[Series], abscissa: Abscissa = "theta") -> RunCurve:
    """Returns the curve of a run over its last rise, or over theta_c - theta at multiples of the spacing of its frames."""
    first, tilts, mirrored = run.rise
    tilts = tilts[~(tilts > run.theta_c)]
    values = np.array([(-1 if each.has_side and mirrored else 1) * each.values(run)[first : first + len(tilts)]
                       for each in columns])
    if abscissa == "theta":
        return RunCurve(tilts, values)
    if not run.failed or not len(tilts):
        return RunCurve(np.zeros(0), np.zeros((len(columns), 0)))
    spacing = run.scenario["output"]["frame_every"]
    left = spacing * np.arange(int((run.theta_c - tilts[0] + SAME_ANGLE) / spacing) + 2)
    left = left[run.theta_c - left > tilts[0] - SAME_ANGLE]
    values = interpolated(tilts, values, run.theta_c - left)
    known = ~np.isnan(values).all(axis=0)
    return RunCurve(left[known], values[:, known])


class Means(NamedTuple):
    """Statistics of several columns at common angles."""

    at: np.ndarray  #: (points,) deg, ascending
    n: np.ndarray  #: (points,) number of runs, at least half of all
    mean: np.ndarray  #: (columns, points); NaN values do not count
    error: np.ndarray  #: standard error of the mean; NaN for fewer than two values
    deviation: np.ndarray  #: standard deviation, with n - 1; NaN for fewer than two values


def means_of(curves: Sequence[RunCurve]) -> Means:
    """Returns the means over curves at the angles that at least half of them have. Angles within SAME_ANGLE of the
    smallest of them are one."""
    at = np.concatenate([curve.at for curve in curves])
    order = np.argsort(at, kind="stable")
    at = at[order]
    starts = []
    start = 0
    while start < len(at):
        starts.append(start)
        start = int(np.searchsorted(at, at[start] + SAME_ANGLE, side="right"))
    n = np.diff([*starts, len(at)])
    kept = 2 * n >= len(curves)
    values = np.concatenate([curve.values for curve in curves], axis=1)[:, order]
    mean, error, deviation = statistics(values, np.array(starts, int))
    return Means(at[starts][kept] if starts else at, n[kept], mean[:, kept], error[:, kept], deviation[:, kept])


def statistics(values: np.ndarray, starts: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Returns mean, standard error and deviation of the values (columns, samples) in each part that begins at `starts`."""
    if not len(starts):
        empty = np.zeros((len(values), 0))
        return empty, empty, empty
    known = ~np.isnan(values)
    count = np.add.reduceat(known.astype(int), starts, axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = np.add.reduceat(np.where(known, values, 0), starts, axis=1) / count
        parts = np.repeat(mean, np.diff([*starts, values.shape[1]]), axis=1)
        squares = np.add.reduceat(np.where(known, values - parts, 0) ** 2, starts, axis=1)
        variance = np.where(count > 1, squares / (count - 1), np.nan)
        return mean, np.sqrt(variance / count), np.sqrt(variance)


def mean_rows(rows: Sequence[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Returns the mean over several arrays of one length, one for each run, and its standard error."""
    values = np.array(rows, dtype=float)
    mean, error, _ = statistics(values.T, np.array([0]))
    return mean[:, 0], error[:, 0]


def angle_column(abscissa: Abscissa, values: np.ndarray) -> Column:
    return column(abscissa, "deg", "tilt" if abscissa == "theta" else "theta_c - theta, with the theta_c of each run", values)


def mean_columns(curves: Sequence[RunCurve], columns: Sequence[Series], abscissa: Abscissa) -> list[Column]:
    """Returns the angle, n, and for each column NAME, NAME_error and NAME_deviation: the means over the runs."""
    means = means_of(curves)
    found = [angle_column(abscissa, means.at), column("n", "1", "number of runs in the row", means.n)]
    for k, each in enumerate(columns):
        found += [column(each.name, each.unit, each.meaning, means.mean[k]),
                  column(each.name + "_error", each.unit, "its standard error over the runs", means.error[k]),
                  column(each.name + "_deviation", each.unit, "its standard deviation over the runs", means.deviation[k])]
    return found


def run_columns(runs: Sequence[AnalysedRun], curves: Sequence[RunCurve], columns: Sequence[Series],
                abscissa: Abscissa) -> list[Column]:
    """Returns the seed, the angle and each column, run by run, for the first MOST_RUNS runs."""
    curves = curves[:MOST_RUNS]
    seeds = np.repeat([float(run.seed) for run in runs[: len(curves)]], [len(curve.at) for curve in curves])
    values = np.concatenate([curve.values for curve in curves], axis=1)
    return [column("seed", "1", "seed of the run", seeds), angle_column(abscissa, np.concatenate([c.at for c in curves])),
            *(column(each.name, each.unit, each.meaning, values[k]) for k, each in enumerate(columns))]
