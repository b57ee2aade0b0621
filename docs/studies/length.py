#!/usr/bin/env python3
"""Draws how the angle of repose depends on the length of periodic beds and of beds between walls, and how much load the walls carry,
from docs/data/beds.csv.

    python3 docs/studies/length.py docs/data/beds.csv -o runs/length.png

It needs Debian's python3-numpy and python3-matplotlib."""

import argparse
import csv

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

PERIODIC = {50: "length-50", 100: "pour-6", 200: "paper-pbc", 400: "length-400"}
WALLS = {length: f"paper-wbc-{length}" for length in (100, 150, 200, 250, 300)}
#: Depth of the beds, D, and the k_L - k_0 of the paper.
DEPTH, PAPER_K = 40.0, 2.5


def values(rows, groups, column):
    """The values of a column over the beds of each length that has some."""
    found = {length: np.array([float(row[column]) for row in rows if row["beds"] == beds and row[column]]) for length, beds in groups.items()}
    return {length: each for length, each in found.items() if len(each)}


def draw_means(axes, found, style, label, aside=0.0):
    """Single beds as small points, `aside` of their length, and means with standard errors."""
    for length, each in found.items():
        axes.plot(np.full(len(each), length + aside), each, ".", color="0.75", markersize=3, zorder=1)
    means = [each.mean() for each in found.values()]
    errors = [each.std(ddof=1) / np.sqrt(len(each)) for each in found.values()]
    axes.errorbar(list(found), means, errors, fmt=style, color="black", capsize=3, label=label, zorder=2)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("beds", help="docs/data/beds.csv")
    parser.add_argument("-o", "--output", required=True, metavar="FILE", help="picture to write")
    arguments = parser.parse_args()
    with open(arguments.beds, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    figure, (repose, ratio) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    draw_means(repose, values(rows, PERIODIC, "theta_c (deg)"), "o-", "periodic", aside=-6)
    draw_means(repose, values(rows, WALLS, "theta_c (deg)"), "s--", "between walls", aside=6)
    repose.set(xlabel="L / D", ylabel="theta_c, deg", xlim=(0, 420))
    found = values(rows, WALLS, "failure_ratio (1)")
    draw_means(ratio, found, "s", "beds and their means")
    fitted = np.mean(np.concatenate([3 * (1 - each) * length / DEPTH for length, each in found.items()]))
    length = np.linspace(80, 320, 100)
    for k, style, whose in ((fitted, "k-", "mean of the beds"), (PAPER_K, "k:", "the paper's")):
        ratio.plot(length, 1 - k * DEPTH / (3 * length), style, label=f"k_L - k_0 = {k:.1f}, {whose}")
    ratio.set(xlabel="L / D", ylabel="(sigma_T / sigma_N) / tan theta", xlim=(80, 320), ylim=(0.3, 0.95))
    for axes in (repose, ratio):
        axes.legend(frameon=False)
    figure.savefig(arguments.output, dpi=110)


if __name__ == "__main__":
    main()
