"""Runs grouped by scenario: each group is an ensemble, whose runs differ only in their seed and in settings without effect on
the result."""

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from talus.ensemble import flat
from talus.errors import Error
from talus.figures.runs import AnalysedRun, read_runs
from talus.figures.tables import literal, short_text
from talus.page import visible

#: Symbols of keys in legends.
SYMBOLS = {"contact.friction": "μ", "contact.wall_friction": "μ_w", "contact.rolling_friction": "μ_r",
           "contact.restitution": "e", "contact.tangential_restitution": "e_t", "bed.length": "L", "bed.depth": "H",
           "tilt.rate": "tilt rate", "deposition.method": "deposition", "grains.size_ratio": "size ratio"}
UNITS = {"bed.length": " D", "bed.depth": " D", "tilt.rate": "°/s", "grains.mean_diameter": " m"}
#: Longest part of a file name that names a group.
LONGEST_NAME = 120
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
        with_signs = re.sub(r"(?<![\w.])-(?=[\d.])", "minus ", self.label)
        return re.sub(r"[^A-Za-z0-9._]+", "-", with_signs).strip("-").lower()[:LONGEST_NAME] or "group"

    def select(self, wanted: Callable[[AnalysedRun], Any]) -> list[AnalysedRun]:
        """Returns the runs for which a condition holds."""
        return [run for run in self.runs if wanted(run)]


def value_text(value: Any) -> str:
    """Returns a value of a scenario as labels show it."""
    if isinstance(value, list):
        return ", ".join(map(value_text, value))
    if isinstance(value, bool):
        return str(value).lower()
    return short_text(value) if isinstance(value, float) else shown_text(str(value))


def essence(scenario: dict[str, Any]) -> dict[str, Any]:
    """Returns the settings of a scenario that affect the result; runs of one group agree in them."""
    keys = {name: value for name, value in flat(scenario).items() if not WITHOUT_EFFECT.fullmatch(name)}
    if keys["bed.boundary"] == "periodic":
        del keys["contact.wall_friction"]
        keys["deposition.wall_friction"] = "contact"  # the default: no bed is named by it
    return keys


def bed_label(run: AnalysedRun) -> str:
    return f"{'PBC' if run.periodic else 'WBC'}, L = {short_text(run.length)} D"


def shown_text(text: str) -> str:
    """Returns a name of the user as labels show it, in one line."""
    return visible(text).replace("\n", " ")


def settings_of(run: AnalysedRun) -> dict[str, str]:
    """Returns the settings of `essence` as texts; "command.1" is the first command, "friction 0.1 at 5 deg"."""
    found = {name: value_text(value) for name, value in essence(run.scenario).items() if not name.startswith("command.")}
    return found | {f"command.{k}": text for k, text in enumerate(run.core.commands, 1)}


def differences(groups: Sequence[Group], like: Callable[[Group, Group], bool]) -> list[dict[str, str]]:
    """Returns for each group the settings, with their texts, in which it differs from another group for which `like` holds."""
    keys = [settings_of(group.runs[0]) for group in groups]
    names = dict.fromkeys(name for each in sorted(keys, key=len, reverse=True) for name in each)
    texts = [{name: each.get(name, "none") for name in names} for each in keys]
    return [{name: own[name] for name in names
             if any(like(group, other) and theirs[name] != own[name] for other, theirs in zip(groups, texts))}
            for group, own in zip(groups, texts)]


def label_parts(settings: dict[str, str], departure: str, in_symbols: bool = False) -> list[str]:
    """Returns settings and departures as parts of a label, "contact.friction = 0.2", or of a legend, "μ = 0.2". A command is
    its own description; the lack of one is named if there is no other."""
    parts = [f"{SYMBOLS.get(name, name)} = {text}{UNITS.get(name, '')}" if in_symbols else f"{name} = {text}"
             for name, text in settings.items() if not name.startswith("command.")]
    commands = {name: text for name, text in settings.items() if name.startswith("command.")}
    given = [text for text in commands.values() if text != "none"]
    given[2:] = [f"{len(given) - 2} more commands"] if len(given) > 3 else given[2:]
    given += [departure] * bool(departure)
    if in_symbols:
        given = list(map(in_short, given))
    return parts + (given or [f"no {name.removesuffix('.1').replace('.', ' ')}" for name in commands][:1])


def departure_texts(departures: Sequence[list[str]]) -> list[str]:
    """Returns a text for each list of departures: the first of them, those in which it differs from lists of the same text,
    and the number of the others."""
    shown = [[0] if each else [] for each in departures]

    def text(k: int) -> str:
        more = len(departures[k]) - len(shown[k])
        return "; ".join(departures[k][place] for place in shown[k]) + (f" and {more} more" if more else "")

    texts = [text(k) for k in range(len(departures))]
    for k, own in enumerate(departures):
        while others := [m for m, other in enumerate(departures) if other != own and texts[m] == texts[k]]:
            pairs = enumerate(zip(own, departures[others[0]]))
            place = next((n for n, (one, other) in pairs if one != other and n not in shown[k]), None)
            if place is None:
                break
            for m in [m for m, each in enumerate(texts) if each == texts[k]]:
                shown[m] = sorted([*shown[m], place])
            texts = [text(m) for m in range(len(departures))]
    return texts


