#!/usr/bin/python3
"""The tables, numbers and picture of docs/performance.md, made from bench/results (bench/run.sh measures them; docs/make writes them into the page).

    docs/benchmarks.py PICTURE.png      # draws cost and ratio to Siconos over the size of the bed
"""

import datetime
import functools
import re
import sys
from pathlib import Path

from tables import markdown

RESULTS = Path(__file__).resolve().parents[1] / "bench/results"

#: Grains of the paper's bed.
PAPER = "8000"
FLAT, WARM = "flat, cold", "10 deg, warm"


@functools.cache
def text_of_part(part):
    return (RESULTS / f"{part}.md").read_text(encoding="utf-8")


@functools.cache
def rows_of_part(part, which=0):
    """The rows of one table of a part, by the heads of its columns."""
    tables = re.findall(r"^(\|.*\|)\n\|[-:|]+\|\n((?:\|.*\|\n?)*)", text_of_part(part), re.MULTILINE)

    def cells(line):
        return [cell.strip() for cell in line.strip().strip("|").split("|")]

    head, body = cells(tables[which][0]), tables[which][1].splitlines()
    return [dict(zip(head, cells(line), strict=True)) for line in body]


def row_of(part, **wanted):
    """The row of a part whose first columns are as wanted: grains="8000"."""
    return next(row for row in rows_of_part(part) if all(row[key] == value for key, value in wanted.items()))


def median_ms(name):
    """Median of a benchmark of the part `solver`, ms."""
    return float(re.search(rf"^{re.escape(name)}_median\s+([\d.]+) ms", text_of_part("solver"), re.MULTILINE)[1])


def spaced(number):
    """A count with spaces between thousands, from five digits on."""
    return f"{int(number):,}".replace(",", " ") if len(number) > 4 else number


def milliseconds(text):
    """A time of a picture, ms, as the page prints it: 31.8, 255, 1590."""
    value = float(text)
    return f"{value:.0f}" if value >= 100 else f"{value:.3g}"


def seconds(text):
    """A time of Siconos or Talus as the page prints it: 355 ms, 10.2 s."""
    value = float(re.search(r"[\d.]+", text)[0])
    return f"{value:.3g} s" if value >= 1 else f"{1000 * value:.3g} ms"


def machine(_, *parts):
    """With which revision, when and where parts were measured: a line for each machine and day."""
    found = {}
    for part in parts:
        text = text_of_part(part)
        date = datetime.date.fromisoformat(re.search(r"date: (\S+)", text)[1])
        where = re.search(r"processor: (.*)", text)[1]
        found.setdefault((re.search(r"Talus: (\w+(?:-dirty)?)", text)[1], f"{date.day} {date:%B %Y}", where), []).append(part)
    each = [f"{', '.join(f'`{part}`' for part in names)}: Talus {revision}, {date}, {where}" for (revision, date, where), names in found.items()]
    return "\n".join(f"- {line}" for line in each)


def whole_runs(_):
    def both(measured, unit, estimate):
        values = [spaced(f"{value:.0f}") if value >= 1000 else f"{value:.3g}" for value in (float(row[measured]), float(row[estimate]))]
        return f"{values[0]} {unit} ({values[1]})"

    rows = []
    for row in rows_of_part("runs"):
        rows.append([f"`{row['run']}`", spaced(row["grains"]), both("wall time, s", "s", "estimate, s on one core"),
                     ", ".join(spaced(row[f"steps, {phase}"]) for phase in ("deposition", "tilt")),
                     ", ".join(row[f"iterations per step, {phase}"] for phase in ("deposition", "tilt")),
                     both("memory, MB", "MB", "estimate, MB of memory"), both("file, MB", "MB", "estimate, MB of file")])
    return markdown(["run", "grains", "wall time", "steps", "iterations per step", "memory", "file"], rows)


def size(_):
    columns = ["ns per contact and iteration, 1 thread", "ns per contact and iteration, 2 threads", "relative to 8000 grains, 2 threads",
               "peak memory, bytes per grain"]
    rows = [[spaced(row["grains"]), spaced(row["contacts"]), *(row[column] for column in columns)] for row in rows_of_part("scale")]
    return markdown(["grains", "contacts", *columns], rows, text_columns=0)


def peers(_):
    """Siconos and LAMMPS on the paper's bed."""
    rows = []
    for program, part, problem, error, work in (
            ("Siconos 4.4", "siconos", WARM, "1e-06", "a step at 10 deg from remembered forces, to an error of 1e-6"),
            ("", "siconos_si", WARM, "1e-06", "the same in SI units, in which this error is stricter"),
            ("", "siconos", FLAT, "1e-04", "a step of the flat bed from zero, to 1e-4")):
        row = row_of(part, grains=PAPER, problem=problem, error=error)
        rows.append([program, "Contact Dynamics, nonsmooth Gauss-Seidel on sparse blocks" if program else "", work,
                     seconds(row["Siconos, s (solves)"]), seconds(row["Talus, s (solves)"]), row["ratio"]])
    ours, *theirs = rows_of_part("dem")
    for row in theirs:
        overlap = row["overlap of the deepest grains"].replace("e-0", "e-")
        rows.append(["LAMMPS of January 2022" if row is theirs[0] else "", f"springs and dashpots, overlaps up to {overlap}",
                     "one second of the tilt at 10 deg", row["wall time for a second"], ours["wall time for a second"], row["ratio"]])
    return markdown(["program", "method", "the same work", "its time", "Talus", "ratio"], rows, text_columns=3)


