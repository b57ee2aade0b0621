#!/usr/bin/env python3
"""Measures the whole run of the paper's bed: deposition and tilt to failure. Prints a Markdown list of results.

usage: run_paper.py TALUS [SCENARIO] [--threads N] [--keep RUN.h5]
"""
import argparse
import os
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
DEPOSITION, TILT = 0, 1


def stage_shares(timing):
    """Returns the share of each stage in the time of the steps, largest first."""
    stages = {name[len("stage_"):]: timing[name][()] for name in timing if name.startswith("stage_")}
    total = sum(stages.values())
    return sorted(((name, seconds / total) for name, seconds in stages.items()), key=lambda item: -item[1])


def phase_line(name, steps, phase, seconds):
    """Returns a line with seconds, steps and iterations of one phase."""
    of = steps["phase"] == phase
    contacts, iterations = steps["contacts"][of], steps["iterations"][of]
    return (f"- {name}: {seconds:.1f} s, {of.sum()} steps, {iterations.mean():.0f} iterations per step "
            f"({np.median(iterations):.0f} median, {iterations.max():.0f} maximum), "
            f"{1e9 * seconds / (contacts * np.maximum(iterations, 1)).sum():.2f} ns per contact and iteration, all stages included; "
            f"{np.count_nonzero(steps['converged'][of] == 0)} steps not converged")


def report(path):
    with h5py.File(path) as run:
        steps = {name: values[()] for name, values in run["steps"].items()}
        timing, results = run["provenance/timing"], run["results"]
        lines = [
            phase_line("deposition", steps, DEPOSITION, timing["deposition"][()]),
            phase_line("tilt", steps, TILT, timing["tilt"][()]),
            f"- theta_c: {np.degrees(results['theta_c'][()]):.3f} deg",
            f"- largest eta of a step of the tilt: {results['residual_max_rest'][()]:.2e} at rest, "
            f"{results['residual_max_moving'][()]:.2e} while moving",
            "- share of the stages: " + ", ".join(f"{name} {100 * share:.1f} %" for name, share in stage_shares(timing)),
            f"- writing: {timing['write'][()]:.2f} s",
            f"- state hash: {run['checkpoint/state_hash'][()].decode()}",
        ]
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("talus", help="program to measure")
    parser.add_argument("scenario", nargs="?", default=os.path.join(ROOT, "assets/scenarios/paper-pbc.toml"))
    parser.add_argument("--threads", default="2")
    parser.add_argument("--keep", help="path at which to keep the run file")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        path = arguments.keep or os.path.join(folder, "run.h5")
        start = time.monotonic()
        subprocess.run([arguments.talus, "run", arguments.scenario, "-o", path, "--quiet", "--overwrite",
                        "--threads", arguments.threads], check=True)
        print(f"{os.path.basename(arguments.scenario)}, {arguments.threads} threads")
        print()
        print(f"- the command took {time.monotonic() - start:.1f} s")
        print(report(path))


if __name__ == "__main__":
    sys.exit(main())
