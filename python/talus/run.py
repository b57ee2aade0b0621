"""A run, read from its packed file or from the folder in which it is being computed."""

import tomllib
from collections.abc import Sequence
from functools import cached_property
from pathlib import Path
from typing import Any, Literal

import numpy as np

from talus.errors import Error
from talus.frame import Frame
from talus.storage import Storage, find_run, manifest_text
from talus.table import Table
from talus.units import Units, check_units, unit_in, values_in
from talus.version import ANALYSIS, SCHEMA


def last_rise(tilts: np.ndarray) -> tuple[int, int]:
    """First place and the place after the last of the last part of tilts whose magnitude rises and does not fall; all of
    what never rises."""
    change = np.diff(np.abs(tilts))
    rises = np.flatnonzero(change > 0)
    if not len(rises):
        return 0, len(tilts)
    falls = np.flatnonzero(change < 0)
    before, after = falls[falls < rises[-1]], falls[falls > rises[-1]]
    return (int(before[-1]) + 1 if len(before) else 0), (int(after[0]) + 1 if len(after) else len(tilts))


class Frames(Sequence[Frame]):
    """All frames of a run in their order: `run.frames[3]`, `run.frames[-1]`, `len(run.frames)`, `for frame in ...`."""

    def __init__(self, run: "Run") -> None:
        self._run = run

    def __len__(self) -> int:
        return len(self._run.tilt)

    def __getitem__(self, k: Any) -> Any:
        if isinstance(k, slice):
            return [self[i] for i in range(*k.indices(len(self)))]
        if not -len(self) <= k < len(self):
            raise IndexError(f"frame {k}: {self._run.path} has {len(self)} frames")
        return Frame(self._run, int(k) % len(self))


