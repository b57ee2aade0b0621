#!/usr/bin/env python3
"""Measures time and memory of `talus ensemble status`, `average`, `work` and of `talus figures` on an ensemble of many members
without frames. One member of a tiny bed is computed, and the others are copies of it. The bed is read from a file, so that the seed
has no effect. Prints a Markdown table.

usage: ensemble_bench.py TALUS [--members N...] [--folder DIR]
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import h5py
import numpy as np
import xxhash

POURED = "[bed]\nlength = 10\ndepth = 4\n[output]\nframe_every = 0.5\n"
BED = POURED + '[deposition]\nmethod = "file"\nfile = "poured.h5"\n'
SEAL_SIZE = 512


def measured(words: list[str], folder: Path) -> tuple[float, float]:
    """Returns the wall time (s) and the peak memory (MB) of a command."""
    begin = time.perf_counter()
    process = subprocess.Popen(words, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    _, status, usage = os.wait4(process.pid, 0)
    seconds = time.perf_counter() - begin
    if status != 0:
        sys.exit(f"{' '.join(words)}: {process.stderr.read().decode()}")
    return seconds, usage.ru_maxrss / 1e3


def copy_as(source: Path, target: Path, seed: int) -> None:
    """Copies a run file with another seed and a new seal."""
    shutil.copy(source, target)
    with h5py.File(target, "r+") as run:
        run["provenance/seed"][()] = seed
        name = "parameters/scenario_resolved"
        text, attributes = run[name][()].decode(), dict(run[name].attrs)
        del run[name]
        encoded = re.sub(r"^seed = \d+", f"seed = {seed}", text, flags=re.M).encode()
        run.create_dataset(name, data=np.bytes_(encoded)).attrs.update(attributes)
    content = target.read_bytes()
    hash_of_rest = xxhash.xxh3_64_hexdigest(content[SEAL_SIZE:])
    seal = f"talus run file 1\nsize {len(content)}\nxxh3 of all after byte 512 {hash_of_rest}\n".encode()
    target.write_bytes(seal.ljust(SEAL_SIZE, b"\0") + content[SEAL_SIZE:])


def fabricate(talus: str, folder: Path, members: int) -> None:
    (folder / "bed.toml").write_text(BED)
    (folder / "poured.toml").write_text(POURED)
    subprocess.run([talus, "run", "poured.toml", "-o", "poured.h5"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    begin = [talus, "ensemble", "bed.toml", "--keep", "analysis", "-o", "e"]
    subprocess.run([*begin, "--seeds", "1"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    subprocess.run([*begin, "--seeds", f"1-{members}", "--jobs", "0"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    for seed in range(2, members + 1):
        copy_as(folder / "e/seed-1.h5", folder / "e" / f"seed-{seed}.h5", seed)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("talus")
    parser.add_argument("--members", type=int, nargs="+", default=[100, 1000, 10000])
    parser.add_argument("--folder", help="parent of the folders; default: a temporary one")
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
