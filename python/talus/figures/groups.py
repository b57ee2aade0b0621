"""Runs grouped by scenario: each group is an ensemble, whose runs differ only in their seed and in settings without effect on
the result."""

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from talus.errors import Error
from talus.figures.runs import AnalysedRun, read_runs
from talus.figures.tables import short_text
from talus.simulation import _extension
from talus.version import __version__

#: Symbols of keys in legends.
SYMBOLS = {"contact.friction": "μ", "contact.wall_friction": "μ_w", "contact.rolling_friction": "μ_r",
           "contact.restitution": "e", "contact.tangential_restitution": "e_t", "bed.length": "L", "bed.depth": "H",
           "tilt.rate": "tilt rate", "deposition.method": "deposition", "grains.size_ratio": "size ratio"}
UNITS = {"bed.length": " D", "bed.depth": " D", "tilt.rate": "°/s", "grains.mean_diameter": " m"}
#: Settings without effect on the result: the end of a run and its output. A tolerance of the solver may have one.
WITHOUT_EFFECT = re.compile(r"seed|output\..*|tilt\.(end_angle|after_failure|lowering_rate)|deposition\.max_time")


@dataclass
class Group:
    """Runs that are averaged: one curve of a figure."""

    label: str  #: "PBC, L = 200 D", and the keys that distinguish it from other groups of that bed, or its folder
    runs: list[AnalysedRun]  #: ascending in seed
    #: What was done to the runs that their scenario does not say, and the version that computed them, if it is another.
    departures: list[str] = field(default_factory=list)
    legend: str = ""  #: what differs from the other groups, "μ = 0.2"; empty: the label

    @property
    def periodic(self) -> bool:
        return self.runs[0].periodic

    @property
    def name(self) -> str:
        """The label as a part of a file name: "pbc-l-200-d-contact.friction-0.3"."""
        return re.sub(r"[^A-Za-z0-9._]+", "-", self.label).lstrip("-").lower()

    def select(self, wanted: Callable[[AnalysedRun], Any]) -> list[AnalysedRun]:
        """Returns the runs for which a condition holds."""
        return [run for run in self.runs if wanted(run)]


def flat(scenario: dict[str, Any]) -> dict[str, Any]:
    """Returns the keys of a scenario with their sections, "bed.length"; those of command 1 are "command.1.kind", ..."""
    keys: dict[str, Any] = {}
    for name, value in scenario.items():
        if isinstance(value, list) and name == "command":
            commands = [{"at": "none", "time": "none", "grain": -1, "x": 0.0, "y": 0.0, **each} for each in value]
            keys |= {f"command.{k}.{key}": each for k, command in enumerate(commands, 1) for key, each in command.items()}
        elif isinstance(value, dict):
            keys |= {f"{name}.{key}": each for key, each in value.items()}
        else:
            keys[name] = value
    return keys


def value_text(value: Any) -> str:
    """Returns a value of a scenario as labels show it."""
    if isinstance(value, list):
        return ", ".join(map(value_text, value))
    if isinstance(value, bool):
        return str(value).lower()
    return short_text(value) if isinstance(value, float) else str(value)


def essence(scenario: dict[str, Any]) -> dict[str, Any]:
    """Returns the settings of a scenario that affect the result; runs of one group agree in them."""
    keys = {name: value for name, value in flat(scenario).items() if not WITHOUT_EFFECT.fullmatch(name)}
    if keys["bed.boundary"] == "periodic":
        del keys["contact.wall_friction"]
    return keys


def bed_label(run: AnalysedRun) -> str:
    return f"{'PBC' if run.periodic else 'WBC'}, L = {short_text(run.length)} D"


def differences(groups: Sequence[Group], like: Callable[[Group, Group], bool]) -> list[dict[str, str]]:
    """Returns for each group the keys, with their values, in which it differs from another group for which `like` holds."""
    keys = [essence(group.runs[0].scenario) for group in groups]
    names = max(keys, key=len) if keys else {}
    texts = [{name: value_text(each[name]) if name in each else "none" for name in names} for each in keys]
    return [{name: own[name] for name in names
             if any(like(group, other) and theirs[name] != own[name] for other, theirs in zip(groups, texts))}
            for group, own in zip(groups, texts)]


def set_legends(groups: Sequence[Group]) -> None:
    """Sets what differs among the groups, in symbols: "μ = 0.2"."""
    several_beds = len({bed_label(group.runs[0]) for group in groups}) > 1
    named_by_bed = ("bed.boundary", "bed.length", "contact.wall_friction") if several_beds else ()
    for group, keys in zip(groups, differences(groups, lambda one, other: True)):
        parts = [bed_label(group.runs[0])] if several_beds else []
        parts += [f"{SYMBOLS.get(name, name)} = {value}{UNITS.get(name, '')}" for name, value in keys.items()
                  if name not in named_by_bed]
        if group.departures:
            parts.append(_extension()._departures_text(group.departures))
        group.legend = ", ".join(parts)
    legends = [group.legend for group in groups]
    for group in groups:
        if not group.legend or legends.count(group.legend) > 1:
            group.legend = group.label


def group_runs(runs: Iterable[AnalysedRun]) -> list[Group]:
    """Groups runs in the order of their first run: periodic beds first, then beds between walls by length. Runs of the
    same scenario and seed with different final states belong to two groups. Raises Error if a run occurs twice."""
    groups: list[Group] = []
    for run in runs:
        for group in groups:
            if (group.departures == run.departures and essence(group.runs[0].scenario) == essence(run.scenario)
                    and all(other.seed != run.seed or other.state_hash == run.state_hash for other in group.runs)):
                group.runs.append(run)
                break
        else:
            groups.append(Group(bed_label(run), [run], run.departures))
    for group, keys in zip(groups, differences(groups, lambda one, other: one.label == other.label)):
        group.label += "".join(f", {name} = {value}" for name, value in keys.items())
    for group in groups:
        if group.departures:
            group.label += ", " + _extension()._departures_text(group.departures)
    labels = [group.label for group in groups]
    for group in groups:
        if labels.count(group.label) > 1:  # runs of one scenario that differ in their bits
            group.label += f", {Path(group.runs[0].path.partition('#')[0]).absolute().parent.name}"
        group.runs.sort(key=lambda run: run.seed)
        for one, other in zip(group.runs, group.runs[1:]):
            if one.seed == other.seed:
                raise Error(f"{one.path} and {other.path} are the same run (same scenario and seed); give only one of them")
    groups.sort(key=lambda group: 0.0 if group.periodic else group.runs[0].length)
    set_legends(groups)
    return groups


def read_groups(paths: Iterable[str | Path] | str | Path, settings: Sequence[str] = (), **options: Any) -> list[Group]:
    """Reads runs and ensembles (read_runs, with its options) and groups them by scenario (group_runs)."""
    return group_runs(read_runs(paths, settings, **options))
