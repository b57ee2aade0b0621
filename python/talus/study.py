"""`talus study`: which settings the results of a run depend on (docs/study.md).

    from talus import study
    found = study.read("runs/study")
    found.values["theta_c_deg"]                               # (variations, seeds), NaN if a run has no value
    found.compare("theta_c_deg", "tilt.step=0.002").difference

The folder is that of an ensemble whose first variant is the baseline; each other variant changes one setting of it.
`python3 -m talus.study FOLDER` writes study.csv and study.md, and prints the tables."""

import argparse
import math
import re
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from talus.ensemble import Ensemble, Mean, Member, flat, mean_of, open_ensemble, parse_seeds
from talus.errors import Error
from talus.figures.means import half_interval, paired_difference
from talus.figures.tables import short_text
from talus.page import Table, csv_quoted, json_text, markdown_escaped, plus_minus, write_text
from talus.places import frame_not_after
from talus.run import Run, last_rise
from talus.start import run as run_module

#: Tolerance for equal tilts, deg; tilts are sums in radians.
SAME_ANGLE = 1e-6


class Quantity(NamedTuple):
    """A result of a run that a study compares."""

    name: str  #: in CSV and JSON; the endings "_deg" and "_s" are units, other values are dimensionless
    group: str  #: "slope", "at_reference", "at_theta_c" or "solver"
    title: str  #: in tables, with the unit
    factor: float = 1.0  #: from the value to the unit of tables


#: Quantities of the bed at an angle: their data sets in /analysis, and their titles and factors in tables. Creep is
#: computed here.
OF_BED = {
    "volume_strain": ("packing/volume_strain", "Volume strain ΔV/V (%)", 100.0),
    "centre_of_mass_strain": ("packing/centre_of_mass_strain", "Strain of the centre of mass Δy/y (%)", 100.0),
    "creep": ("", "Creep (% of H)", 100.0),
    "overloaded_fraction": ("overloaded/fraction", "p_o, share of overloaded grains", 1.0),
    "stress_ratio": ("packing/stress_ratio", "Γ = Q/P of the packing", 1.0),
    "coordination_number": ("contacts/coordination_number", "z, coordination number", 1.0),
}
#: All results; docs/study.md defines them.
QUANTITIES = [
    Quantity("theta_c_deg", "slope", "Angle of repose θ_c (°)"),
    *(Quantity(f"{name}_{group}", group, title, factor)
      for group in ("at_reference", "at_theta_c") for name, (_, title, factor) in OF_BED.items()),
    Quantity("residual_max_rest", "solver", "worst residual at rest"),
    Quantity("residual_max_moving", "solver", "while moving"),
    Quantity("unconverged_share", "solver", "not converged (% of steps)", 100.0),
    Quantity("iterations_per_step", "solver", "iterations per step"),
    Quantity("wall_s", "solver", "wall time (s)"),
]


class Result(NamedTuple):
    """Results of a complete run, by the names of QUANTITIES; NaN: the run has no such value."""

    member: Member
    values: dict[str, float]


class Comparison(NamedTuple):
    """A variation and the baseline."""

    value: Mean  #: over the seeds of the variation
    difference: Mean  #: of the differences between runs of the variation and of the baseline with the same seed

    @property
    def verdict(self) -> str:
        """"within error" if zero lies in the interval of 95 % confidence of the difference, else "differs"; "unknown" for
        fewer than two pairs, or if all differ by the same amount, so that the error is not known."""
        count, mean, _, error = self.difference
        if count < 2 or error == 0 != mean:
            return "unknown"
        return "within error" if abs(mean) <= half_interval(self.difference) else "differs"


@dataclass(frozen=True)
class Study:
    """The complete runs of a study."""

    scenario: str  #: name of the scenario in the tables
    baseline: str  #: values that the varied keys have in the baseline: "solver.tolerance=3e-07,tilt.step=0.001"
    variants: list[str]  #: the baseline first
    seeds: list[int]
    reference: float  #: angle at which beds are compared, deg
    runs: list[Result]  #: by seed, and by variant for each seed

    @cached_property
    def values(self) -> dict[str, np.ndarray]:
        """Values of each quantity, one row for each variant and one column for each seed; NaN: no value."""
        values = {quantity.name: np.full((len(self.variants), len(self.seeds)), np.nan) for quantity in QUANTITIES}
        for member, found in self.runs:
            place = self.variants.index(member.variant), self.seeds.index(member.seed)
            for name, value in found.items():
                values[name][place] = value
        return values

    def compare(self, name: str, variant: str) -> Comparison:
        """Compares a quantity of a variant with that of the baseline."""
        values = self.values[name]
        row = values[self.variants.index(variant)]
        return Comparison(mean_of(row), paired_difference(row, values[0]))

    def has(self, quantity: Quantity) -> bool:
        """Whether any run has a value."""
        return not np.isnan(self.values[quantity.name]).all()


