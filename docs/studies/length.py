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
from tables import LENGTHS, PAPER_K, WALL_LENGTHS, WALL_READINGS, WALLS, wall_numbers  # noqa: E402

PERIODIC = {int(label.removesuffix(" D")): group for label, group in LENGTHS}


def between(walls):
    return {length: f"{WALLS[walls]}-{length}" for length in WALL_LENGTHS}


def draw_means(axes, beds, groups, quantity, style, label, aside=0.0, hollow=False):
    """Single beds as small points, `aside` of their length, and means with standard errors."""
    found = {length: list(beds.values(group, quantity).values()) for length, group in groups.items()}
    for length, each in found.items():
        axes.plot([length + aside] * len(each), each, ".", color="0.75", markersize=3, zorder=1)
    means = [summary(each) for each in found.values()]
    axes.errorbar(list(found), [m["mean"] for m in means], [m["error"] for m in means], fmt=style, color="black", capsize=3, label=label,
                  markerfacecolor="white" if hollow else "black", zorder=2)


def draw_readings(axes, beds, walls, k):
    """The ratio before failure and the slope, each with the law of its k_L - k_0, and the paper's law."""
    length = np.linspace(80, 320, 100)
    for reading, symbol, line, aside in (("failure_ratio", "s", "-", -5), ("wall_slope", "o", "--", 5)):
        fit = k[f"{walls}.{reading}"][0]
        draw_means(axes, beds, between(walls), reading, symbol, f"{WALL_READINGS[reading]}, $k_L - k_0$ = {fit:.1f}", aside, hollow=symbol == "o")
        axes.plot(length, 1 - fit * k["height"] / (3 * length), line, color="black", linewidth=1)
    axes.plot(length, 1 - PAPER_K * k["height"] / (3 * length), ":", color="black", label=f"the paper, $k_L - k_0$ = {PAPER_K}")
    axes.set(xlabel="$L$ ($D$)", ylabel=r"$(σ_T / σ_N) / \tan θ$", title=f"{walls} walls", xlim=(80, 320), ylim=(0.2, 0.95))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("-o", "--output", required=True, metavar="FILE", help="picture to write")
    arguments = parser.parse_args()
    beds = Beds()
    figure, (repose, *ratios) = plt.subplots(1, 3, figsize=(10, 3.6), layout="constrained")
    draw_means(repose, beds, PERIODIC, "theta_c", "o-", "periodic", aside=-6)
    draw_means(repose, beds, between("rough"), "theta_c", "s--", "rough walls", aside=6)
    draw_means(repose, beds, between("smooth"), "theta_c", "^:", "smooth walls", aside=12, hollow=True)
    repose.set(xlabel="$L$ ($D$)", ylabel="$θ_c$ (°)", xlim=(0, 420))
    for axes, walls in zip(ratios, ("rough", "smooth")):
        draw_readings(axes, beds, walls, wall_numbers(beds))
    for axes in (repose, *ratios):
        axes.legend(frameon=False, fontsize="small")
    figure.savefig(arguments.output, dpi=110)


if __name__ == "__main__":
    main()
