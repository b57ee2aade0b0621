"""The numbers that README and docs quote, by their names. docs/make writes them into the pages, and compares them.

A number that Talus gives is followed by a comment that names it and its format:

    fails at 21.33<!--=demo.theta_c .2f--> deg, on average at 19.2 ± 0.1<!--=paper-pbc.theta_c ±.1f--> deg

±.1f is a mean with its standard error. Names are those of class Values. Tables between <!--table NAME--> and <!--end--> are those of
docs/tables.py. Runs of the demo bed are computed by the present program; means over beds are read from docs/data, and hold for it as
long as the states of the first members are those that it computes."""

import csv
import math
import re
import statistics
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
DATA = ROOT / "docs/data"
sys.path.insert(0, str(ROOT / "python"))

MARK = re.compile(r"(?P<number>-?\d[\d ]*(?:\.\d+)?(?:e[-+]?\d+)?(?: ± \d[\d.]*)?)<!--=(?P<name>\S+) (?P<format>\S+)-->")
ANY_MARK = re.compile(r"<!--=.*?-->", re.DOTALL)

#: Groups of beds in docs/data/beds.csv whose first member is a run of the first pages.
FIRST_MEMBERS = {"demo:deposition.method=pour": "runs/demo.h5", "demo:deposition.method=collapse": "runs/collapse.h5",
                 "paper-pbc": "runs/paper.h5"}
#: Runs of the first pages whose numbers are quoted.
RUNS = ("demo", "smooth", "collapse", "paper")
#: Short names of groups.
SHORT = {"poured": "demo:deposition.method=pour", "collapsed": "demo:deposition.method=collapse",
         **{f"lowered-{name}": f"dynamic-angle-rates:tilt.lowering_rate={rate}" for name, rate in (("fast", 1), ("half", 0.5), ("slow", 0.2))},
         **{f"rolling-{name}": f"rolling:contact.rolling_friction={mu_r}"  # in hundredths
            for name, mu_r in ((0, 0), (1, 0.01), (2, 0.02), (5, 0.05), (10, 0.1), (20, 0.2), (50, 0.5))},
         **{f"rolling-{name}-mu-{of}": f"rolling-friction:contact.friction={mu},contact.rolling_friction={mu_r}"
            for name, mu_r in ((0, 0), (5, 0.05), (50, 0.5)) for of, mu in (("low", 0.2), ("high", 1))}}


def rows_of(name):
    """The rows of a table of docs/data, or of another file by its path."""
    with (DATA / name).open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def number(text):
    return float(text) if text else math.nan


class Beds:
    """The beds of docs/data/beds.csv by their group, and of groups that only docs/data/next has, those of that table."""

    def __init__(self):
        self.groups = self.groups_of("beds.csv")
        later = self.groups_of("next/beds.csv") if (DATA / "next/beds.csv").exists() else {}
        self.later = later.keys() - self.groups.keys()
        self.groups = later | self.groups

    @staticmethod
    def groups_of(table):
        groups = {}
        for row in rows_of(table):
            values = {column.partition(" (")[0]: text if column in ("beds", "version", "state_hash") else number(text) for column, text in row.items()}
            groups.setdefault(row["beds"], []).append(values)
        return groups

    def values(self, group, quantity):
        """The values of a quantity over the beds that have one, by seed. `A-B` is the difference of two quantities, bed by bed, and `A|B`
        what is left of A after its linear regression on B; with @0, @15, @before after a quantity it is that of a tilt or of 0.25 deg before
        theta_c."""
        if "|" in quantity:
            each, other = (self.values(group, name) for name in quantity.split("|"))
            seeds = sorted(each.keys() & other.keys())
            slope, constant = statistics.linear_regression([other[s] for s in seeds], [each[s] for s in seeds])
            return {s: each[s] - slope * other[s] - constant for s in seeds}
        beds = self.groups[group]
        if "-" in quantity:
            minuend, subtrahend = quantity.split("-")
            each = {bed["seed"]: bed[minuend] - bed[subtrahend] for bed in beds}
        else:
            each = {bed["seed"]: bed[quantity] for bed in beds}
        return {int(seed): value for seed, value in each.items() if not math.isnan(value)}