def read(folder: str | Path, seeds: Sequence[int] | None = None, variants: Sequence[str] | None = None,
         reference: float | None = None, scenario: str = "") -> Study:
    """Reads the complete runs of a study, of all its seeds and variants or of some. `reference`: the angle at which beds
    are compared, deg; by default the smallest theta_c, rounded down to a whole degree, or the smallest last tilt if no
    slope has failed. Raises Error if no run is complete, and as open_ensemble does."""
    ensemble = open_ensemble(folder)
    seeds, variants = list(seeds or ensemble.seeds), list(variants or ensemble.variants)
    for variant in variants:
        ensemble.scenario(variant)  # raises for an unknown one
    members = [member for member in ensemble.done() if member.seed in seeds and member.variant in variants]
    if not members:
        raise Error("no run of the study is complete; nothing can be compared")
    reached = [_reach_of(member) for member in members]
    angle = common_angle(reached) if reference is None else reference
    runs = [Result(member, results_of(member, reach, angle)) for member, reach in zip(members, reached)]
    return Study(scenario or str(folder), baseline_of(ensemble, variants), variants, seeds, angle, runs)


def _reach_of(member: Member) -> tuple[float, float]:
    with member.open() as run:
        return reach(run)


def reach(run: Run) -> tuple[float, float]:
    """Returns theta_c, NaN if the slope has not failed, and the last tilt, deg."""
    tilts = run["frames/tilt"][: run.frames_of_tilt]
    by_time = run.has_program or bool((np.diff(tilts) <= 0).any())
    end = np.abs(tilts[slice(*last_rise(tilts))])[-1:].sum() if by_time else run["checkpoint/tilt"]
    return float(np.degrees(run.results["theta_c"])), float(np.degrees(end))


def common_angle(reached: Sequence[tuple[float, float]]) -> float:
    """Returns the default of the reference angle, deg, for runs with these theta_c and last tilts."""
    failed = min((theta_c for theta_c, _ in reached if not math.isnan(theta_c)), default=math.inf)
    standing = min((end for theta_c, end in reached if math.isnan(theta_c)), default=math.inf)
    # A tilt is a sum in radians, so that 3 deg may read 3.0000000000000004.
    return min(math.floor(failed) if failed < math.inf else failed, round(standing, 6) if standing < math.inf else standing)


def results_of(member: Member, reached: tuple[float, float], reference: float) -> dict[str, float]:
    """Returns the results of a complete run, with the bed at `reference` deg and at theta_c, each from the last frame with
    a tilt not above the angle. A run that failed before `reference`, or did not reach it, has no values there."""
    theta_c, end = reached
    found = dict.fromkeys((quantity.name for quantity in QUANTITIES), math.nan)
    found["theta_c_deg"] = theta_c
    with member.open() as run:
        tilts = run["frames/tilt"][: run.frames_of_tilt]
        first, last = last_rise(tilts)
        theta = np.degrees(np.abs(tilts[first:last]))
        before_flow = theta[~(np.abs(tilts[first:last]) > run.results["theta_c"])]
        for name, (source, *_) in OF_BED.items():
            if reference <= (end if math.isnan(theta_c) else theta_c) + SAME_ANGLE:
                k = frame_not_after(before_flow if source else theta, reference)
                if source in run.analysis and k >= 0:
                    found[f"{name}_at_reference"] = float(np.ravel(run.analysis[source][first + k])[0])
                elif not source:
                    found[f"{name}_at_reference"] = creep(run, first + k) if k >= 0 else math.nan
            if not math.isnan(theta_c):
                k = frame_not_after(theta, theta_c)
                found[f"{name}_at_theta_c"] = (member.numbers.get(f"{source}@theta_c", math.nan) if source else
                                               creep(run, first + k) if k >= 0 else math.nan)
        found |= solution_of(run)
    found["wall_s"] = member.seconds
    return found