class Run:
    """A run. Arrays are those of the file (docs/file_format.md), floats as float64; lengths and angles are in the units
    in which it was opened, all else is SI, per metre of thickness.

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
        self.complete = storage.complete  #: False: it is being computed, or was stopped
        schema = storage.read("parameters/schema_version")
        if schema != SCHEMA:
            raise Error(f"{self.path}: has schema version {schema}, this package reads version {SCHEMA}: use the "
                        "package of the Talus that wrote it, or compute the run again")
        self.D = float(storage.read("parameters/mean_diameter"))  #: mean diameter of the free grains, always in m
        self.gravity = float(storage.read("parameters/gravity"))  #: m/s^2
        self.friction = float(storage.read("parameters/friction"))  #: coefficient of friction between grains, mu
        self.periodic = bool(storage.read("parameters/periodic"))
        self.length: float  #: L, the period, or the distance between the walls
        self.depth: float  #: H, nominal
        self.length, self.depth = map(float, self["particles/grains/box/edges"])
        self.id: np.ndarray = self["particles/grains/id"]  #: (N,) index of a grain in every array
        self.radius: np.ndarray = self["particles/grains/radius"]  #: (N,)
        self.mass: np.ndarray = self["particles/grains/mass"]  #: (N,) kg/m
        self.free: np.ndarray = self["particles/grains/species"] == 0  #: (N,) False: glued to the floor
        self.step: np.ndarray = self["frames/step"]  #: (frames,) steps since the beginning
        self.time: np.ndarray = self["frames/time"]  #: (frames,) s
        self.tilt: np.ndarray = self["frames/tilt"]  #: (frames,) angle of the bed to the horizontal
        #: What the run found: theta_c (NaN if the slope has not failed), theta_r, residual_max, ...
        self.results: dict[str, float] = {name: self["results/" + name] for name in storage.names("results")}

    def __enter__(self) -> "Run":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        rest = "" if self.complete else ", not complete"
        return f"<run {self.path}: {len(self.id)} grains, {len(self.tilt)} frames{rest}>"

    def close(self) -> None:
        """Closes the file. What is asked for later opens it again."""
        self.storage.close()

    def __getitem__(self, name: str) -> Any:
        """All values of any data set of the file, in the units of the run: `run["steps/iterations"]`. An array, a
        number or a text. Throws Error where there is none of this name."""
        name = name.strip("/")
        return self._converted(name, self.storage.read(name))

    def _converted(self, name: str, values: Any) -> Any:
        if isinstance(values, np.ndarray) and values.dtype.kind == "f":
            values = values.astype(np.float64)
        values = values_in(self.units, self.storage.attribute(name, "unit"), values, self.D)
        return values.item() if isinstance(values, np.generic) else values

    def unit(self, name: str) -> str:
        """The unit in which `run[name]` is given; "1": a number."""
        self.storage.check(name.strip("/"))
        return unit_in(self.units, self.storage.attribute(name.strip("/"), "unit"))

    def meaning(self, name: str) -> str:
        """What a data set is, a sentence; empty where the file does not say (a folder, /results)."""
        name = name.strip("/")
        self.storage.check(name)
        return self.storage.attribute(name, "definition") or self.storage.help(name)

    @property
    def theta_c(self) -> float:
        """Angle of repose, the tilt at which the slope failed; NaN if it has not."""
        return self.results["theta_c"]

    @cached_property
    def scenario(self) -> dict[str, Any]:
        """The scenario with every key, in its own units (docs/scenario.md): `run.scenario["tilt"]["rate"]`."""
        return tomllib.loads(self["parameters/scenario_resolved"])

    @cached_property
    def provenance(self) -> dict[str, Any]:
        """How the run was made: seed, version, git_hash, command, ..."""
        names = [name for name in self.storage.names("provenance") if not name.startswith("timing/")]
        return {name: self["provenance/" + name] for name in names}

    @property
    def seed(self) -> int:
        return self["provenance/seed"]

    @property
    def frames(self) -> Frames:
        """All frames, those of the flow after failure included."""
        return Frames(self)

    @cached_property
    def frames_of_tilt(self) -> int:
        """How many frames there are up to the first highest tilt, with a programme of the tilt (tilt.program) up to its
        last step. The analysis has these; those after it are frames of the flow that follows failure
        (tilt.after_failure)."""
        if not len(self.tilt):
            return 0
        if (last := self._last_tilt_step) is not None:
            return int(np.searchsorted(self.storage.read("frames/step"), last, side="right"))
        return int(np.argmax(self.tilt)) + 1

    @cached_property
    def _last_tilt_step(self) -> int | None:
        """Steps taken when the tilt ended; None for a run without a programme."""
        return int(self.storage.read("checkpoint/integers/last_tilt_step")) if self.has_program else None

    @cached_property
    def has_program(self) -> bool:
        """Whether the tilt follows a programme: then it may fall, be held, and change its sign."""
        return "last_tilt_step" in self.storage.names("checkpoint/integers")

    def frame_at(self, angle: float | Literal["repose"]) -> Frame:
        """The frame of the tilt nearest to an angle in degrees, or with "repose" the last one with a tilt up to theta_c,
        as `--at` of `talus render` has it: where the tilt goes up and down, the first frame that reaches the angle, and
        "repose" in the last rise. Throws Error where no frame lies within half the spacing of the frames, or
        theta_c is not known."""
        tilts = np.degrees(self.storage.read("frames/tilt")[: self.frames_of_tilt])
        if not len(tilts):
            raise Error(f"{self.path}: has no frame yet")
        if angle == "repose":
            theta_c = np.degrees(float(self.storage.read("results/theta_c")))
            if np.isnan(theta_c):
                raise Error(f"{self.path}: the angle of repose is not known, as the slope has not failed")
            first, end = last_rise(tilts)
            rise = np.abs(tilts[first:end])
            return self.frames[first + max(int(np.searchsorted(rise, theta_c + 1e-7, side="right")) - 1, 0)]
        spacing = float(np.abs(np.diff(tilts)).max()) if len(tilts) > 1 else 1.0
        distance = np.abs(tilts - float(angle))
        near = np.flatnonzero(distance <= 0.5 * spacing + 1e-7)
        if not len(near):
            raise Error(f"{self.path}: no frame at {angle} deg; its {len(tilts)} frames go from {tilts.min():.2f} to "
                        f"{tilts.max():.2f} deg, every {spacing:.3g} deg")
        last = int(near[0])
        while last + 1 < len(tilts) and distance[last + 1] <= distance[last]:
            last += 1
        return self.frames[int(near[0]) + int(np.argmin(distance[near[0] : last + 1]))]

    def read_frame(self, name: str, k: int) -> np.ndarray:
        """What a data set by frame holds of frame k, 0 <= k < len(frames), in the units of the run."""
        return np.asarray(self._converted(name, self.storage.read_frame(name, k)))

    @cached_property
    def observables(self) -> Table:
        """Series of the packing in short intervals of the tilt: "tilt", "sigma_t_over_n", "volume_strain", ..."""
        return Table(self, "observables")

    @cached_property
    def steps(self) -> Table:
        """What the solver did in each step: "iterations", "residual", ..."""
        return Table(self, "steps")

    @cached_property
    def analysis(self) -> Table:
        """What `talus analyze` has stored, by the names of docs/analysis.md: "overloaded/fraction", "theta_d/dilation",
        ... Row k is frame k. Throws Error where there is no analysis, or one of another version."""
        if "version" not in self.storage.names("analysis"):
            raise Error(f"{self.path}: holds no analysis; " + (f"make it: talus analyze {self.path}" if self.complete
                        else "the run is not complete, and its analysis is stored once it is"))
        version = self["analysis/version"]
        if version != ANALYSIS:
            raise Error(f"{self.path}: its analysis has version {version}, this package reads version {ANALYSIS}; make "
                        f"it again: talus analyze {self.path}")
        return Table(self, "analysis")


def open(path: str | Path, units: Units = "SI") -> Run:
    """Opens a run: a file RUN.h5, or its folder RUN.h5.run while it is being computed, which is found under either
    name. Such a run is the one of its last commit: what comes later is there when it is opened again.

    units: "SI" gives lengths in m and angles in rad, as in the file; "D" in mean diameters and in degrees.

    Throws Error where there is no run, nothing of it is committed yet, it is no run or one of another version, or it is
    damaged. A changed byte is found by `talus check`; here it is noticed where HDF5 cannot read on."""
    for attempts_left in reversed(range(20)):
        place = find_run(Path(path))
        manifest = manifest_text(place)
        try:
            return Run(Storage(place, manifest), units)
        except Error:
            # While it is read the run may go on, or be packed: then look again.
            as_before = place.is_file() or manifest_text(place) == manifest != ""
            if as_before or attempts_left == 0:
                raise
    raise AssertionError
