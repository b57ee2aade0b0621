"""The numbers of the first pages, as sentences with fields, and where each value comes from: docs/make writes and compares
them.

Runs of the demo bed are computed by the present program. Numbers of ensembles, which take too long for that, are read from
docs/data: those of docs/data/demo hold as long as the states of their first members are those that the program computes;
the others name the revision that made them."""

import csv
import math
import statistics
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "python"))

import talus  # noqa: E402

SEEDS = range(1, 9)


def row_of(kind):
    """A row of the tutorial's table of angles: its text, and its values."""
    return (f"| {kind} | {', '.join(['{:.1f}'] * len(SEEDS))} | {{:.2f}} ± {{:.2f}} | {{:.1f}} |",
            [*(f"{kind}.{seed}" for seed in SEEDS), f"{kind}.mean", f"{kind}.error", f"{kind}.deviation"])


#: Page, sentence, and the names of its values (class Values).
NUMBERS = {
    "README": [
        ("tilted to failure in {:.0f} steps", ["paper.steps"]),
    ],
    "tutorial": [
        ("sustained flow began: {:.2f} deg for this bed", ["demo.theta_c"]),
        ("grows from {:.2f} on the flat bed to {:.2f} just before failure", ["demo.p_o_flat", "demo.p_o_repose"]),
        ("This bed fails at {:.2f} deg, {:.1f} deg earlier.", ["smooth.theta_c", "smooth.earlier"]),
        ("The collapsed bed fails at {:.2f} deg, {:.1f} deg earlier", ["collapse.theta_c", "collapse.earlier"]),
        row_of("poured"),
        row_of("collapsed"),
        ("seed 7 shows a difference of {:.1f} deg.", ["difference.7"]),
        ("they differ by {:.1f} ± {:.1f} deg", ["difference.mean", "difference.error"]),
        ("shrinks by {:.1f} % before it fails", ["collapse.shrinks"]),
        ("The demo bed shrinks by {:.1f} % at first, and has expanded by {:.1f} % when it fails",
         ["demo.shrinks", "demo.expands"]),
        ("the one with less friction expands by {:.1f} %", ["smooth.expands"]),
    ],
    "questions": [
        ("which is {:.3f} for the demo bed", ["demo.gamma_c"]),
        ("standard deviation of {:.2f} deg ([preparation](preparation.md#fifty-beds))", ["fifty.theta_c.deviation"]),
        ("in beds as small as the demo {:.1f} deg if they are poured and {:.1f} deg if they collapse",
         ["poured.deviation", "collapsed.deviation"]),
        ("Talus gives {:.2f} ± {:.2f} deg", ["fifty.theta_c.mean", "fifty.theta_c.error"]),
        ("fails at {:.1f} ± {:.1f} deg ([tutorial]", ["poured.mean", "poured.error"]),
        ("on average at {:.2f} deg,", ["fifty.first_slide.mean"]),
        ("Of the demo beds, those that collapse fail {:.1f} ± {:.1f} deg earlier", ["difference.mean", "difference.error"]),
        ("the demo bed of seed 1 fails {:.1f} deg earlier", ["smooth.earlier"]),
        ("| theta_c | {:.2f} deg |", ["fifty.theta_c.deviation"]),
        ("| theta_d by the jump of l_c | {:.2f} deg |", ["fifty.theta_d/lc_jump.deviation"]),
        ("| theta_d by percolation | {:.2f} deg |", ["fifty.theta_d/percolation.deviation"]),
        ("| theta_d by the least volume | {:.2f} deg |", ["fifty.theta_d/dilation.deviation"]),
        ("the largest l_c jumps at {:.1f} ± {:.1f} deg, overloaded clusters span from {:.1f} ± {:.1f} deg on, and the "
         "volume of single beds is least at {:.1f} ± {:.1f} deg.",
         [f"fifty.theta_d/{name}.{value}" for name in ("lc_jump", "percolation", "dilation") for value in ("mean", "error")]),
        ("Of the paper's run {:.0f} of {:.0f} steps do not.", ["paper.unconverged", "paper.steps"]),
    ],
}

