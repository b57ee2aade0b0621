"""Frame of a run: its grains and its contacts."""

from collections.abc import Callable
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from talus.contacts import Contacts
from talus.drawing import Image, draw, map_of
from talus.errors import Closed, MissingAttribute, MissingName, WrongValue, check_text, suggestion
from talus.optional import need

if TYPE_CHECKING:
    from talus.run import Run


FRAME_ARRAYS = ("position", "velocity", "angle", "angular_velocity", "radius", "free")


def named(measure: Any, name: Any, known: Callable[[], list[str]]) -> Any:
    """Returns measure(name). Raises MissingName if `name` is not one of the `known` names."""
    try:
        return measure(check_text(name, "quantity"))
    except WrongValue as error:
        if name in known():
            raise
        text = str(error)
        raise MissingName(text if "did you mean" in text else f"{text}; `quantities` lists the names") from None


class FrameGrains(Closed):
    """Grains of a frame, with the same names as those of a Simulation."""

    def __init__(self, frame: "Frame") -> None:
        self._frame = frame
        self._is_closed = True

    def __len__(self) -> int:
        return len(self._frame.radius)

    def __getitem__(self, name: str) -> np.ndarray:
        measured = self._frame._measured
        return named(measured._grain_values, name, lambda: measured._grain_quantities)

    @property
    def quantities(self) -> list[str]:
        """Names of the quantities of grains: `grains[name]`."""
        return self._frame._measured._grain_quantities

    @property
    def free_count(self) -> int:
        """Number of free grains, which come first."""
        return int(self._frame.free.sum())

    def __getattr__(self, name: str) -> Any:
        if name in FRAME_ARRAYS:
            return getattr(self._frame, name)
        if name == "mass":
            return self._frame.run.mass
        known = [each for each in dir(self) if not each.startswith("_")] + [*FRAME_ARRAYS, "mass"]
        raise MissingAttribute(f"grains have no attribute {name!r}{suggestion(name, known)}")


