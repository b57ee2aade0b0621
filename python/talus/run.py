"""Run, read from its packed file or from the folder in which it is being computed."""

import os
import tomllib
from collections.abc import Iterable, Sequence
from functools import cached_property
from operator import index as as_integer
from pathlib import Path
from typing import Any, Literal

import numpy as np

from talus.checked_file import Identity, field_of
from talus.checks import check_between, check_frame_values, check_series, check_statics, refuse
from talus.drawing import stored_quantity
from talus.errors import (Closed, Error, MissingIndex, MissingName, WrongType, WrongValue, check_flag, check_text,
                          error_of_code, short, suggestion)
from talus.frame import Frame
from talus.schema import ANALYSIS, DATA_SETS, SCHEMA
from talus.storage import Storage, find_run, manifest_text, unreadable
from talus.table import Table
from talus.units import Units, check_units, rounded_degrees, unit_in, values_in

#: Kinds of commands by their numbers in /commands/kind.
KINDS = ("push", "drop", "friction", "tilt_rate", "drag", "release")


def last_rise(tilts: np.ndarray) -> tuple[int, int]:
    """Returns the first index and the index after the last of the last stretch of tilts whose magnitude rises and does
    not fall; all tilts if none rises."""
    change = np.diff(np.abs(tilts))
    rises = np.flatnonzero(change > 0)
    if not len(rises):
        return 0, len(tilts)
    falls = np.flatnonzero(change < 0)
    before, after = falls[falls < rises[-1]], falls[falls > rises[-1]]
    return (int(before[-1]) + 1 if len(before) else 0), (int(after[0]) + 1 if len(after) else len(tilts))


def is_by_frame(name: str) -> bool:
    """Whether a data set has values of grains or contacts for each frame, according to its shape."""
    field = field_of(name)
    return field is not None and field[1].startswith(("T N", "M"))


class Frames(Closed, Sequence[Frame]):
    """All frames of a run in order: `run.frames[3]`, `run.frames[-1]`, `len(run.frames)`, `for frame in ...`."""

    def __init__(self, run: "Run") -> None:
        self._run = run
        self._is_closed = True

    def __len__(self) -> int:
        return len(self._run.tilt)

    def __getitem__(self, k: Any) -> Any:
        if isinstance(k, slice):
            try:
                return [self[i] for i in range(*k.indices(len(self)))]
            except (TypeError, ValueError) as error:
                raise WrongType(f"frames[{short(k)}]: {error}") from None
        return Frame(self._run, k)

    def index(self, value: Any, start: int = 0, stop: int | None = None) -> int:
        """Returns the index of a frame of this run. Raises Error if it is not one."""
        try:
            return super().index(value, start, stop)  # type: ignore[arg-type]
        except (TypeError, ValueError):
            raise WrongValue(f"{short(value)} is not a frame of {self._run.path} between {short(start)} and "
                             f"{short(stop)}") from None


