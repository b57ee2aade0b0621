"""Data of a figure: tables for each group of runs, the runs that they come from, and the caption."""

import itertools
import os
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from talus.ensemble import flat
from talus.errors import Error, WrongValue
from talus.figures.groups import Group
from talus.figures.means import Abscissa, Series, mean_columns, mean_rows, run_columns, run_curve
from talus.figures.runs import AnalysedRun
from talus.figures.tables import Column, Table, column, short_text
from talus.simulation import _extension

#: Groups up to which standard deviations and single runs are drawn without being asked for.
MOST_GROUPS_WITH_SPREAD = 2
MEANS = ("Means over the runs of each group at the same tilt, as long as at least half of them have not failed. The dark band "
         "is the standard error of the mean.")
SPREAD = " The light band is the standard deviation of the runs; thin lines are the single runs, at most 100 of them."
#: Names of tables of figures that are not those of groups.
OTHER_TABLES = ("paper", "contacts", "surface", "trace", "ends", "coefficients")
#: Settings of the paper's beds.
PAPER = {"bed.depth": 40, "bed.floor": "rough", "contact.friction": 0.5, "contact.rolling_friction": 0, "grains.size_ratio": 1.5}


@dataclass(frozen=True)
class Wanted:
    """Choices of what a figure shows."""

    at: Sequence[str] = ()  #: frames instead of those of the paper: "10" (deg), "repose", "frame42"
    paper: bool = False  #: the paper's values also for other beds than the paper's
    spread: bool = False  #: standard deviations and single runs also of more than two groups


def shows_paper(groups: Sequence[Group], wanted: Wanted) -> bool:
    """Whether the paper's values are shown: those of a bed of the paper, or of any bed if wanted."""
    beds = [flat(group.runs[0].scenario) for group in groups]
    return wanted.paper or any(all(bed[name] == value for name, value in PAPER.items()) and
                               (bed["bed.boundary"] == "walls" or bed["bed.length"] == 200) for bed in beds)


@dataclass
class GroupTable:
    """The data of a group of runs."""

    legend: str  #: "μ = 0.2 (4 runs)"
    table: Table
    runs: Table | None = None  #: the single runs, in blocks
    count: int = 1  #: number of runs
    facts: dict[str, Any] = field(default_factory=dict)  #: further numbers that the drawing needs


@dataclass
class Data:
    """What a figure shows: everything that is drawn is in its tables and facts."""

    caption: str = ""
    groups: list[GroupTable] = field(default_factory=list)
    tables: list[Table] = field(default_factory=list)  #: all tables, in the order of their files
    runs: list[AnalysedRun] = field(default_factory=list)  #: sources
    facts: dict[str, Any] = field(default_factory=dict)  #: further numbers and texts that the drawing needs
    title: str = ""  #: instead of that of the catalogue

    def add_group(self, group: Group, runs: Sequence[AnalysedRun], columns: list[Column]) -> GroupTable:
        """Adds the table of a group, named after its label; a number is added if another table has this name."""
        taken = {*OTHER_TABLES, *(table.name for table in self.tables)}
        names = itertools.chain([group.name], (f"{group.name}-{k}" for k in itertools.count(2)))
        name = next(name for name in names if taken.isdisjoint((name, name + "-runs")))
        added = GroupTable(f"{group.legend or group.label} ({runs_text(len(runs))})", Table(name, columns), count=len(runs))
        self.groups.append(added)
        self.tables.append(added.table)
        self.runs += runs
        return added

    def add_curves(self, group: Group, runs: Sequence[AnalysedRun], columns: Sequence[Series],
                   abscissa: Abscissa = "theta") -> GroupTable:
        """Adds the means of these columns over the runs of a group, and the single runs if there are several."""
        curves = [run_curve(run, columns, abscissa) for run in runs]
        added = self.add_group(group, runs, mean_columns(curves, columns, abscissa))
        if len(runs) > 1:
            added.runs = Table(added.table.name + "-runs", run_columns(runs, curves, columns, abscissa), in_blocks=True)
            self.tables.append(added.runs)
        return added

    @property
    def has_errors(self) -> bool:
        """Whether any group has several runs."""
        return any(group.runs is not None for group in self.groups)

    def describe_means(self, wanted: Wanted) -> None:
        """Decides whether deviations and single runs are shown, and adds a sentence about the means to the caption."""
        self.facts["spread"] = self.has_errors and (wanted.spread or len(self.groups) <= MOST_GROUPS_WITH_SPREAD)
        self.caption += " " + MEANS + (SPREAD if self.facts["spread"] else "") + " A single run has no band."


