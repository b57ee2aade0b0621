#!/usr/bin/env python3
"""Measures whole runs, from the empty floor to failure with everything that a run records and writes. Prints a Markdown table,
with what `talus check` estimates for one core.

usage: run_whole.py TALUS [SCENARIO...] [--threads N] [--repeat N]
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SCENARIOS = [os.path.join(ROOT, f"assets/scenarios/{name}.toml") for name in ("demo", "paper-pbc", "large")]
LONG = 300  # s; a longer run is not repeated
DEPOSITION, TILT = 0, 1
STAGES = ("solve", "detect", "assemble", "move", "recall", "store")


def measured(talus, scenario, threads, path):
    """Returns the wall time of a run, s, and its memory, MB."""
    start = time.monotonic()
    run = subprocess.Popen([talus, "run", scenario, "-o", path, "--quiet", "--overwrite", "--threads", threads])
    _, status, usage = os.wait4(run.pid, 0)
    run.returncode = os.waitstatus_to_exitcode(status)
    if run.returncode:
        raise SystemExit(f"run_whole.py: error: {talus} run {scenario} ended with exit code {run.returncode}")
    return time.monotonic() - start, usage.ru_maxrss / 1e3


def estimated(talus, scenario):
    """What `talus check` says of a scenario, by the heads of the columns."""
    found = json.loads(subprocess.run([talus, "check", scenario, "--json"], check=True, capture_output=True).stdout)["estimate"]
    return {"estimate, s on one core": f"{found['time_s']:.0f}", "estimate, MB of memory": f"{found['memory_bytes'] / 1e6:.0f}",
            "estimate, MB of file": f"{found['disk_bytes'] / 1e6:.0f}"}


def cells(path):
    """What a run file says of its run, by the heads of the columns."""
    with h5py.File(path) as run:
        steps = {name: values[()] for name, values in run["steps"].items()}
        timing = run["provenance/timing"]
        stages = {name: float(timing[f"stage_{name}"][()]) for name in STAGES}
        found = {"grains": str(np.count_nonzero(run["particles/grains/species"][()] == 0))}
        for name, phase in (("deposition", DEPOSITION), ("tilt", TILT)):
            of = steps["phase"] == phase
            found |= {f"steps, {name}": str(of.sum()), f"iterations per step, {name}": f"{steps['iterations'][of].mean():.0f}",
                      f"median, {name}": f"{np.median(steps['iterations'][of]):.0f}"}
        found |= {f"{name}, % of the steps": f"{100 * seconds / sum(stages.values()):.0f}" for name, seconds in stages.items()}
        found["writing, s"] = f"{float(timing['write'][()]):.1f}"
        found["state"] = run["checkpoint/state_hash"][()].decode()
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("talus", help="program to measure")
    parser.add_argument("scenarios", nargs="*", default=SCENARIOS)
    parser.add_argument("--threads", default="2")
    parser.add_argument("--repeat", type=int, default=3, help="number of runs, of which the median time is printed; one if it is long")
    arguments = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "run.h5")
        for scenario in arguments.scenarios:
            taken = []
            while len(taken) < (1 if taken and taken[0][0] > LONG else arguments.repeat):
                taken.append(measured(arguments.talus, scenario, arguments.threads, path))
            rows.append({"run": os.path.basename(scenario), "runs": str(len(taken)),
                         "wall time, s": f"{statistics.median(seconds for seconds, _ in taken):.1f}",
                         "memory, MB": f"{max(memory for _, memory in taken):.0f}", "file, MB": f"{os.path.getsize(path) / 1e6:.0f}",
                         **estimated(arguments.talus, scenario), **cells(path)})
    print(f"{arguments.threads} threads; medians over the runs")
    print()
    print(f"| {' | '.join(rows[0])} |")
    print(f"|---|{'--:|' * (len(rows[0]) - 1)}")
    for row in rows:
        print(f"| {' | '.join(row.values())} |")


if __name__ == "__main__":
    sys.exit(main())
