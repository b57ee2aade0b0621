#!/usr/bin/env python3
"""Measures the cost of maps drawn during a run: the same run without them and with two maps of each frame, alternately.
Prints a Markdown table of the medians; several programs run alternately.

usage: run_frames.py TALUS [TALUS...] [--scenario FILE] [--set KEY=VALUE...] [--repeat N]
"""
import argparse
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
MAPS = "gamma,overloaded"


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def seconds(talus, scenario, settings, maps):
    """Returns the wall and processor times of the run, s."""
    with tempfile.TemporaryDirectory() as folder:
        command = [talus, "run", scenario, "-q", "-o", os.path.join(folder, "run.h5")]
        for setting in settings:
            command += ["--set", setting]
        if maps:
            command += ["--pictures", os.path.join(folder, "maps"), "--map", maps]
        used, begin = processor_seconds(), time.monotonic()
        subprocess.run(command, check=True, stderr=subprocess.DEVNULL)
        return time.monotonic() - begin, processor_seconds() - used


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("talus", nargs="+", help="programs to measure")
    parser.add_argument("--scenario", default=os.path.join(ROOT, "assets/scenarios/paper-pbc.toml"))
    parser.add_argument("--set", dest="settings", action="append", metavar="KEY=VALUE",
                        help="setting of the scenario (bed.length=100: half of the paper's bed)")
    parser.add_argument("--repeat", type=int, default=3, help="number of runs, of which the median is printed")
    arguments = parser.parse_args()
    settings = arguments.settings or []
    taken = {(talus, maps): [] for talus in arguments.talus for maps in ("", MAPS)}
    for _ in range(arguments.repeat):
        for talus, maps in taken:
            taken[talus, maps].append(seconds(talus, arguments.scenario, settings, maps))
    print(f"{', '.join([os.path.basename(arguments.scenario), *settings])}; medians of {arguments.repeat} alternating runs")
    print()
    print("| program | maps | median | shortest, longest | processor time |")
    print("|---|---|--:|--:|--:|")
    for (talus, maps), times in taken.items():
        wall = [pair[0] for pair in times]
        print(f"| {talus} | {maps or 'none'} | {statistics.median(wall):.1f} s | {min(wall):.1f} s, {max(wall):.1f} s | "
              f"{statistics.median(pair[1] for pair in times):.1f} s |")


if __name__ == "__main__":
    sys.exit(main())