def runs_text(count: int) -> str:
    return f"{count} run{'' if count == 1 else 's'}"


def reading(run: AnalysedRun) -> str:
    """Returns a sentence for captions with the neighbourhood of a grain to which gamma refers."""
    l_min = float(run.core.parameters["l_min"])
    if l_min == 0:
        return "gamma is that of single grains."
    who = "its first neighbours" if l_min == _extension()._default_l_min else "its neighbours"
    return f"gamma of a grain is that of the grain together with {who}, a neighbourhood of diameter {l_min:g} D."


def rounded(value: float, decimals: int = 2) -> str:
    """Returns a value with at most this many decimals: "13.25", "0"."""
    scale = 10.0**decimals
    return short_text(np.copysign(np.floor(np.abs(value) * scale + 0.5), value) / scale + 0.0)


@dataclass
class ShownFrames:
    """Frames that a figure shows together, one for each run that has it."""

    name: str  #: for columns: "10", "repose", "start" for the first frame, "frame42"
    label: str  #: for the legend: "θ = 10°", "before failure"
    text: str  #: for captions: "at 10 deg", "in the last frame before failure"
    runs: list[AnalysedRun]
    frames: list[int]

    @property
    def tilt(self) -> float:
        """Mean tilt of the frames, deg."""
        return float(np.mean([run.tilts[k] for run, k in zip(self.runs, self.frames)]))

    def mean(self, quantity: str, name: str, unit: str, meaning: str) -> list[Column]:
        """Returns the columns NAME and NAME_error with the means over the runs of a list in each frame."""
        mean, error = mean_rows([run.values(quantity)[k] for run, k in zip(self.runs, self.frames)])
        return [column(name, unit, meaning, mean), column(name + "_error", unit, "its standard error over the runs", error)]


def named_frames(word: str) -> ShownFrames:
    if word == "repose":
        return ShownFrames(word, "before failure", "in the last frame before failure", [], [])
    if word == "frame0":
        return ShownFrames("start", "start of the tilt", "at the start of the tilt", [], [])
    if word.startswith("frame"):
        return ShownFrames(word, f"frame {word[5:]}", f"in frame {word[5:]}", [], [])
    return ShownFrames(word, f"$θ$ = {word}°", f"at {word} deg", [], [])


def single_words(word: str) -> list[str]:
    """Returns the words for the single frames of a range "frame0-frame10", and any other word alone."""
    ends = re.fullmatch(r"frame([0-9]{1,5})-frame([0-9]{1,5})", word)
    frames = range(int(ends[1]), int(ends[2]) + 1) if ends else []
    return [f"frame{k}" for k in frames] or [word]


def frames_of(run: AnalysedRun, at: Sequence[str]) -> list[int]:
    """Returns the frames of `--at` in one run, ascending. Raises Error for invalid words, and for frames that it lacks."""
    return list(run.core.frames_at([os.fsencode(word) for word in at]))


def shown_frames(groups: Sequence[Sequence[AnalysedRun]], at: Sequence[str], usual: Sequence[str]) -> list[list[ShownFrames]]:
    """Returns for the runs of each group the frames of `at` or, if it is empty, those of `usual`; a usual angle is shown for
    the runs that reach it. Raises Error if a word is invalid, or if no run of any group has its frame."""
    at = [each for word in at for each in single_words(word)]
    found = [[frames_in(runs, word, not at) for word in at or usual] for runs in groups]
    for word, *frames in zip(at, *found):
        if not any(each.runs for each in frames):
            raise Error(f"--at {word}: no run of {groups[0][0].path} has such a frame" if len(groups) == 1 else
                        f"--at {word}: no run has such a frame")
    return found


def frames_in(runs: Sequence[AnalysedRun], word: str, is_usual: bool) -> ShownFrames:
    """Returns the frames of these runs that a word names."""
    frames = named_frames(word)
    if is_usual and word.isdigit():
        frames.runs = [run for run in runs if run.reaches(float(word))]
        frames.frames = [run.frame_nearest(float(word)) for run in frames.runs]
        return frames
    for run in runs:
        try:
            frames.frames.append(frames_of(run, [word])[0])
            frames.runs.append(run)
        except WrongValue as error:
            if error.exit_code != 65:
                raise
    return frames