def agreement(_):
    """How far the solutions of Talus and Siconos of the same step differ. Larger beds are copies of one of these side by side."""
    rows = [[spaced(row["grains"]), spaced(row["contacts"]), *(row[f"error of {name}"].replace("e-0", "e-") for name in ("Siconos", "Talus")),
             *(row[column].replace("e-0", "e-") for column in ("v differs, g h", "P differ"))]
            for row in rows_of_part("siconos")
            if (row["problem"], row["error"]) == (WARM, "1e-06") and int(row["grains"]) <= int(PAPER)]
    return markdown(["grains", "contacts", "error of Siconos", "error of Talus", "velocities differ, g h", "impulses differ"], rows, text_columns=0)


def pictures(_):
    found = rows_of_part("render")
    rows = []
    for gray, colour in zip(found[::2], found[1::2], strict=True):
        each = [[milliseconds(row[column]) for row in (gray, colour)] for column in ("frame, overlapped", "cairo: frame", "matplotlib: frame")]
        rows.append([spaced(gray["discs"]), f"{gray['width, px']} x {int(gray['width, px']) // 4}", *("; ".join(pair) for pair in each)])
    return markdown(["discs", "picture", "Talus: gray; colour, ms", "cairo, ms", "matplotlib, ms"], rows, text_columns=0)


def numbers(_):
    """Numbers in the sentences of the page: step.N, a step at 10 deg on N threads, ms; run.STAGE, share of the steps of the paper's run in
    per cent; run.median, its iterations; scale.growth, the largest bed relative to the paper's; siconos.PROBLEM.least, .largest, the ratios
    over all sizes that Siconos solves; siconos.velocities, the largest difference of velocities in g h;
    dem.steps.N, of Talus (0) and LAMMPS; view.live and view.replay, .least and .largest pictures per second; view.steps, the same of steps
    per second, .alone without a window."""
    found = {f"step.{threads}": median_ms(f"steps_at_ten_degrees/threads:{threads}/iterations:200/real_time") for threads in (1, 2)}
    paper = row_of("runs", run="paper-pbc.toml")
    found |= {f"run.{name}": float(paper[f"{name}, % of the steps"]) for name in ("solve", "detect", "assemble", "move", "recall", "store")}
    found |= {"run.median": float(paper["median, tilt"]), "run.writing": float(paper["writing, s"])}
    found |= {"scale.growth": float(rows_of_part("scale")[-1]["relative to 8000 grains, 2 threads"])}
    for name, problem, error in (("cold3", FLAT, "1e-03"), ("cold4", FLAT, "1e-04"), ("warm", WARM, "1e-06")):
        ratios = [float(row["ratio"]) for row in rows_of_part("siconos") if (row["problem"], row["error"]) == (problem, error) and row["ratio"][0].isdigit()]
        found |= {f"siconos.{name}.least": min(ratios), f"siconos.{name}.largest": max(ratios)}
    found["siconos.velocities"] = max(float(row["v differs, g h"]) for row in rows_of_part("siconos") if (row["problem"], row["error"]) == (WARM, "1e-06"))
    found |= {f"dem.steps.{k}": float(row["steps for a second"]) for k, row in enumerate(rows_of_part("dem"))}
    live = [row for row in rows_of_part("view") if row["pictures/s"]]
    replay = rows_of_part("view", 1)
    for name, rows, column in (("view.live", live, "pictures/s"), ("view.replay", replay, "pictures/s"), ("view.steps", live, "steps/s")):
        values = [float(row[column]) for row in rows]
        found |= {f"{name}.least": min(values), f"{name}.largest": max(values)}
    return found | {"view.steps.alone": float(row_of("view", display="no drawing")["steps/s"])}


TABLES = {"measured-by": machine, "whole-runs": whole_runs, "size": size, "peers": peers, "siconos-agreement": agreement, "pictures": pictures}


def draw(path):
    """Cost of an iteration, and the ratio of the times of Siconos and Talus, over the number of grains."""
    import matplotlib  # noqa: PLC0415

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt  # noqa: PLC0415

    figure, (cost, ratio) = plt.subplots(1, 2, figsize=(9, 3.4), layout="constrained")
    grains = [int(row["grains"]) for row in rows_of_part("scale")]
    for threads, style in (("1 thread", "o-k"), ("2 threads", "s--k")):
        cost.plot(grains, [float(row[f"ns per contact and iteration, {threads}"]) for row in rows_of_part("scale")], style, label=threads)
    cost.set(xscale="log", ylim=(0, None), xlabel="grains", ylabel="ns per contact and iteration")
    for label, problem, error, style in (("from zero, error 1e-4", FLAT, "1e-04", "o-k"), ("from zero, error 1e-3", FLAT, "1e-03", "s--k"),
                                         ("from remembered forces, error 1e-6", WARM, "1e-06", "^:k")):
        reached = [row for row in rows_of_part("siconos") if (row["problem"], row["error"]) == (problem, error) and row["ratio"][0].isdigit()]
        ratio.plot([int(row["grains"]) for row in reached], [float(row["ratio"]) for row in reached], style, label=label)
    ratio.set(xscale="log", yscale="log", ylim=(50, 5000), xlabel="grains", ylabel="time of Siconos / time of Talus")
    for axes in (cost, ratio):
        axes.legend(frameon=False)
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    draw(sys.argv[1])