def summary(values):
    """Mean, standard error and standard deviation of some values, the mean in standard errors, their least, largest, number and sum."""
    values = list(values)
    deviation = statistics.stdev(values) if len(values) > 1 else math.nan
    return {"mean": statistics.mean(values) if values else math.nan, "deviation": deviation, "n": len(values),
            "error": deviation / math.sqrt(len(values)) if values else math.nan,
            "errors": statistics.mean(values) / (deviation / math.sqrt(len(values))) if len(values) > 1 and deviation else math.nan, "min": min(values, default=math.nan),
            "max": max(values, default=math.nan), "sum": sum(values)}


def correlation(first, second):
    """Pearson's correlation of two quantities over the beds that have both, and its distance from 0 in standard errors of Fisher's z."""
    seeds = sorted(first.keys() & second.keys())
    r = statistics.correlation([first[s] for s in seeds], [second[s] for s in seeds])
    return r, math.atanh(r) * math.sqrt(len(seeds) - 3)


class Values:
    """Values by name:

    demo.theta_c                     of a run of the first pages: demo, smooth, collapse, paper (class method of_run)
    paper-pbc.theta_c                a mean over beds, with its standard error; .error, .deviation, .n, .min, .max give one of these, .errors
                                     the mean in standard errors
    paper-pbc.theta_c.beds:0.2       the number of beds whose mean has this standard error; .pairs:0.2 the number of beds of each of two kinds
                                     whose difference has it
    paper-pbc.theta_c-lc_jump        the same of a difference, bed by bed
    poured.theta_c.7                 of one seed
    paper-pbc.theta_c~lc_jump        a correlation over beds; .errors gives its distance from 0 in standard errors
    paper-pbc.p_o@0|theta_c          what is left of a quantity after its linear regression on another
    paper-pbc.theta_c--collapse      a difference between two groups of beds; .errors gives it in its standard errors
    metastability.NAME, ...          computed for one report (docs/tables.py)
    """

    def __init__(self, folder, reports=None):
        self.folder = folder  # with the runs
        self.beds = Beds()
        self.runs = {}
        self.reports = reports or {}

    def group_in(self, name):
        """The group of beds with which a name begins, and the rest of the name; None if it begins with no group."""
        names = [*self.beds.groups, *SHORT]
        found = max((each for each in names if name.startswith(f"{each}.")), key=len, default=None)
        return (found, name[len(found) + 1:]) if found else None

    def needs(self, name):
        """The runs from which a value is computed."""
        if self.group_in(name) or name.partition(".")[0] in self.reports:
            return ()
        run = name.partition(".")[0]
        return ("runs/paper.h5",) if run == "paper" else tuple(dict.fromkeys(("runs/demo.h5", f"runs/{run}.h5")))

    def __getitem__(self, name):
        """The value of a name: a number, or a mean with its standard error."""
        if found := self.group_in(name):
            return self.of_beds(*found)
        group, _, rest = name.partition(".")
        if group in self.reports:
            return self.reports[group]()[rest]
        if group not in RUNS:
            raise KeyError(f"{name}: no such beds in docs/data/beds.csv, report of docs/tables.py or run ({', '.join(RUNS)})")
        if group not in self.runs:
            self.runs[group] = self.of_run(group)
        return self.runs[group][rest]

    def of_beds(self, group, rest):
        group = SHORT.get(group, group)
        quantity, _, statistic = rest.partition(".")
        if "~" in quantity:
            r, errors = correlation(*(self.beds.values(group, each) for each in quantity.split("~")))
            return errors if statistic == "errors" else r
        if "--" in quantity:
            quantity, other = quantity.split("--")
            each = [self.beds.values(SHORT.get(name, name), quantity) for name in (group, other)]
            if statistic.isdigit():
                return each[0][int(statistic)] - each[1][int(statistic)]
            ours, theirs = (summary(values.values()) for values in each)
            difference, error = ours["mean"] - theirs["mean"], math.hypot(ours["error"], theirs["error"])
            return difference / error if statistic == "errors" else (difference, error)
        values = self.beds.values(group, quantity)
        if statistic.isdigit():
            return values[int(statistic)]
        found = summary(values.values())
        kind, _, error = statistic.partition(":")
        if kind in ("beds", "pairs"):
            return math.ceil({"beds": 1, "pairs": 2}[kind] * (found["deviation"] / float(error)) ** 2)
        return found[statistic] if statistic else (found["mean"], found["error"])

    def of_run(self, name):
        import talus  # noqa: PLC0415

        with talus.open(self.folder / f"runs/{name}.h5", units="D") as run:
            if name == "paper":
                return self.of_paper_run(run)
            observed = run.observables["tilt"] <= run.theta_c
            strain = 100 * run.observables["volume_strain"][observed]
            values = {"theta_c": run.theta_c, "gamma_c": math.sin(math.radians(run.theta_c)), "shrinks": -strain.min(),
                      "expands": strain.max()}
            if name == "demo":
                overloaded = run.analysis["overloaded/fraction"][:, 0]
                return values | {"p_o_flat": overloaded[0], "p_o_repose": overloaded[run.frame_at("repose").index]}
        return values | {"earlier": self["demo.theta_c"] - values["theta_c"]}

    @staticmethod
    def of_paper_run(run):
        """Steps, those that missed their tolerance, and sigma_T/sigma_N over tan(theta) from 3 deg to theta_c, at rest and in all rows."""
        rows = run.observables
        known = (rows["tilt"] >= 3) & (rows["tilt"] <= run.theta_c)
        deviation = abs(rows["sigma_t_over_n"][known] / np.tan(np.radians(rows["tilt"][known])) - 1)
        rest = rows["at_rest"][known] > 0
        deposition, tilt = (int(run[f"results/unconverged_steps{each}"]) for each in ("_deposition", ""))
        return {"steps": len(run.steps["step"]), "unconverged": deposition + tilt, "unconverged_deposition": deposition,
                "unconverged_tilt": tilt, "theta_c": run.theta_c, "rest_deviation": 100 * deviation[rest].max(), "rest_rows": int(rest.sum()),
                "deviation": 100 * np.quantile(deviation, 0.99), "rows": len(deviation),
                "overlap": rows["largest_overlap"][rows["tilt"] <= run.theta_c].max()}


