#!/usr/bin/env python3
"""Measures cost and memory against the size of the bed: medians of several rounds over
all sizes, so that other load affects all of them. Prints a Markdown table.

usage: run_scale.py SCALE_BENCH GRAINS... [--rounds N]
"""
import argparse
import statistics
import subprocess

REFERENCE = 8000  # grains of the paper's bed


def measure(program, grains):
    """Returns the cells that scale_bench prints for a bed of the given size."""
    row = subprocess.run([program, str(grains)], check=True, stdout=subprocess.PIPE, text=True).stdout
    return [float(cell) for cell in row.strip().strip("|").split("|")]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="scale_bench")
    parser.add_argument("grains", nargs="+", type=int, help=f"sizes, including {REFERENCE}")
    parser.add_argument("--rounds", type=int, default=5, help="number of rounds, of which medians are printed")
    arguments = parser.parse_args()
    if REFERENCE not in arguments.grains:
        parser.error(f"the sizes must include {REFERENCE} grains, with which the others are compared")
    rows = {grains: [] for grains in arguments.grains}
    for _ in range(arguments.rounds):
        for grains, measured in rows.items():
            measured.append(measure(arguments.program, grains))
    heads = [f"ns per {what} and iteration, {threads}" for what in ("contact", "grain") for threads in ("1 thread", "2 threads")]
    heads.insert(2, f"relative to {REFERENCE} grains, 2 threads")
    print(f"| grains | contacts | {' | '.join(heads)} | peak memory, bytes per grain | eta of remembered forces |")
    print("|--:|--:|--:|--:|--:|--:|--:|--:|--:|")
    for grains, measured in rows.items():
        _, contacts, one, two, grain_one, grain_two, peak, eta = (statistics.median(cells) for cells in zip(*measured))
        against = statistics.median(row[3] / reference[3] for row, reference in zip(measured, rows[REFERENCE]))
        print(f"| {grains} | {contacts:.0f} | {one:.2f} | {two:.2f} | {against:.2f} | "
              f"{grain_one:.2f} | {grain_two:.2f} | {peak:.0f} | {eta:.2e} |")


if __name__ == "__main__":
    main()
