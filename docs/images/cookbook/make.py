#!/usr/bin/env python3
"""Makes the pictures of docs/cookbook.md again: runs the commands of the page where their outputs are missing, and its
recipes.

Usage: python3 docs/images/cookbook/make.py [NAME...]    the pictures of these names, or all

It needs build/release/talus, and Debian's python3-h5py, python3-matplotlib, python3-pandas and python3-networkx. Runs
are kept in build/images/runs."""

import multiprocessing
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
PAGE = ROOT / "docs/cookbook.md"
PICTURES = ROOT / "docs/images/cookbook"

# What the recipes share: no window, and the package of this tree.
os.environ["MPLBACKEND"] = "Agg"
sys.path.insert(0, str(ROOT / "python"))


def commands():
    """The calls of talus on the page, as lists of words."""
    return [shlex.split(line) for line in re.findall(r"^ {4}(build/release/talus .*)$", PAGE.read_text(), re.MULTILINE)]


def recipes():
    """The Python blocks of the page, by the names of the pictures they save."""
    blocks = re.findall(r"^```python\n(.*?)^```$", PAGE.read_text(), re.MULTILINE | re.DOTALL)
    return {re.search(r'savefig\("(\S+)\.png"', block)[1]: block for block in blocks}


def make_runs(folder, program):
    """Calls the commands of the page in a folder, those whose outputs are not there."""
    (folder / "runs").mkdir(parents=True, exist_ok=True)
    if not (folder / "assets").exists():
        (folder / "assets").symlink_to(ROOT / "assets")
    for words in commands():
        if "-o" in words and (folder / words[words.index("-o") + 1]).exists():
            continue
        subprocess.run([program, *words[1:]], cwd=folder, check=True, stdout=subprocess.DEVNULL)


def make_picture(name, folder):
    """Runs a recipe in a process of its own, in a folder with its runs; gives the path of its picture."""
    process = multiprocessing.get_context("fork").Process(target=run_recipe, args=(recipes()[name], folder))
    process.start()
    process.join()
    if process.exitcode != 0:
        raise RuntimeError(f"recipe {name} failed: its error is above")
    return folder / f"{name}.png"


def run_recipe(code, folder):
    os.chdir(folder)
    exec(code, {"__name__": "__main__"})


def main(names):
    if "--help" in names or "-h" in names:
        print(__doc__)
        return
    import matplotlib.pyplot  # noqa: F401 imported once, for every recipe
    from PIL import Image  # comes with matplotlib

    folder = ROOT / "build/images"
    make_runs(folder, ROOT / "build/release/talus")
    for name in names or recipes():
        # 128 colours are as good as all here, and a third of the bytes.
        picture = Image.open(make_picture(name, folder)).convert("RGB").quantize(128, dither=0)
        picture.save(PICTURES / f"{name}.png", optimize=True)
        print(f"docs/images/cookbook/{name}.png")


if __name__ == "__main__":
    main(sys.argv[1:])