#: The variants of docs/data/demo and the run of the first page that is their first member.
FIRST_MEMBERS = {"deposition.method=pour": "runs/demo.h5", "deposition.method=collapse": "runs/collapse.h5"}


def members(folder):
    with (ROOT / "docs/data" / folder / "members.csv").open() as file:
        return list(csv.DictReader(file))


def mean_of(values):
    """Mean, standard error and standard deviation of the numbers among the values."""
    values = [value for value in values if not math.isnan(value)]
    deviation = statistics.stdev(values)
    return {"mean": statistics.mean(values), "error": deviation / math.sqrt(len(values)), "deviation": deviation}


class Values:
    """Numbers by their names: values["demo.theta_c"], values["poured.mean"], values["fifty.first_slide.mean"]."""

    def __init__(self, folder):
        self.folder = folder  # with the runs
        self.groups = {}

    def needs(self, name):
        """The runs from which a value is computed, or that show that it still holds."""
        group = name.partition(".")[0]
        if group == "paper":
            return ("runs/paper.h5",)
        if group in ("demo", "smooth", "collapse"):
            return dict.fromkeys(("runs/demo.h5", f"runs/{group}.h5"))
        return FIRST_MEMBERS.values() if group in ("poured", "collapsed", "difference") else ()

    def __getitem__(self, name):
        group, _, rest = name.partition(".")
        if group not in self.groups:
            self.groups[group] = self.read(group)
        return self.groups[group][rest]

    def read(self, group):
        if group in ("demo", "smooth", "collapse"):
            return self.of_run(group)
        if group == "paper":
            with talus.open(self.folder / "runs/paper.h5") as run:
                unconverged = run["results/unconverged_steps"] + run["results/unconverged_steps_deposition"]
                return {"steps": len(run.steps["step"]), "unconverged": int(unconverged)}
        if group == "fifty":
            rows = members("paper-pbc")
            names = ["theta_c", "first_slide", "theta_d/lc_jump", "theta_d/percolation", "theta_d/dilation"]
            return {f"{name}.{key}": value for name in names
                    for key, value in mean_of(float(row[f"{name} (deg)"]) for row in rows).items()}
        if group == "difference":
            pairs = {str(seed): self[f"poured.{seed}"] - self[f"collapsed.{seed}"] for seed in SEEDS}
            return pairs | {"mean": self["poured.mean"] - self["collapsed.mean"],
                            "error": math.hypot(self["poured.error"], self["collapsed.error"])}
        variant = {"poured": "deposition.method=pour", "collapsed": "deposition.method=collapse"}[group]
        angles = {row["seed"]: float(row["theta_c (deg)"]) for row in members("demo") if row["variant"] == variant}
        return angles | mean_of(angles.values())

    def of_run(self, name):
        with talus.open(self.folder / f"runs/{name}.h5", units="D") as run:
            observed = run.observables["tilt"] <= run.theta_c
            strain = 100 * run.observables["volume_strain"][observed]
            values = {"theta_c": run.theta_c, "gamma_c": math.sin(math.radians(run.theta_c)), "shrinks": -strain.min(),
                      "expands": strain.max()}
            if name == "demo":
                overloaded = run.analysis["overloaded/fraction"][:, 0]
                return values | {"p_o_flat": overloaded[0], "p_o_repose": overloaded[run.frame_at("repose").index]}
        return values | {"earlier": self["demo.theta_c"] - values["theta_c"]}


def outdated(program_json):
    """Sentences about ensembles of docs/data/demo whose first members end in other states than the program computes;
    `program_json` gives what `talus info --json` prints of a run."""
    found = []
    for row in members("demo"):
        run = FIRST_MEMBERS[row["variant"]]
        if row["seed"] == "1" and (state := program_json(run)["state_hash"]) != row["state_hash"]:
            found.append(f"docs/data/demo/members.csv: {row['variant']}, seed 1 ends in the state {row['state_hash']}, but {run} in "
                         f"{state}: compute runs/preparation again, and copy its members.csv")
    return found