def text_of(value, form):
    """A value in a format; `±.2f` for a mean with its standard error, `x100` before it for per cent."""
    scale = 1.0
    if found := re.match(r"x([\de.]+):", form):
        scale, form = float(found[1]), form[found.end():]
    if form.startswith("±"):
        return " ± ".join(format(each * scale, form[1:]) for each in value)
    value = value[0] if isinstance(value, tuple) else value
    text = format(value * scale, form)
    return text if float(text) or not text.startswith("-") else text[1:]  # not -0.0


def marks_of(text):
    """The marked numbers of a page: their matches, in their order. Fails on a comment that follows no number."""
    found = list(MARK.finditer(text))
    marked = {match.end() for match in found}
    for each in ANY_MARK.finditer(text):
        if each.end() not in marked:
            raise ValueError(f"{each[0]}: no number precedes it, or it is not <!--=NAME FORMAT-->")
    return found


def outdated(values, program_json, runs):
    """Sentences about groups of beds that are of another program: whose first members end in other states than the program
    computes, or that are not of one revision without changes. `program_json` gives what `talus info --json` prints of a run, for
    those of `runs`."""
    found = []
    for table, names in (("beds.csv", values.beds.groups.keys() - values.beds.later), ("next/beds.csv", values.beds.later)):
        versions = sorted({bed["version"] for name in names for bed in values.beds.groups[name]})
        if len(versions) > 1 or any("dirty" in version for version in versions):
            found.append(f"docs/data/{table} is of {' and '.join(versions)}, not of one revision without changes: docs/data/campaign run")
    for group, run in FIRST_MEMBERS.items():
        first = next((bed for bed in values.beds.groups.get(group, []) if bed["seed"] == 1), None)
        if run in runs and first and (state := program_json(run)["state_hash"]) != first["state_hash"]:
            found.append(f"docs/data/beds.csv: {group}, seed 1 ends in the state {first['state_hash']}, but {run} in {state}: "
                         "docs/data/campaign run, and collect")
    return found
