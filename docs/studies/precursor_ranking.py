#!/usr/bin/python3
"""Ranks the quantities measured in a frame by how well they predict the distance of a slope from failure.

    python3 docs/studies/precursor_ranking.py runs/beds/ensemble.h5 -o figures/precursor-ranking.csv
    python3 docs/studies/precursor_ranking.py runs/beds/seed-*[0-9].h5 -o figures/precursor-ranking.csv
    python3 docs/studies/precursor_ranking.py figures/precursor-ranking.csv -o figures/precursor-ranking.png
    python3 docs/studies/precursor_ranking.py figures/precursor-ranking.csv --rows 20

The beds are the members of an ensemble.h5 (its first variant), or runs with a stored analysis, tilted from 0 to failure.
The table of the ranking is written as CSV, the figure as PNG, PDF or SVG, and without -o the table is printed as
Markdown; each can also be made from an existing table. docs/studies/announcing-failure.md describes the method and its
result.

It needs Debian's python3-numpy; python3-h5py (and python3-xxhash, for runs) to read beds; python3-matplotlib to draw."""

import argparse
import csv
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

#: Angles theta_c - theta at which a measure is read, deg.
DISTANCES = np.arange(1, 33) * 0.25
#: Distances that have columns of their own in the table, deg.
SHOWN = (1, 2, 3)
#: A bed is compared with itself at these tilts, far from failure, deg.
FAR = (5, 10)
#: Angles that differ by less are the same, deg.
SAME_ANGLE = 1e-6
#: A measure is calibrated with at least this number of other beds.
MIN_CALIBRATION = 5
#: A ranking is made of at least this number of beds.
MIN_BEDS = 8
#: Two measures that are correlated more closely than this are the same; beyond it, rounding errors decide.
MAX_CORRELATION = 0.999
#: Smallest deviation of a measure at one distance, over that at all distances: a count that is zero in each of the few
#: beds that calibrate it is not known exactly.
MIN_DEVIATION = 0.01


@dataclass
class Beds:
    """Measures of several slopes that have failed, under the names of docs/analysis.md."""

    theta_c: np.ndarray  #: deg, of each bed
    gamma_c: np.ndarray  #: threshold of overload of each bed
    near: dict[str, np.ndarray]  #: of each bed (row), at each of DISTANCES (column)
    far: dict[str, np.ndarray]  #: of each bed, its mean over the tilts of FAR


# ---- Reading.


def beds_of_ensemble(path):
    """The beds of the first variant of an ensemble.h5, which has the analyses of its members one after the other."""
    import h5py

    with h5py.File(path) as file:
        analysis = file["variants/0/analysis"]
        ends = np.cumsum(analysis["frames"][:])
        columns = {}

        def read(name, values):
            if isinstance(values, h5py.Dataset) and len(values) == ends[-1] and name != "tilt":
                columns[name] = values[:]

        analysis.visititems(read)
        members = [slice(end - count, end) for count, end in zip(analysis["frames"][:], ends)]
        tilt = np.degrees(analysis["tilt"][:])
        return collected((theta_c, gamma_c, tilt[rows], {name: values[rows] for name, values in columns.items()})
                         for theta_c, gamma_c, rows in zip(np.degrees(analysis["theta_c"][:]), analysis["gamma_c"][:], members))


def beds_of_runs(paths):
    """The beds of runs whose analysis is stored."""
    import talus
    from talus.schema import DATA_SETS

    def read(path):
        with talus.open(path) as run:
            rows = run.frames_of_tilt
            names = [name for name in run.analysis if DATA_SETS.get(f"analysis/{name}", ("", "", ""))[1] in ("T", "T F")]
            return run.theta_c, run.analysis["gamma_c"], run.tilt[:rows], {name: run.analysis[name] for name in names}

    return collected(map(read, paths))