def in_short(text: str) -> str:
    """Returns a command or departure as legends show it: "tilt rate −1°/s at 5°"."""
    text = re.sub(r" at (-?[\d.]+) deg(?:, -?[\d.]+ s)?\b", lambda found: f" at {short_text(float(found[1]))}°", text)
    return re.sub(r"(?<![\w.])-(?=\d)", "−", text.replace(" deg/s", "°/s"))


def set_legends(groups: Sequence[Group], departures: Sequence[str]) -> None:
    """Sets what differs among the groups, in symbols: "μ = 0.2". `departures`: those of each group as a text."""
    several_beds = len({bed_label(group.runs[0]) for group in groups}) > 1
    named_by_bed = ["bed.boundary", "bed.length"] if several_beds else []
    if len({essence(group.runs[0].scenario)["contact.wall_friction"] for group in groups if not group.periodic}) < 2:
        named_by_bed.append("contact.wall_friction")
    for group, settings, departure in zip(groups, differences(groups, lambda one, other: True), departures):
        named = {name: text for name, text in settings.items()
                 if name not in named_by_bed and (name, text) != ("contact.wall_friction", "none")}
        group.legend = ", ".join([bed_label(group.runs[0])] * several_beds + label_parts(named, departure, True))
    legends = [group.legend for group in groups]
    for group in groups:
        group.legend = literal(group.label if not group.legend or legends.count(group.legend) > 1 else group.legend)


def parts_by_length(groups: Sequence[Group]) -> list[tuple[str, list[Group]]]:
    """Parts groups such that those of a part differ only in the length of the bed, and names what differs between the parts."""
    kinds: dict[str, list[Group]] = {}
    for group in groups:
        settings = {**essence(group.runs[0].scenario), "bed.length": 0}
        kinds.setdefault(repr((group.departures, sorted(settings.items()))), []).append(group)
    parts = list(kinds.values())
    firsts = [part[0] for part in parts]
    names = []
    for found, departure in zip(differences(firsts, lambda one, other: True), departure_texts([group.departures for group in firsts])):
        found.pop("bed.length", None)
        names.append(literal(", ".join(label_parts(found, departure, True))))
    return list(zip(names, parts))


def names_of_places(runs: Sequence[AnalysedRun]) -> list[str]:
    """Returns names by which runs of one scenario differ: those of their folders, else of their files, else their paths."""
    paths = [Path(run.path if run.has_file else run.path.rpartition("#")[0]).absolute() for run in runs]
    choices = [path.parent.name for path in paths], [path.name for path in paths]
    return [shown_text(name) for name in next((names for names in choices if len(set(names)) == len(names)), map(str, paths))]


def kind_of(run: AnalysedRun) -> str:
    """Returns what runs of one group agree in: the settings that affect the result, commands, and the version if it is another."""
    return repr((run.departures, run.core.own_commands, sorted(essence(run.scenario).items())))


def parts_of(runs: Sequence[AnalysedRun]) -> list[list[AnalysedRun]]:
    """Parts runs that are alike such that each part has a seed once: all of them, or those of each folder, or fewer. Of runs that
    differ only in settings without effect the first is taken. Raises Error if a run occurs twice."""
    known: dict[tuple[int, str], AnalysedRun] = {}
    for run in runs:
        one = known.get((run.seed, run.state_hash))
        if one and one.scenario == run.scenario:
            raise Error(f"{one.path} and {run.path} are the same run (same scenario and seed); give only one of them")
        known[run.seed, run.state_hash] = one or run
    runs = list(known.values())
    several_states = len({run.seed for run in runs}) < len(runs)
    parts: dict[tuple[Path, int], list[AnalysedRun]] = {}
    for run in runs:
        folder, k = Path(run.path).parent if several_states else Path(), 0
        while any(other.seed == run.seed for other in parts.get((folder, k), [])):
            k += 1
        parts.setdefault((folder, k), []).append(run)
    return list(parts.values())


def group_runs(runs: Iterable[AnalysedRun]) -> list[Group]:
    """Groups runs in the order of their first run: periodic beds first, then beds between walls by length. Runs of the
    same scenario and seed with different final states belong to two groups. Raises Error if a run occurs twice."""
    kinds: dict[str, list[AnalysedRun]] = {}
    for run in runs:
        kinds.setdefault(kind_of(run), []).append(run)
    groups = [Group(bed_label(part[0]), sorted(part, key=lambda run: run.seed), part[0].departures)
              for kind in kinds.values() for part in parts_of(kind)]
    departures = departure_texts([group.departures for group in groups])
    for group, settings, departure in zip(groups, differences(groups, lambda one, other: one.label == other.label), departures):
        group.label = ", ".join([group.label, *label_parts(settings, departure)])
    for label in dict.fromkeys(group.label for group in groups):
        alike = [group for group in groups if group.label == label]
        if len(alike) > 1:
            for group, place in zip(alike, names_of_places([group.runs[0] for group in alike])):
                group.label += f", {place}"
    order = sorted(range(len(groups)), key=lambda k: 0.0 if groups[k].periodic else groups[k].runs[0].length)
    groups, departures = [groups[k] for k in order], [departures[k] for k in order]
    set_legends(groups, departures)
    return groups


def read_groups(paths: Iterable[str | Path] | str | Path, settings: Sequence[str] = (), **options: Any) -> list[Group]:
    """Reads runs and ensembles (read_runs, with its options) and groups them by scenario (group_runs)."""
    return group_runs(read_runs(paths, settings, **options))
