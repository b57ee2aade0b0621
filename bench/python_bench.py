#!/usr/bin/env python3
"""Measures the cost of driving runs from Python: whole runs and `talus run`, alternately, each with one thread; reads of numbers and
views, compared with a property of Python; memory of many steps; two beds in two threads. Prints a Markdown table. talus must be
imported from the same build as the program (PYTHONPATH).

usage: python_bench.py TALUS [--pairs N] [--length D]
"""
import argparse
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import threading
import time

import numpy as np
import talus

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SCENARIO = os.path.join(ROOT, "assets/scenarios/demo.toml")
DRIVEN = """
import sys, talus
sim = talus.Simulation("scenario.toml", progress=False)
sim.record(sys.argv[1])
sim.deposit()
while not sim.done:
    sim.tilt_by(0.25)
"""


def processor_seconds(command, folder):
    """Returns the processor time of a command, s."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    package = os.path.dirname(os.path.dirname(os.path.abspath(talus.__file__)))
    subprocess.run(command, cwd=folder, check=True, env={**os.environ, "PYTHONPATH": package})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def whole_runs(program, settings, pairs):
    """Compares the smallest processor times of both, which other load affects least."""
    taken = ([], [])
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "scenario.toml"), "w") as file:
            file.write(talus.Simulation(SCENARIO, **settings).scenario)
        for pair in range(pairs):
            ends = []
            for k in (0, 1) if pair % 2 == 0 else (1, 0):
                path = os.path.join(folder, f"{pair}-{k}.h5")
                command = [sys.executable, "-c", DRIVEN, path]
                if k == 0:
                    command = [program, "run", "scenario.toml", "-o", path, "-q", "--threads", "1"]
                taken[k].append(processor_seconds(command, folder))
                ends.append(talus.open(path).frames[-1].position)
            assert np.array_equal(*ends), "the bits differ"
        start = min(processor_seconds([sys.executable, "-c", "import talus"], folder) for _ in range(pairs))
    run, driven = (min(of) for of in taken)
    return (f"{run:.2f} s by talus run, {driven:.2f} s by a script, of which {start:.2f} s start Python; without these "
            f"{(driven - start) / run:.3f} of talus run")


def nanoseconds(do, count):
    """Returns the processor time of a call, ns; the smallest of five rounds."""
    rounds = []
    for _ in range(5):
        begin = time.thread_time()
        for _ in range(count):
            do()
        rounds.append((time.thread_time() - begin) / count)
    return 1e9 * min(rounds)


class Plain:
    """Class with a property that returns a number."""

    def __init__(self):
        self._tilt = 1.0

    @property
    def tilt(self):
        return self._tilt


def reads():
    sim, plain = talus.Simulation(**{"bed.length": 200, "bed.depth": 40, "deposition.method": "geometric"}), Plain()
    tilt, of_python = nanoseconds(lambda: sim.tilt, 10**6), nanoseconds(lambda: plain.tilt, 10**6)
    view, grains = nanoseconds(lambda: sim.grains.position, 10**5), len(sim.grains)
    return (f"{tilt:.0f} ns", f"{of_python:.0f} ns", f"{view:.0f} ns, of {grains} grains")


def memory(steps):
    """Returns the growth of memory (kB) in the second half of the steps, with temporary views."""
    sim = talus.Simulation(SCENARIO, **{"bed.length": 12, "bed.depth": 7})
    sim.deposit()
    sim.tilt_rate = 0
    half = []
    for _ in range(2):
        for _ in range(steps // 20):
            sim.step(10)
            sim.grains.position, sim.grains.velocity, sim.contacts.force
        half.append(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
    return f"{half[1] - half[0]} kB more in the second half, {half[1] / 1024:.0f} MB in total"


def two_threads(settings, pairs):
    """Compares the wall times of two threads and one; the median of pairs."""
    first = talus.Simulation(SCENARIO, **settings)
    first.deposit()
    ratios = []
    for _ in range(pairs):
        taken = []
        for count in (1, 2):
            threads = [threading.Thread(target=first.copy().step, args=(150,)) for _ in range(count)]
            begin = time.perf_counter()
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            taken.append(time.perf_counter() - begin)
        ratios.append(taken[1] / taken[0])
    return f"{statistics.median(ratios):.2f} of the time of one"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("talus", help="program to measure")
    parser.add_argument("--pairs", type=int, default=7, help="number of pairs of runs")
    parser.add_argument("--length", type=float, default=40, help="length of the bed, in D")
    arguments = parser.parse_args()
    settings = {"bed.length": arguments.length, "bed.depth": 20}
    print("| quantity | |")
    print("|---|---|")
    tilt, of_python, view = reads()
    print(f"| `sim.tilt` | {tilt}; a property of Python: {of_python} |")
    print(f"| `sim.grains.position` | {view} |")
    print(f"| memory in 100 000 steps of a bed of 90 grains, with views | {memory(10**5)} |", flush=True)
    print(f"| two beds in two threads | {two_threads(settings, arguments.pairs)} |", flush=True)
    print(f"| a whole run, smallest processor time of {arguments.pairs} | {whole_runs(os.path.abspath(arguments.talus), settings, arguments.pairs)} |")


if __name__ == "__main__":
    main()
