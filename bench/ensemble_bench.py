#!/usr/bin/env python3
"""Time and memory of `talus ensemble status`, `average`, `work` and of `talus figures` on an ensemble of many members
whose runs are gone. A tiny bed is computed for a few seeds; the other members have copies of their tables, with theta_c
shifted. Prints a Markdown table.

usage: ensemble_bench.py TALUS [--members N...] [--folder DIR]
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

BED = "[bed]\nlength = 10\ndepth = 4\n[output]\nframe_every = 0.5\n"
COMPUTED = 4


def measured(words: list[str], folder: Path) -> tuple[float, float]:
    """Wall time in s, and the largest memory of the process in MB."""
    begin = time.perf_counter()
    process = subprocess.Popen(words, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    _, status, usage = os.wait4(process.pid, 0)
    seconds = time.perf_counter() - begin
    if status != 0:
        sys.exit(f"{' '.join(words)}: {process.stderr.read().decode()}")
    return seconds, usage.ru_maxrss / 1e3


def shifted(table: str, shift: float) -> str:
    """The numbers of a member with another theta_c."""
    return re.sub(r"^theta_c,deg,(.*)$", lambda found: f"theta_c,deg,{float(found[1]) + shift:.6f}", table, flags=re.M)


def fabricate(talus: str, folder: Path, members: int) -> None:
    (folder / "bed.toml").write_text(BED)
    begin = [talus, "ensemble", "bed.toml", "--keep", "analysis", "-o", "e"]
    subprocess.run([*begin, "--seeds", f"1-{COMPUTED}"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    subprocess.run([*begin, "--seeds", f"1-{members}", "--jobs", "0"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    for seed in range(COMPUTED + 1, members + 1):
        source = folder / "e" / f"seed-{seed % COMPUTED + 1}"
        target = folder / "e" / f"seed-{seed}"
        target.with_suffix(".csv").write_text(shifted(source.with_suffix(".csv").read_text(), -1e-3 * (seed % 997)))
        target.with_suffix(".series.csv").write_text(source.with_suffix(".series.csv").read_text())
        target.with_suffix(".log").touch()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("talus")
    parser.add_argument("--members", type=int, nargs="+", default=[100, 1000, 10000])
    parser.add_argument("--folder", help="where the folders are made; default: a temporary one")
    arguments = parser.parse_args()
    talus = str(Path(arguments.talus).resolve())
    print("| members | command | wall time | memory |\n|---|---|---|---|")
    for members in arguments.members:
        with tempfile.TemporaryDirectory(dir=arguments.folder) as place:
            folder = Path(place)
            fabricate(talus, folder, members)
            for words in (["ensemble", "status", "e"], ["ensemble", "status", "e", "--json"], ["ensemble", "work", "e"],
                          ["ensemble", "average", "e"], ["figures", "e/ensemble.h5", "-o", "f", "--only", "9,angle-distributions"],
                          ["figures", "e", "-o", "g", "--only", "9,angle-distributions"]):
                seconds, memory = measured([talus, *words], folder)
                print(f"| {members} | `talus {' '.join(words)}` | {seconds:.2f} s | {memory:.0f} MB |", flush=True)
            size = os.path.getsize(folder / "e" / "ensemble.h5") / 1e6
            print(f"| {members} | size of `ensemble.h5` | | {size:.0f} MB |", flush=True)


if __name__ == "__main__":
    main()