def creep(run: Run, k: int) -> float:
    """Returns the mean displacement downslope of the free grains from the first frame to frame k, over the nominal depth
    of the bed; NaN without frames."""
    if not run.has_frames:
        return math.nan
    displacement = run.frames[k].unwrapped[run.free, 0] - run.frames[0].unwrapped[run.free, 0]
    return float(displacement.mean() / run.depth)


def solution_of(run: Run) -> dict[str, float]:
    """Returns how the steps of the tilt were solved."""
    tilting = run["steps/phase"] == 1
    steps = np.float64(tilting.sum())
    with np.errstate(invalid="ignore", divide="ignore"):
        return {"residual_max_rest": run.results.get("residual_max_rest", math.nan),
                "residual_max_moving": run.results.get("residual_max_moving", math.nan),
                "unconverged_share": float(run.results.get("unconverged_steps", math.nan) / steps),
                "iterations_per_step": float(run["steps/iterations"][tilting].sum() / steps)}


def baseline_of(ensemble: Ensemble, variants: Sequence[str]) -> str:
    """Returns the values that the keys varied by the variants have in the first of them."""
    keys = flat(ensemble.scenario(variants[0]))
    varied: dict[str, str] = {}
    for variant in variants[1:]:
        name = ensemble.full_names.get(variant, variant)
        places = {key: re.search(f"(^|,){re.escape(key)}=", name) for key in keys}
        for key, _ in sorted(((key, place.start()) for key, place in places.items() if place), key=lambda found: found[1]):
            varied[key] = f"{key}={_value_text(keys[key])}"
    return ",".join(varied.values())


def _value_text(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, list):
        return (", " if any(isinstance(item, str) for item in value) else ",").join(map(_value_text, value))
    return short_text(value) if isinstance(value, float) else str(value)


# Tables


def csv(study: Study) -> str:
    """Returns one row for each complete run, with all digits; empty cells: no value."""
    rows = [[csv_quoted(member.variant), str(member.seed),
             *("" if math.isnan(values[quantity.name]) else short_text(values[quantity.name]) for quantity in QUANTITIES),
             short_text(study.reference), member.state_hash, member.version] for member, values in study.runs]
    names = [quantity.name for quantity in QUANTITIES]
    return Table(["variation", "seed", *names, "reference_deg", "state_hash", "version"], rows).csv()


def markdown(study: Study) -> str:
    """Returns the tables of all variations: means with their standard errors, and differences from the baseline."""
    text = _introduction(study)
    text += "## Angle of repose, and how well it was solved\n\n" + _values_table(study, "slope", "solver")
    text += f"## The bed at {short_text(study.reference)} deg\n\n" + _values_table(study, "at_reference")
    if study.has(QUANTITIES[0]):
        text += "## The bed at theta_c\n\n" + _values_table(study, "at_theta_c")
    return text + _differences(study) if len(study.variants) > 1 else text


def _introduction(study: Study) -> str:
    versions = sorted({member.version for member, _ in study.runs})
    text = (f"# Study of {markdown_escaped(study.scenario)}\n\n{len(study.runs)} of {len(study.variants) * len(study.seeds)} "
            f"runs complete; seeds {', '.join(map(str, study.seeds))}. Values are means over seeds ± standard error; worst "
            "residuals are the largest of all seeds.\n")
    if study.baseline:
        text += f"Baseline: {markdown_escaped(study.baseline)}.\n"
    text += "".join(f"Computed by Talus {version}.\n" for version in versions)
    if len(versions) > 1:
        text += "**The runs come from several versions of Talus, which may cause differences.**\n"
    return text + "\n"


def _quantities(study: Study, groups: Sequence[str]) -> list[Quantity]:
    return [quantity for group in groups for quantity in QUANTITIES if quantity.group == group and study.has(quantity)]


def _values_table(study: Study, *groups: str) -> str:
    known = _quantities(study, groups)
    if not known:
        return "No run has values here.\n\n"
    rows = [[markdown_escaped(variant), *(_value_cell(study, variant, quantity) for quantity in known)]
            for variant in study.variants]
    return Table(["variation", *(quantity.title for quantity in known)], rows).markdown() + "\n"