def collected(beds):
    """Beds of theta_c (deg), Gamma_c, and tilt (deg) and measures of each frame, at thresholds or not. Those that have not
    failed are left out."""
    rows = []
    for theta_c, gamma_c, tilt, measures in beds:
        if np.isnan(theta_c):
            continue
        rise = tilt <= theta_c + SAME_ANGLE
        near, far = {}, {}
        for name, of_frames in measures.items():
            for f, values in enumerate(of_frames.reshape(len(tilt), -1).T):
                each = name if f == 0 else f"{name}[{f}]"
                near[each] = interpolated(tilt[rise], values[rise], theta_c - DISTANCES)
                far[each] = mean_far(tilt[rise], values[rise])
        rows.append((theta_c, gamma_c, near, far))
    names = rows[0][2] if rows else ()
    return Beds(np.array([row[0] for row in rows]), np.array([row[1] for row in rows]),
                {name: np.array([row[2][name] for row in rows]) for name in names},
                {name: np.array([row[3][name] for row in rows]) for name in names})


def mean_far(tilt, values):
    """The mean over the tilts of FAR, the last axis."""
    return mean(values[..., (tilt >= FAR[0] - SAME_ANGLE) & (tilt <= FAR[1] + SAME_ANGLE)], -1)


def interpolated(tilt, values, at):
    """Values interpolated between two tilts; NaN outside the tilts, or if either value is missing."""
    result = np.full(len(at), np.nan)
    for k, angle in enumerate(at):
        u = np.searchsorted(tilt, angle - SAME_ANGLE)
        if u < len(tilt) and tilt[u] <= angle + SAME_ANGLE:
            result[k] = values[u]
        elif 0 < u < len(tilt):
            share = (angle - tilt[u - 1]) / (tilt[u] - tilt[u - 1])
            result[k] = values[u - 1] + share * (values[u] - values[u - 1])
    return result


# ---- The estimate.


def mean(values, axis=None):
    """The mean of the values that are not NaN; NaN if there are none."""
    count = np.sum(~np.isnan(values), axis)
    return np.where(count > 0, np.nansum(values, axis) / np.maximum(count, 1), np.nan)


def deviation(values, axis=None):
    """The standard deviation (n - 1) of the values that are not NaN; NaN for fewer than two."""
    count = np.sum(~np.isnan(values), axis)
    square = np.nansum((values - np.expand_dims(mean(values, axis), axis or 0)) ** 2, axis)
    return np.where(count > 1, np.sqrt(square / np.maximum(count - 1, 1)), np.nan)


def change(near, far):
    """The change of a measure in each bed at each distance, relative to the same bed far from failure: the logarithm of
    the ratio if the measure is positive in all beds throughout, else the difference."""
    if np.all(~(near <= 0)) and np.all(~(far <= 0)):
        return np.log(near / far[:, None])
    return near - far[:, None]


def squared_errors(*measures):
    """Squared error of the distance that is estimated for each bed (row) at each of DISTANCES (column) from one or two
    measures of the same shape; NaN without an estimate.

    The observer knows all other beds (leave-one-out) and assumes that their measures at each distance are
    normally distributed, with the means and the covariance over the beds. All distances are equally likely beforehand. The estimate is the
    mean of the distance once the measure is known (Bayes), which has the least mean square error. The error of a measure
    without information is thus the standard deviation of the distances themselves."""
    values = np.stack(measures)
    values = np.where(np.isnan(values).any(axis=0), np.nan, values)
    scale = [deviation(measure.ravel()) for measure in measures]
    squares = np.full(measures[0].shape, np.nan)
    if not np.all(np.greater(scale, 0)):
        return squares
    for bed in range(len(squares)):
        others = np.delete(values, bed, axis=1)
        if (~np.isnan(others[0])).sum(axis=0).min() < MIN_CALIBRATION:
            continue
        centre = [mean(each, 0) for each in others]
        width = [np.maximum(deviation(each, 0), MIN_DEVIATION * of_all) for each, of_all in zip(others, scale)]
        z = [(values[m][bed][:, None] - centre[m]) / width[m] for m in range(len(measures))]
        if len(measures) == 1:
            log_density = -0.5 * z[0] ** 2 - np.log(width[0])
        else:
            r = correlation(others, centre)
            log_density = (-0.5 * (z[0] ** 2 - 2 * r * z[0] * z[1] + z[1] ** 2) / (1 - r * r)
                           - np.log(width[0] * width[1] * np.sqrt(1 - r * r)))
        weight = np.exp(log_density - log_density.max(axis=1, keepdims=True))
        squares[bed] = (weight @ DISTANCES / weight.sum(axis=1) - DISTANCES) ** 2
    return squares