class Frame(Closed):
    """Grains of a run at one tilt, as arrays of N rows, free grains first and grains of the floor after them, in the
    frame of the bed: x along it, downslope when the tilt is positive, y away from the floor. Data are read on access
    and kept. Lengths and angles are in the units of the run, the tilt in degrees; everything else is in SI units, per
    metre of thickness."""

    def __init__(self, run: "Run", index: int) -> None:
        self.run = run
        self.index = index = run.frame_index(index)  #: counted from 0
        self.step = int(run.step[index])  #: steps since the start of the run
        self.time = float(run.time[index])  #: s
        self.tilt = float(run.tilt[index])  #: angle of the bed to the horizontal, deg
        self._is_closed = True

    def __repr__(self) -> str:
        return f"<frame {self.index} of {self.run.path}: tilt {self.tilt:.4g} deg>"

    def __reduce__(self) -> Any:
        return Frame, (self.run, self.index)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Frame) and (self.index, self.run.path) == (other.index, other.run.path)

    def __hash__(self) -> int:
        return hash((self.index, self.run.path))

    # Measurements of the extension, with the same names as those of a Simulation; SI units.

    @cached_property
    def _measured(self) -> Any:
        return self._measure([])

    def _measure(self, settings: list[str]) -> Any:
        from talus.simulation import _extension, _path

        return _extension().MeasuredFrame(_path(self.run.storage.absolute), self.index, settings)

    def __getitem__(self, name: str) -> float:
        """Returns a scalar of the frame: a quantity of docs/analysis.md, "overloaded/fraction", or an observable; "tilt"
        in degrees."""
        return named(self._measured._quantity, name, lambda: self.quantities)

    @property
    def quantities(self) -> list[str]:
        """Names of the scalars of the frame: `frame[name]`."""
        return self._measured._quantities

    def analyse_with(self, **parameters: Any) -> None:
        """Sets parameters of the analysis for measurements of this frame, like Simulation.analyse_with."""
        from talus.simulation import _settings

        self.__dict__["_measured"] = self._measure(_settings(parameters))

    @property
    def grains(self) -> "FrameGrains":
        """The grains: `frame.grains["gamma"]`, a quantity of docs/export.md, `frame.grains.position`, ..."""
        return FrameGrains(self)

    def draw(self, map: Any = "gamma", *, width: int = 900, label: str | None = None, unit: str = "", **options: Any) -> Image:
        """Draws a map of the frame, like Simulation.draw."""
        return draw(self._measured, map, width, label, unit, options)

    def map(self, map: Any = "gamma", *, label: str | None = None, unit: str = "", **options: Any) -> Any:
        """Returns this map for talus.panel and talus.animate."""
        return map_of(self._measured, map, label, unit, options)

    def _repr_png_(self) -> bytes:
        return self.draw()._repr_png_()

    def _read(self, name: str) -> np.ndarray:
        return self.run.read_frame(f"particles/grains/{name}/value", self.index)

    @cached_property
    def position(self) -> np.ndarray:
        """(N, 2) centres (x, y); x in [0, L) of a periodic bed."""
        return self._read("position")

    @cached_property
    def image(self) -> np.ndarray:
        """(N, 2) net number of crossings of the periodic edge, right minus left, and 0."""
        return self._read("image")

    @property
    def unwrapped(self) -> np.ndarray:
        """(N, 2) centres without periodic wrapping: differences of two frames are displacements."""
        return self.position + self.image * np.array([self.run.length, self.run.depth])

    @cached_property
    def angle(self) -> np.ndarray:
        """(N,) rotation since the start of the run, counter-clockwise positive."""
        return self._read("angle")

    @cached_property
    def velocity(self) -> np.ndarray:
        """(N, 2) velocities (v_x, v_y), m/s."""
        return self._read("velocity")

    @cached_property
    def angular_velocity(self) -> np.ndarray:
        """(N,) angular velocities, rad/s, counter-clockwise positive."""
        return self._read("angular_velocity")

    @cached_property
    def internal_moment(self) -> np.ndarray:
        """(N, 2, 2) internal moments M_ij, J/m, lever arm first, force second; compression positive. The stress of
        grains is the sum of their M divided by an area. x and y are those of the bed, with y away from the floor, so
        the paper's shear has the opposite sign."""
        moment = self._read("internal_moment")
        moment[self._unloaded & (np.trace(moment, axis1=1, axis2=2) > 0)] = 0
        return moment

    @cached_property
    def gamma(self) -> np.ndarray:
        """(N,) stress ratio q/p of each grain alone (l_min = 0); NaN if it carries no load. The gamma of an analysis is
        that of neighbourhoods: talus.stress_ratio of sums of internal moments."""
        return np.where(self._unloaded, np.nan, self._read("gamma"))

    @property
    def friction(self) -> float:
        """Coefficient of friction between grains in the step that gave the forces of the frame; `run.friction` is that
        of the scenario, which a command may have changed since."""
        return self.run.friction_of(self.index)

    @property
    def radius(self) -> np.ndarray:
        """(N,) radii."""
        return self.run.radius

    @property
    def free(self) -> np.ndarray:
        """(N,) whether a grain is free, not fixed to the floor."""
        return self.run.free

    @cached_property
    def _carries(self) -> np.ndarray:
        """(K,) whether each contact in the file carries force. Files of earlier versions have others too."""
        return self.run.read_frame("contacts/force", self.index)[:, 0] >= self.run.force_threshold

    @cached_property
    def _unloaded(self) -> np.ndarray:
        """(N,) grains whose contacts in the file carry no force; False everywhere if all contacts of the frame do."""
        if self._carries.all():
            return np.zeros(len(self.radius), bool)
        return np.isin(np.arange(len(self.radius)), self.contacts.pair, invert=True)

    @cached_property
    def contacts(self) -> Contacts:
        """The contacts that carry force: at least 1e-9 of the mean weight of a free grain."""
        names = ["pair", "shift", "normal", "point", "force", "status"]
        if len(self._carries) and self.run.resists_rolling:
            names.append("moment")
        read = {name: self.run.read_frame(f"contacts/{name}", self.index)[self._carries] for name in names}
        a, b = read["pair"].T
        between_grains = b < len(self.position)
        end = read["point"].copy()
        end[between_grains] = self.position[b[between_grains]]
        end[between_grains, 0] += read["shift"][between_grains] * self.run.length
        return Contacts(**read, start=self.position[a], end=end, between_grains=between_grains,
                        period=self.run.length if self.run.periodic else 0.0, frame=self)

    def to_pandas(self) -> Any:
        """Returns a DataFrame with one row for each grain, indexed by id: free, x, y, radius, mass, angle, v_x, v_y,
        angular_velocity, gamma, and the internal moment as M_xx, M_xy, M_yx, M_yy. Raises ImportError without pandas."""
        moment = {f"M_{i}{j}": self.internal_moment[:, m, n] for m, i in enumerate("xy") for n, j in enumerate("xy")}
        columns = {"free": self.free, "x": self.position[:, 0], "y": self.position[:, 1], "radius": self.radius,
                   "mass": self.run.mass, "angle": self.angle, "v_x": self.velocity[:, 0], "v_y": self.velocity[:, 1],
                   "angular_velocity": self.angular_velocity, "gamma": self.gamma, **moment}
        pandas = need("pandas", "to_pandas()")
        return pandas.DataFrame(columns, index=pandas.Index(self.run.id, name="id"))

    def to_lammps(self, folder: Any, *, k_n: float = 1e5, k_t: float | None = None, forces: bool = True,
                  overwrite: bool = False) -> None:
        """Writes slope.data and in.slope to a folder: the bed at rest as LAMMPS continues it, with soft contacts of the
        stiffnesses k_n and k_t (k_n / 2) in m g/D, m the mass of a disk of diameter D. Overlaps and tangential springs
        give the contact forces of the frame; without `forces` grains keep their positions, and gravity grows from 0. Existing
        files are kept, and the call fails, unless `overwrite` is true."""
        from talus.lammps import write

        write(self, folder, k_n, k_t, forces, overwrite)

    def to_networkx(self) -> Any:
        """Returns the contact network as a networkx.MultiGraph (two grains of a short periodic bed can touch twice), with
        the `tilt` of the frame. Nodes are ids, with `kind` ("free", "floor", "plane"), and `x`, `y`, `radius`, `gamma` of grains; edges are
        contacts, with their row in `contacts` as `contact`, and `f_n`, `f_t` (N/m), `sliding` and `shift`. Raises
        ImportError without networkx."""
        graph = need("networkx", "to_networkx()").MultiGraph(tilt=self.tilt)  # deg
        for i in range(len(self.position)):
            x, y = self.position[i].tolist()
            graph.add_node(i, kind="free" if self.free[i] else "floor", x=x, y=y, radius=float(self.radius[i]),
                           gamma=float(self.gamma[i]))
        contacts = self.contacts
        for c, (a, b) in enumerate(contacts.pair.tolist()):
            if not contacts.between_grains[c]:
                graph.add_node(b, kind="plane")
            f_n, f_t = contacts.force[c].tolist()
            graph.add_edge(a, b, contact=c, f_n=f_n, f_t=f_t, sliding=bool(contacts.status[c] == 2),
                           shift=int(contacts.shift[c]))
        return graph