def _value_cell(study: Study, variant: str, quantity: Quantity) -> str:
    if quantity.group != "solver":
        return _mean_text(study.compare(quantity.name, variant).value, quantity.factor, len(study.seeds))
    values = study.values[quantity.name][study.variants.index(variant)] * quantity.factor
    if np.isnan(values).all():
        return "-"
    return f"{np.nanmax(values):.1e}" if quantity.name.startswith("residual_max") else f"{mean_of(values).mean:.3g}"


def _mean_text(value: Mean, factor: float, seeds: int, sign: str = "") -> str:
    """Returns mean ± error, or the mean with four digits if it has no error; a count is added if seeds are missing."""
    if value.count == 0:
        return "-"
    mean, error = value.mean * factor, value.error * factor
    text = plus_minus(mean, error, bool(sign)) if error > 0 else f"{mean:{sign}.4g}" + " ± 0" * (value.count > 1)
    return text if value.count == seeds else f"{text} ({value.count} seeds)"


def _difference_cell(found: Comparison, factor: float, seeds: int) -> str:
    text = _mean_text(found.difference, factor, seeds, "+")
    if found.verdict == "unknown":
        return text + ", the same for all seeds: without an error" * (found.difference.count > 1)
    return f"**differs by {text}**" if found.verdict == "differs" else f"{text}, within error"


def _differences(study: Study) -> str:
    text, made, differing = "", 0, 0
    parts = [(f"theta_c, and the bed at {short_text(study.reference)} deg", ["slope", "at_reference"])]
    if study.has(QUANTITIES[0]):
        parts.append(("the bed at theta_c", ["at_theta_c"]))
    for title, groups in parts:
        known = _quantities(study, groups)
        rows = []
        for variant in study.variants[1:]:
            found = [study.compare(quantity.name, variant) for quantity in known]
            made += sum(each.difference.count > 1 for each in found)
            differing += sum(each.verdict == "differs" for each in found)
            rows.append([markdown_escaped(variant), *(_difference_cell(each, quantity.factor, len(study.seeds))
                                                      for each, quantity in zip(found, known))])
        text += f"## Difference from the baseline: {title}\n\n"
        text += Table(["variation", *(quantity.title for quantity in known)], rows).markdown() + "\n"
    return (f"{text}Mean of the differences of runs with the same seed ± standard error. Within error: zero lies in the "
            f"interval of 95 % confidence (Student's t). {differing} of {made} comparisons differ; by chance alone about "
            f"{0.05 * made:.1f} would.\n")


def as_json(study: Study) -> dict[str, Any]:
    """Returns the results of each run, and the comparison of each variation with the baseline."""
    def comparison(found: Comparison) -> dict[str, Any]:
        value, difference = found
        return {"seeds": value.count, "mean": value.mean, "error": value.error, "difference": difference.mean,
                "difference_error": difference.error, "verdict": found.verdict}

    return {"scenario": study.scenario,
            "reference_deg": study.reference,
            "variations": {variant: {quantity.name: comparison(study.compare(quantity.name, variant)) for quantity in QUANTITIES}
                           for variant in study.variants},
            "runs": {f"{member.variant}/seed-{member.seed}":
                     {**values, "state_hash": member.state_hash, "version": member.version} for member, values in study.runs}}


def main(arguments: list[str]) -> int:
    """Writes study.csv and study.md into the folder of a study, and prints the tables."""
    parser = argparse.ArgumentParser(prog="talus.study", description="Tables of a study, from the complete runs in its folder")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--scenario", default="", help="name of the scenario in the tables")
    parser.add_argument("--seeds", type=parse_seeds, help="only these, e.g. 1-4")
    parser.add_argument("--variant", action="append", help="only these, the baseline first")
    parser.add_argument("--reference", type=float, help="tilt at which beds are compared, deg")
    parser.add_argument("--json", action="store_true", help="print JSON")
    asked = parser.parse_args(arguments)
    study = read(asked.folder, asked.seeds, asked.variant, asked.reference, asked.scenario)
    write_text(asked.folder / "study.csv", csv(study))
    write_text(asked.folder / "study.md", markdown(study))
    print(json_text(as_json(study)) if asked.json else markdown(study))
    return 0


if __name__ == "__main__":
    sys.exit(run_module("study", sys.argv[1:]))