def correlation(values, centre):
    """Pearson's coefficient of two measures over the beds at each distance, at most MAX_CORRELATION."""
    a, b = values[0] - centre[0], values[1] - centre[1]
    scale = np.sqrt(np.nansum(a * a, axis=0) * np.nansum(b * b, axis=0))
    r = np.nansum(a * b, axis=0) / np.where(scale > 0, scale, np.inf)
    return np.clip(r, -MAX_CORRELATION, MAX_CORRELATION)


def root_mean_square(squares):
    """The root of the mean of squared errors of beds, and its standard error."""
    of_beds = mean(squares, 1)
    count = np.sum(~np.isnan(of_beds))
    if count < 2:
        return np.nan, np.nan
    root = np.sqrt(mean(of_beds))
    return root, 0.5 * deviation(of_beds) / np.sqrt(count) / root if root > 0 else 0.0


def ratio(value, error):
    """A mean over its deviation or its error; NaN if that is 0."""
    return value / error if error > 0 else np.nan


def ranked(name, changes, tilts, own_threshold=False):
    """The row of a measure in the table."""
    by_tilt, squares = squared_errors(tilts), squared_errors(changes)
    with_tilt = by_tilt if name == "tilt" else squared_errors(changes, tilts)
    at = [int(np.flatnonzero(DISTANCES == distance)[0]) for distance in SHOWN]
    row = {"measure": name, "beds": int(np.sum(~np.isnan(squares).all(axis=1)))}
    for distance, k in zip(SHOWN, at):
        contrast = ratio(mean(changes[:, k]), deviation(changes[:, k]))
        row[f"contrast_{distance}"] = np.nan if name == "tilt" else contrast
    row["error"], row["error_error"] = root_mean_square(squares)
    for distance, k in zip(SHOWN, at):
        row[f"error_{distance}"] = np.sqrt(mean(squares[:, k]))
    row["with_tilt"], row["with_tilt_error"] = root_mean_square(with_tilt)
    gain = mean(by_tilt, 1) - mean(with_tilt, 1)
    row["gain"], row["gain_error"] = mean(gain), deviation(gain) / np.sqrt(np.sum(~np.isnan(gain)))
    row["own_threshold"] = int(own_threshold)
    return {key: value.item() if isinstance(value, np.ndarray | np.generic) else value for key, value in row.items()}


def ranking(beds):
    """One row for the tilt and for each measure that varies and that all but a few beds have, the smallest error first.
    Throws ValueError for fewer than MIN_BEDS beds.

    Columns: contrast_1, _2, _3: mean change since far from failure over its standard deviation over the beds, 1, 2 and 3
    deg before theta_c; error: root mean square error of the distance estimated from the measure alone, deg, at all
    distances, and error_1, _2, _3 at those; with_tilt: that of the measure and the tilt together; gain: mean square error
    of the tilt less that with the measure, bed by bed, deg^2; each with its standard error. own_threshold: 1 if the measure
    depends on a threshold that follows from the theta_c of each bed."""
    count = len(beds.theta_c)
    if count < MIN_BEDS:
        raise ValueError(f"{count} beds have failed; expected at least {MIN_BEDS}")
    tilts = beds.theta_c[:, None] - DISTANCES
    rows = [ranked("tilt", tilts, tilts)]
    own_thresholds = np.any(beds.gamma_c != beds.gamma_c[0])
    for name, near in beds.near.items():
        at_threshold = name.endswith("]") or f"{name}[1]" in beds.near
        row = ranked(name, change(near, beds.far[name]), tilts, own_thresholds and at_threshold)
        if not np.isnan(row["error"]) and row["beds"] + MIN_CALIBRATION > count:
            rows.append(row)
    rows.sort(key=lambda row: row["error"])
    return [{"rank": k + 1, **row} for k, row in enumerate(rows)]


# ---- The table and its figure.


