#!/usr/bin/env python3
"""Measures the run of a scenario on one thread and on two, alone and with other processes. Prints a
Markdown table of wall times; several programs run alternately.

usage: run_crowded.py TALUS [TALUS...] [--scenario FILE] [--repeat N]
"""
import argparse
import contextlib
import os
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
# Shell commands that run at the same time.
NEIGHBOURS = {
    "none": [],
    "3 busy loops": ["while :; do :; done"] * 3,
    "3 loops that start processes": ["while :; do /bin/true; done"] * 3,
}


@contextlib.contextmanager
def background(commands):
    """Runs the commands until the block ends."""
    processes = [subprocess.Popen(["/bin/bash", "-c", command]) for command in commands]
    try:
        yield
    finally:
        for process in processes:
            process.kill()
            process.wait()


def seconds(talus, scenario, threads):
    with tempfile.TemporaryDirectory() as folder:
        begin = time.monotonic()
        subprocess.run([talus, "run", scenario, "-q", "-o", os.path.join(folder, "run.h5"), "--threads", str(threads)],
                       check=True, stderr=subprocess.DEVNULL)
        return time.monotonic() - begin


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("talus", nargs="+", help="programs to measure")
    parser.add_argument("--scenario", default=os.path.join(ROOT, "assets/scenarios/demo.toml"))
    parser.add_argument("--repeat", type=int, default=3, help="number of runs, of which the median is printed")
    arguments = parser.parse_args()
    print("| other processes | program | 1 thread | 2 threads |")
    print("|---|---|--:|--:|")
    for name, commands in NEIGHBOURS.items():
        taken = {(talus, threads): [] for talus in arguments.talus for threads in (1, 2)}
        with background(commands):
            for _ in range(arguments.repeat):
                for talus, threads in taken:
                    taken[talus, threads].append(seconds(talus, arguments.scenario, threads))
        for talus in arguments.talus:
            cells = " | ".join(f"{statistics.median(taken[talus, threads]):.1f} s" for threads in (1, 2))
            print(f"| {name} | {talus} | {cells} |", flush=True)


if __name__ == "__main__":
    sys.exit(main())