class Run(Closed):
    """A run. Arrays are those of the file (docs/file_format.md), floats as float64; lengths and angles are in the units
    in which it was opened, everything else is in SI units, per metre of thickness. `tilt` and `theta_c` are in degrees in
    any units, as those of frames and simulations.

        with talus.open("runs/demo.h5", units="D") as run:
            frame = run.frame_at("repose")
            frame.position, frame.contacts.force
            run.observables["volume_strain"], run.analysis["overloaded/fraction"]
    """

    def __init__(self, storage: Storage, units: Units = "SI") -> None:
        check_units(units)
        self.storage = storage
        self.path = storage.place  #: the packed file, or the folder
        self.units = units
        self.complete = storage.complete  #: False: being computed, or stopped
        schema = storage.read("parameters/schema_version")
        if schema != SCHEMA:
            raise Error(f"{self.path}: has schema version {schema}, this package reads version {SCHEMA}: use the "
                        "package of the Talus version that wrote it, or compute the run again")
        self._check_statics()
        self.D = float(storage.read("parameters/mean_diameter"))  #: mean diameter of the free grains, always in m
        self.gravity = float(storage.read("parameters/gravity"))  #: m/s^2
        self.friction = float(storage.read("parameters/friction"))  #: mu of its scenario, with which it began
        self.periodic = bool(storage.read("parameters/periodic"))
        self.length: float  #: L, the period or the distance between the walls
        self.depth: float  #: H, nominal
        self.length, self.depth = map(float, self._values("particles/grains/box/edges"))
        self.id: np.ndarray = self._values("particles/grains/id")  #: (N,) index of a grain in every array
        self.radius: np.ndarray = self._values("particles/grains/radius")  #: (N,)
        self.mass: np.ndarray = self._values("particles/grains/mass")  #: (N,) kg/m
        self.free: np.ndarray = self._values("particles/grains/species") == 0  #: (N,) False: fixed to the floor
        self.step: np.ndarray = self._values("frames/step")  #: (frames,) steps since the start
        self.time: np.ndarray = self._values("frames/time")  #: (frames,) s
        tilt = self._values("frames/tilt")
        self.tilt: np.ndarray = rounded_degrees(tilt) if units == "SI" else tilt  #: (frames,) angle of the bed, deg
        #: Results of the run: theta_c (NaN if the slope has not failed), theta_r, residual_max, ...
        self.results: dict[str, float] = {name: self._values("results/" + name) for name in storage.names("results")}
        self._is_closed = True

    def _check_statics(self) -> None:
        read = self.storage.read
        edges = read("particles/grains/box/edges")
        d = float(read("parameters/mean_diameter"))
        check_statics(self.path, d, edges, read("particles/grains/radius"), read("particles/grains/mass"),
                      read("particles/grains/species"))
        for name in ("gravity", "friction"):
            check_between(self.path, f"parameters/{name}", read(f"parameters/{name}"), 0)
        self.farthest = min(1e4 * float(edges.sum()), 1e8 * d)  #: largest possible coordinate of a grain, m

    def __reduce__(self) -> Any:
        """Copies and pickles of a run reopen it by its path, in its units."""
        return reopen, (self.storage.absolute, self.units, self.storage.mark, self.storage.known)

    def __enter__(self) -> "Run":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        rest = "" if self.complete else ", not complete"
        return f"<run {self.path}: {len(self.id)} grains, {len(self.tilt)} frames{rest}>"

    def close(self) -> None:
        """Closes the file. Later access opens it again."""
        self.storage.close()

    def __getitem__(self, name: str) -> Any:
        """Returns all values of a data set of the file, in the units of the run, e.g. `run["steps/iterations"]`: an
        array, a number or a text. Raises Error if there is no such data set."""
        return self._values(self._existing(name))

    def _values(self, name: str) -> Any:
        values = self.storage.read(name)
        check_series(self.path, name, values)
        return self._converted(name, values)

    def _known(self, name: Any) -> str:
        """Returns the path of a data set in the storage: `step` and `time` of grain data are those of the frames."""
        name = check_text(name, "the data set").strip("/")
        if name.startswith("particles/grains/") and name.endswith(("/step", "/time")):
            return "frames/" + name.rpartition("/")[2]
        return name

    def _existing(self, name: Any) -> str:
        """Returns the path of a data set in the storage. Raises MissingName if there is none."""
        known = self._known(name)
        if not self.storage.has(known):
            raise MissingName(f"{self.path}: has no data set {known}{suggestion(known, self.quantities)}")
        return known

    @property
    def quantities(self) -> list[str]:
        """Names of all data sets of the run: `run[name]`."""
        groups = dict.fromkeys(name.partition("/")[0] for name in DATA_SETS if "/" in name)
        return [f"{group}/{name}" for group in groups for name in self.storage.names(group)]

    def _converted(self, name: str, values: Any) -> Any:
        unit = self.storage.unit(name)
        if self.units == "D" and unit == "rad" and name.endswith("/tilt"):
            return rounded_degrees(values)
        values = values_in(self.units, unit, values, self.D)
        if isinstance(values, np.ndarray) and values.dtype.kind == "f":
            values = values.astype(np.float64, copy=False)
        return values.item() if isinstance(values, np.generic) else values

    def unit(self, name: str) -> str:
        """Returns the unit of `run[name]`; "1" for a plain number."""
        name = self._existing(name)
        return unit_in(self.units, self.storage.unit(name))

    def meaning(self, name: str) -> str:
        """Returns the definition of a data set, a sentence; empty if the file has none (a folder, /results)."""
        return self.storage.meaning(self._existing(name))

    @property
    def theta_c(self) -> float:
        """Angle of repose, the tilt at which the slope failed, deg; NaN if it has not."""
        return float(rounded_degrees(self.storage.read("results/theta_c")))

    @cached_property
    def scenario(self) -> dict[str, Any]:
        """The scenario with every key, in the units of the scenario (docs/scenario.md): `run.scenario["tilt"]["rate"]`."""
        try:
            return tomllib.loads(self._values("parameters/scenario_resolved"))
        except (ValueError, RecursionError) as error:
            raise refuse(self.path, "parameters/scenario_resolved", f"is not a scenario: {error}") from None

    @cached_property
    def provenance(self) -> dict[str, Any]:
        """Origin of the run: seed, version, git_hash, command, ..."""
        names = [name for name in self.storage.names("provenance") if not name.startswith("timing/")]
        return {name: self._values("provenance/" + name) for name in names}

    @property
    def seed(self) -> int:
        return self._values("provenance/seed")

    @property
    def frames(self) -> Frames:
        """All frames, including those of the flow after failure."""
        return Frames(self)

    @cached_property
    def frames_of_tilt(self) -> int:
        """Number of frames up to the last step of the tilt, whatever its course. These are the frames of the analysis;
        later ones, if any, belong to the flow after failure (tilt.after_failure). The first frame always counts."""
        steps = self.storage.read("frames/step")
        return max(min(1, len(steps)), int(np.searchsorted(steps, self._last_tilt_step, side="right")))

    @cached_property
    def _last_tilt_step(self) -> int:
        """Step number before the flow after failure, whose steps are the last of the run; if it has none, 2^62."""
        if self.storage.has("checkpoint/step"):
            last = int(self.storage.read("checkpoint/step"))
            names = self.storage.names("checkpoint/integers")
            flow = int(self.storage.read("checkpoint/integers/flow_steps")) if "flow_steps" in names else 0
            return last - flow if 0 < flow <= last else 2**62
        flow_steps = self.steps["step"][self.steps["phase"] == 3]  # a repaired run that has lost its last state
        return int(flow_steps[0]) - 1 if len(flow_steps) else 2**62

    @cached_property
    def has_program(self) -> bool:
        """Whether the scenario has a programme (tilt.program), in which the tilt may fall, be held, and change sign."""
        return "last_tilt_step" in self.storage.names("checkpoint/integers")

    @cached_property
    def has_frames(self) -> bool:
        """Whether the run has the data of its frames. False for a file that an ensemble has kept for its analysis
        alone: only `step`, `time` and `tilt` of its frames are known."""
        return not self.complete or self.storage.has("contacts/pair")

    @cached_property
    def force_threshold(self) -> float:
        """Smallest normal force that a contact is considered to carry, N/m: 1e-9 of the mean weight of a free grain."""
        return 1e-9 * float(self.mass[self.free].mean()) * self.gravity if self.free.any() else np.inf

    @cached_property
    def resists_rolling(self) -> bool:
        """Whether contacts have moments."""
        return self.storage.has("contacts/moment")

    @cached_property
    def planes(self) -> int:
        """Number of planes (floor, walls); the largest possible number if the last state of the run is missing."""
        name = "checkpoint/plane_offset"
        return len(self.storage.read(name)) if self.storage.has(name) else 3

    def friction_of(self, k: int, after: bool = False) -> float:
        """Returns the coefficient of friction between grains that was in force in the step which led to frame k, and
        thus to its forces, or that of the step `after` it: as set by a command before, otherwise that of the scenario, of
        its deposition in the step that led to the bed at rest."""
        step, branch = self.step[k], self.storage.names("branch/reals")
        if branch and step == self["branch/step"] and "last_friction" in branch and not after:
            return self["branch/reals/last_friction"]
        friction = self["branch/reals/friction"] if "friction" in branch else None
        for command in np.flatnonzero(self._commands["kind"] == KINDS.index("friction")):
            if self._commands["step"][command] < step + after:
                friction = float(self._commands["x"][command])
        if friction is not None:
            return friction
        deposited = self.scenario["deposition"].get("friction", "contact") if k == 0 and self.tilt[k] == 0 and not after else "contact"
        return self.friction if deposited == "contact" else float(deposited)

    @property
    def commands(self) -> Table:
        """The commands given to the run after it began, one a row: "step", after which each was given, "kind" (0 push,
        1 drop, 2 friction, 3 tilt rate, 4 drag, 5 release), "grain", "x" and "y" (docs/file_format.md). Empty if there
        were none."""
        return Table(self, "commands")

    @cached_property
    def _commands(self) -> dict[str, np.ndarray]:
        """The commands given to the run, by the names of their data sets."""
        return {name: self.commands.get(name, np.array([])) for name in ("step", "kind", "grain", "x", "y")}

    @cached_property
    def departures(self) -> list[str]:
        """What was done to the run that its scenario does not say, in order: the start as a branch, and commands that the
        scenario does not have. Empty for the run that `talus run` makes of its scenario. Without the extension the
        moments of commands are not compared with those in the scenario."""
        branch = bool(self.storage.names("branch"))
        if not branch and not len(self._commands["step"]):
            return []
        try:
            from talus import _core
        except ImportError:
            return ["branch"] * branch + self._other_commands()
        return _core._departures(os.fspath(self.storage.absolute))

    def _other_commands(self) -> list[str]:
        wanted = [(KINDS.index(c["kind"]), c.get("grain", -1), c.get("x", 0.0), c.get("y", 0.0))
                  for c in self.scenario.get("command", [])]
        more = []
        for command in zip(*(self._commands[name].tolist() for name in ("kind", "grain", "x", "y"))):
            if command in wanted:
                wanted.remove(command)
            else:
                more.append(KINDS[command[0]])
        return more

    def frame_at(self, angle: float | Literal["repose"]) -> Frame:
        """Returns the frame of the tilt nearest to an angle in degrees, or, for "repose", the last frame with a tilt up
        to theta_c, like `--at` of `talus render`. If the tilt goes up and down, this is the first frame that reaches
        the angle, and "repose" refers to the last rise. Raises Error if no frame lies within half the spacing of the
        frames, or if theta_c is unknown."""
        degrees = as_angle(angle)
        tilts = np.degrees(self.storage.read("frames/tilt")[: self.frames_of_tilt])
        if not len(tilts):
            raise MissingIndex(f"{self.path}: has no frame yet")
        if degrees is None:
            theta_c = np.degrees(float(self.storage.read("results/theta_c")))
            if np.isnan(theta_c):
                raise MissingIndex(f"{self.path}: the angle of repose is unknown, because the slope has not failed")
            first, end = last_rise(tilts)
            rise = np.abs(tilts[first:end])
            return self.frames[first + max(int(np.searchsorted(rise, theta_c + 1e-7, side="right")) - 1, 0)]
        spacing = float(np.abs(np.diff(tilts)).max()) if len(tilts) > 1 else 1.0
        distance = np.abs(tilts - degrees)
        near = np.flatnonzero(distance <= 0.5 * spacing + 1e-7)
        if not len(near):
            raise MissingIndex(f"{self.path}: no frame at {short(angle)} deg; its {len(tilts)} frames go from {tilts.min():.2f} to "
                        f"{tilts.max():.2f} deg, every {spacing:.3g} deg")
        last = int(near[0])
        while last + 1 < len(tilts) and distance[last + 1] <= distance[last]:
            last += 1
        return self.frames[int(near[0]) + int(np.argmin(distance[near[0] : last + 1]))]

    def read_frame(self, name: str, k: int) -> np.ndarray:
        """Returns the values of a data set for frame k, in the units of the run. Raises Error if the run has no frame k
        or no such data set by frame, or if the values are impossible."""
        name = self._known(name)
        if not is_by_frame(name):
            raise MissingName(f"{self.path}: {name} is not a data set by frame")
        if not self.has_frames:
            raise Error(f"{self.path}: has no frames: it was kept for its analysis alone (--keep analysis); compute it "
                        "again with talus run to get them")
        k = self.frame_index(k)
        values = self.storage.read_frame(name, k)
        check_frame_values(self, name, values)
        return np.asarray(self._converted(name, values))

    def frame_index(self, k: Any) -> int:
        """Returns the index of a frame, counted from 0; negative indices count from the end, as in a list."""
        try:
            if isinstance(k, (bool, np.bool_)):
                raise TypeError
            integer = as_integer(k)
        except TypeError:
            raise WrongType(f"frame {short(k)}: expected an integer, or a slice of them") from None
        if not -len(self.tilt) <= integer < len(self.tilt):
            raise MissingIndex(f"frame {short(integer)}: {self.path} has {len(self.tilt)} frames")
        return integer % len(self.tilt)

    @cached_property
    def observables(self) -> Table:
        """Series of the packing at short intervals of the tilt: "tilt", "sigma_t_over_n", "volume_strain", ..."""
        return self._series("observables")

    @cached_property
    def steps(self) -> Table:
        """Record of the solver for each step: "iterations", "residual", ..."""
        return self._series("steps")

    @property
    def own(self) -> list[str]:
        """Names of the quantities stored by `store`: `frame.grains[name]`, `frame.contacts[name]`, `frame.draw(name)`."""
        return [name.partition("/")[2] for name in self.storage.names("own")]

    def store(self, name: str, values: Iterable[Any], *, label: str | None = None, unit: str = "", overwrite: bool = False) -> None:
        """Stores a quantity of your own with a complete run: `values` has an array for each frame of `frames`, of numbers
        (NaN: none), labels (integers, below 0: none) or flags, one for each free grain, each grain or each contact that
        carries force. The commands that draw and export, the window, and frames taken from then on know it by its name, of
        lower-case letters, digits, _ and -, and maps show its label and unit."""
        from talus.simulation import _extension, _path

        if not self.complete or not self.has_frames:
            raise Error(f"{self.path}: " + ("has no frames to store values with (--keep analysis)" if self.complete else
                        "is not complete; values can be stored once it is"))
        own = stored_quantity(self, name, values, label, unit)
        if name in self.own and not check_flag(overwrite, "overwrite"):
            raise error_of_code(73, f"{self.path}: has values of {name} already; replace them with overwrite=True")
        _extension()._store(_path(self.storage.absolute), own)
        self.storage.close()
        self.storage = Storage(self.storage.absolute)

    def _series(self, group: str) -> Table:
        table = Table(self, group)
        for name in DATA_SETS:
            if self.storage.parts and name.startswith(group + "/") and name.rpartition("/")[2] not in table:
                raise refuse(self.path, name, "is missing")
        return table

    @cached_property
    def analysis(self) -> Table:
        """Results stored by `talus analyze`, with the names of docs/analysis.md: "overloaded/fraction",
        "theta_d/dilation", ... Row k is frame k. Raises Error if there is no analysis, or one of another version."""
        if "version" not in self.storage.names("analysis"):
            raise Error(f"{self.path}: holds no analysis; " + (f"create it with: talus analyze {self.path}" if self.complete
                        else "an analysis is stored only once the run is complete"))
        version = self._values("analysis/version")
        if version != ANALYSIS:
            raise Error(f"{self.path}: its analysis has version {version}, this package reads version {ANALYSIS}; repeat "
                        f"it with: talus analyze {self.path}")
        rows = len(self._values("analysis/packing/volume"))
        if rows != self.frames_of_tilt:
            raise refuse(self.path, "analysis", f"has rows for {rows} frames, the tilt has {self.frames_of_tilt}")
        return Table(self, "analysis")