def write_table(rows, path):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, rows[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def read_table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return [{key: value if key == "measure" else float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def markdown(rows):
    """The table of docs/studies/announcing-failure.md; a star marks measures at a threshold that follows from theta_c."""
    lines = ["| rank | measure | change at 1, 2, 3 deg | error, deg | at 1, 2, 3 deg | with the tilt, deg | adds |",
             "|--:|---|---|--:|---|--:|--:|"]
    for row in rows:
        name = row["measure"]
        change = ", ".join("–" if name == "tilt" else f"{row[f'contrast_{k}']:+.1f}" for k in SHOWN)
        errors = ", ".join(f"{row[f'error_{k}']:.2f}" for k in SHOWN)
        adds = "" if name == "tilt" else f"{ratio(row['gain'], row['gain_error']):+.1f}"
        lines.append(f"| {row['rank']:.0f} | {name}{' *' if row['own_threshold'] else ''} | {change} "
                     f"| {row['error']:.2f} ± {row['error_error']:.2f} | {errors} "
                     f"| {row['with_tilt']:.2f} ± {row['with_tilt_error']:.2f} | {adds} |")
    return "\n".join(lines)


def draw(rows, path, drawn=30):
    """Draws the best rows: (a) the change of each measure over its deviation, (b) the error of the estimated distance."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    tilt = next(row for row in rows if row["measure"] == "tilt")
    best = rows[:drawn]
    place = np.array([row["rank"] for row in best])

    def column(name):
        return np.array([row[name] for row in best])

    plt.rcParams.update({"font.size": 8, "axes.linewidth": 0.6})
    figure, (left, right) = plt.subplots(1, 2, sharey=True, figsize=(7.4, 1.0 + 0.155 * len(best)), layout="constrained")
    for axes, letter in ((left, "(a)"), (right, "(b)")):
        axes.axhspan(tilt["rank"] - 0.5, tilt["rank"] + 0.5, color="#e4e4e4", linewidth=0)
        axes.hlines(place + 0.5, 0, 1, transform=axes.get_yaxis_transform(), color="#dddddd", linewidth=0.5)
        axes.set_ylim(len(best) + 0.5, 0.5)
        axes.set_title(letter, loc="left", fontsize=8)
        axes.tick_params(axis="y", length=0)
    names = [row["measure"] + (" *" if row["own_threshold"] else "") for row in best]
    left.set_yticks(place, names)
    left.axvline(0, color="#555555", linewidth=0.7)
    for distance, colour, filled in ((3, "#999999", False), (2, "#0072b2", True), (1, "#000000", True)):
        left.plot(column(f"contrast_{distance}"), place, "o", color=colour, markersize=3,
                  markerfacecolor=colour if filled else "none", label=f"{distance}° before $θ_c$")
    left.set_xlabel("change / deviation of the beds")
    right.errorbar(column("error"), place - 0.14, xerr=column("error_error"), fmt="o", color="#000000", markersize=3,
                   elinewidth=0.7, label="measure alone")
    right.errorbar(column("with_tilt"), place + 0.14, xerr=column("with_tilt_error"), fmt="o", color="#d55e00", markersize=3,
                   elinewidth=0.7, markerfacecolor="none", label="measure and tilt")
    right.axvline(tilt["error"], color="#555555", linestyle="--", linewidth=0.8, label="tilt alone")
    right.axvline(np.std(DISTANCES), color="#555555", linestyle=":", linewidth=0.8, label="no measure")
    right.set_xlim(0, 1.08 * np.std(DISTANCES))
    right.set_xlabel("error of $θ_c − θ$ (deg)")
    left.legend(loc="lower right", fontsize=7, handletextpad=0.3)
    right.legend(loc="upper right", bbox_to_anchor=(0.91, 0.99), fontsize=7, handletextpad=0.3)
    figure.savefig(path, dpi=150)
    plt.close(figure)


def main(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("input", nargs="+", type=Path, help="an ensemble.h5, runs, or a table that was written before")
    parser.add_argument("-o", "--output", type=Path, help="the table (.csv) or the figure (.png, .pdf, .svg)")
    parser.add_argument("--rows", type=int, help="print or draw this number of rows [print: all, draw: 30]")
    options = parser.parse_args(words)
    is_table = options.input[0].suffix == ".csv"
    if is_table:
        rows = read_table(options.input[0])
    else:
        is_ensemble = options.input[0].name == "ensemble.h5"
        rows = ranking(beds_of_ensemble(options.input[0]) if is_ensemble else beds_of_runs(options.input))
    if options.output is None:
        print(markdown(rows[: options.rows]))
        return
    options.output.parent.mkdir(parents=True, exist_ok=True)
    if options.output.suffix == ".csv":
        write_table(rows, options.output)
    else:
        draw(rows, options.output, options.rows or 30)


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except (OSError, ValueError) as error:
        sys.exit(f"precursor_ranking.py: error: {error}")
