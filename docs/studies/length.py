#!/usr/bin/python3
"""Draws how the angle of repose depends on the length of periodic beds and of beds between walls, and how much load the walls carry.

    python3 docs/studies/length.py -o runs/length.png

The beds of each length are those of the tables in docs/tables.py. It needs Debian's python3-numpy and python3-matplotlib."""

import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from quoted_numbers import Beds, summary  # noqa: E402
from tables import DEPTH, LENGTHS, PAPER_K, WALL_LENGTHS, wall_numbers  # noqa: E402

PERIODIC = {int(label.removesuffix(" D")): group for label, group in LENGTHS}
WALLS = {length: f"paper-wbc-{length}" for length in WALL_LENGTHS}


def draw_means(axes, beds, groups, quantity, style, label, aside=0.0):
    """Single beds as small points, `aside` of their length, and means with standard errors."""
    found = {length: list(beds.values(group, quantity).values()) for length, group in groups.items()}
    for length, each in found.items():
        axes.plot([length + aside] * len(each), each, ".", color="0.75", markersize=3, zorder=1)
    means = [summary(each) for each in found.values()]
    axes.errorbar(list(found), [m["mean"] for m in means], [m["error"] for m in means], fmt=style, color="black", capsize=3, label=label, zorder=2)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("-o", "--output", required=True, metavar="FILE", help="picture to write")
    arguments = parser.parse_args()
    beds = Beds()
    figure, (repose, ratio) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    draw_means(repose, beds, PERIODIC, "theta_c", "o-", "periodic", aside=-6)
    draw_means(repose, beds, WALLS, "theta_c", "s--", "between walls", aside=6)
    repose.set(xlabel="$L$ ($D$)", ylabel="$θ_c$ (°)", xlim=(0, 420))
    draw_means(ratio, beds, WALLS, "failure_ratio", "s", "beds and their means")
    length = np.linspace(80, 320, 100)
    for k, style, whose in ((wall_numbers(beds)["k"][0], "k-", "mean of the beds"), (PAPER_K, "k:", "the paper's")):
        ratio.plot(length, 1 - k * DEPTH / (3 * length), style, label=f"$k_L - k_0$ = {k:.1f}, {whose}")
    ratio.set(xlabel="$L$ ($D$)", ylabel=r"$(σ_T / σ_N) / \tan θ$", xlim=(80, 320), ylim=(0.3, 0.95))
    for axes in (repose, ratio):
        axes.legend(frameon=False)
    figure.savefig(arguments.output, dpi=110)


if __name__ == "__main__":
    main()