def as_angle(angle: Any) -> float | None:
    """Returns an angle in degrees; None for "repose"."""
    if isinstance(angle, str) and angle == "repose":
        return None
    try:
        if isinstance(angle, (str, bytes, bool, np.bool_)):
            raise TypeError
        degrees = float(angle)
    except (TypeError, ValueError, OverflowError):
        raise WrongType(f'a frame at {short(angle)}: expected an angle in degrees, or "repose"') from None
    if not np.isfinite(degrees):
        raise WrongValue(f"a frame at {degrees}: expected an angle in degrees")
    return degrees


def as_path(path: Any) -> Path:
    """Returns the path of a file or folder. Raises Error for an invalid path."""
    try:
        if not os.fspath(path) or "\0" in os.fspath(path):
            raise TypeError
        return Path(path)
    except TypeError:
        raise WrongType(f"{short(path)}: expected the path of a file or folder, as a string or a Path") from None


def reopen(path: Path, units: Units, mark: bytes, known: tuple[bytes, Identity] | None) -> Run:
    """Opens a run that was open elsewhere. Raises Error if it is missing, or has changed since."""
    place = find_run(path)
    storage = Storage(place, "" if place.is_file() else manifest_text(place), known)
    if place != path or storage.mark != mark:
        raise Error(f"{path}: has changed since the run was opened; open it again, and pass its path")
    return Run(storage, units)


def open(path: str | Path, units: Units = "SI") -> Run:
    """Opens a run: a file RUN.h5, or its folder RUN.h5.run while it is being computed, which is found under either
    name. Such a run has the state of its last commit; later data are available once it is opened again.

    units: "SI" for lengths in m and angles in rad, as in the file; "D" for mean diameters and degrees.

    Raises Error if there is no run, nothing of it is committed yet, the file is not a run or one of another version, or
    it is damaged. All bytes of a packed file are compared with the hash of its seal, and those of a file in a folder
    with the hash in the manifest, before it is first read. Data must have the type and shape stated in
    docs/file_format.md, and possible values; data in other files are not read."""
    path = as_path(path)
    check_units(units)
    for attempts_left in reversed(range(20)):
        try:
            place = find_run(path)
        except Error:
            raise
        except (OSError, ValueError) as error:
            raise unreadable(short(str(path)), error) from None
        manifest = "" if place.is_file() else manifest_text(place)
        try:
            return Run(Storage(place, manifest), units)
        except Error:
            # Tries again, because the run may continue or be packed while it is read.
            as_before = place.is_file() or manifest_text(place) == manifest != ""
            if as_before or attempts_left == 0:
                raise
    raise AssertionError
