"""Runs as figures see them: with a valid analysis, which is computed and stored if there is none."""

import os
import tomllib
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path
from typing import Any

import numpy as np

from talus import run as run_files
from talus.errors import Error, MissingFile, WrongValue
from talus.simulation import _extension

#: Called with the number of analysed frames and that of all frames of a run; None: no report.
Progress = Callable[[int, int], None] | None


@dataclass(frozen=True)
class Quantity:
    """A row of the table of quantities (docs/analysis.md)."""

    name: str  #: "lc/mean"
    shape: str  #: "T F": T frames, F thresholds, ...
    unit: str  #: of tables: "deg", "D", ...; "1" for a plain number
    definition: str
    symbol: str  #: "p_o"
    title: str  #: "p_o, share of overloaded grains"; empty if no curve shows it
    percent: bool  #: curves show it in percent
    has_side: bool  #: its sign changes if the bed slopes backwards


@cache
def quantities() -> dict[str, Quantity]:
    """Returns the table of quantities of the analysis, by name, in its order."""
    return {row[0]: Quantity(*row) for row in _extension()._quantities()}


class AnalysedRun:
    """A run with its analysis, or the values that an `ensemble.h5` holds of a member. Angles are in degrees, lengths in mean
    diameters D; other values are in SI units, per metre of thickness."""

    def __init__(self, core: Any) -> None:
        self.core = core  #: its measures that only figures need (python/bindings/figures.cpp)
        self.path: str = os.fsdecode(core.path)  #: that of the run file, or "FOLDER/ensemble.h5#seed-7"
        self.seed: int = core.seed
        self.state_hash: str = core.state_hash  #: hash of its last state
        self.has_file: bool = core.has_file  #: False: only scalars of the run and of its frames are known
        self.has_frames: bool = core.has_frames  #: False also for a file that was kept for its analysis alone
        self.has_distributions: bool = core.has_distributions  #: those of each frame
        self.thresholds: int = core.thresholds  #: number of thresholds; 0: the slope has not failed, and none was given
        self.theta_r: float = core.theta_r  #: angle at rest after failure; NaN if no flow was followed
        self.departures: list[str] = core.departures  #: what was done to the run that its scenario does not say
        self._values: dict[str, np.ndarray] = {}

    def __repr__(self) -> str:
        return f"<analysed run {self.path}>"

    @cached_property
    def scenario(self) -> dict[str, Any]:
        """The scenario with every key, in the units of the scenario."""
        return tomllib.loads(self.core.scenario_text)

    @property
    def periodic(self) -> bool:
        return bool(self.scenario["bed"]["boundary"] == "periodic")

    @property
    def length(self) -> float:
        """L, the period or the distance between the walls, D."""
        return float(self.scenario["bed"]["length"])

    @cached_property
    def theta_c(self) -> float:
        """Angle of repose, deg; NaN if the slope has not failed."""
        return self.number("theta_c")

    @property
    def failed(self) -> bool:
        return not np.isnan(self.theta_c)

    @cached_property
    def file(self) -> "run_files.Run":
        """The run file, in units of D and degrees. Raises Error if only values of the run are known."""
        return run_files.open(self.path, "D")

    def values(self, name: str) -> np.ndarray:
        """Returns a quantity of the analysis; a row for each frame of the tilt if it has values of frames."""
        if name not in self._values:
            values = np.asarray(self.core.values(name))
            if quantities()[name].shape.startswith("T"):
                values = values.reshape(len(self.tilts), -1)
            self._values[name] = values
        return self._values[name]

    def number(self, name: str, k: int = 0) -> float:
        """Returns a quantity of the run, element k of it if it has several; NaN if it has fewer."""
        values = self.values(name)
        return float(values[k]) if k < len(values) else np.nan

    def series(self, name: str, k: int = 0) -> np.ndarray:
        """Returns a scalar quantity of frames, at threshold k if it depends on one; (frames,), NaN if there is none."""
        values = self.values(name)
        return values[:, k] if k < values.shape[1] else np.full(len(values), np.nan)

    @cached_property
    def tilts(self) -> np.ndarray:
        """(frames,) tilts of all frames of the tilt, deg."""
        return np.asarray(self.core.tilts)

    @cached_property
    def rise(self) -> tuple[int, np.ndarray, bool]:
        """The last rise, which leads to failure: its first frame, the magnitudes of its tilts, and whether the bed slopes
        backwards."""
        first, tilts, mirrored = self.core.rise
        return int(first), np.asarray(tilts), bool(mirrored)

    @cached_property
    def repose(self) -> int:
        """The last frame with a tilt up to theta_c."""
        return int(self.core.repose_frame)

    def frame_nearest(self, tilt: float) -> int:
        """Returns the frame of the last rise with the tilt nearest to an angle, deg."""
        first, tilts, _ = self.rise
        return first + int(np.argmin(np.abs(tilts - tilt)))

    def reaches(self, tilt: float) -> bool:
        """Whether the slope was tilted up to this angle, deg, before it failed."""
        return self.theta_c > tilt if self.failed else bool(self.rise[1][-1] > tilt - np.degrees(1e-6))


def read_runs(paths: Iterable[str | Path] | str | Path, settings: Sequence[str] = (), *, threads: int = 2,
              progress: Progress = None, report: Callable[[str], None] = lambda text: None) -> list[AnalysedRun]:
    """Reads runs; the finished members of folders of ensembles; and the values in an ensemble.h5, also for a folder that
    has only this file. A run without a valid analysis is analysed, and the analysis is stored in its file if it can be.

    settings: parameters of the analysis, "lc_cut=30" (docs/analysis.md). report: called with a text about each file that
    is not a run, and each analysis that cannot be stored. Raises Error as talus.open does; MissingFile if no member is
    done; and WrongValue for settings without runs to analyse."""
    core = _extension()
    changes = [os.fsencode(setting) for setting in settings]
    core._parse_settings(changes)
    names = [os.fsencode(path) for path in ([paths] if isinstance(paths, (str, Path)) else paths)]
    if len(names) > 1:
        others = [name for name in names if os.path.isfile(name) and not core._begins_as_run(name) and not core._holds_averages(name)]
        for name in others:
            report(f"left out: {os.fsdecode(name)} is not a run")
        if len(others) == len(names):
            raise Error(f"none of these {len(names)} files is a run")
        names = [name for name in names if name not in others]
    found: list[Any] = []
    for name in names:
        averages = os.path.join(name, b"ensemble.h5")
        if os.path.isfile(os.path.join(name, b"ensemble.manifest")):
            members = core._member_runs(name, changes, threads, progress)
            if not members:
                folder = os.fsdecode(name)
                raise MissingFile(f"{folder}: no member of this ensemble is done yet; talus ensemble status {folder} shows their "
                                  "progress")
            found += members
        elif core._holds_averages(name) or os.path.isfile(averages):
            stored = name if core._holds_averages(name) else averages
            if settings:
                wrong = WrongValue(f"--set {settings[0]}: {os.fsdecode(stored)} holds values of an analysis with the default parameters, and "
                                   "no run that could be analysed with others")
                wrong.exit_code = 64
                raise wrong
            found += core._stored_runs(stored)
        else:
            found.append(core._analysed_run(name, changes, threads, progress))
    runs = [AnalysedRun(each) for each in found]
    for run in runs:
        if run.has_file and not run.core.is_kept:
            report(f"note: {run.path}: {os.fsdecode(run.core.kept)}")
    return runs
