#!/usr/bin/python3
"""Draws the angle of repose and the solid fraction of beds with rolling friction against its coefficient.

    python3 docs/studies/rolling_friction.py -o runs/rolling-friction.png

The beds are those of the tables in docs/tables.py. It needs Debian's python3-numpy and python3-matplotlib."""

import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from quoted_numbers import SHORT, Beds, summary  # noqa: E402
from tables import ROLLING  # noqa: E402

STYLES = {0.2: ("s:", "0.55"), 0.5: ("o-", "black"), 1.0: ("^--", "tab:red")}
LINEAR = 0.01  # mu_r below which the axis is linear, because it begins at 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("-o", "--output", required=True, metavar="FILE", help="picture to write")
    beds, arguments = Beds(), parser.parse_args()
    figure, panels = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    for axes, quantity, label in zip(panels, ("theta_c", "phi@0"), ("$θ_c$ (°)", "solid fraction at 0°")):
        for mu, groups in ROLLING.items():
            means = [summary(beds.values(SHORT[group], quantity).values()) for group in groups.values()]
            style, colour = STYLES[mu]
            axes.errorbar(list(groups), [m["mean"] for m in means], [m["error"] for m in means], fmt=style, color=colour, markersize=5,
                          capsize=3, label=f"$μ$ = {mu:g}")
        axes.set(xlabel="$μ_r$", ylabel=label)
        axes.set_xscale("symlog", linthresh=LINEAR)
        axes.set_xlim(-0.001, 0.7)
    panels[0].legend(frameon=False)
    figure.savefig(arguments.output, dpi=110)


if __name__ == "__main__":
    main()
