"""Run that a script drives: stepped, steered, measured, drawn, recorded and copied."""

import atexit
import copy
import operator
import os
import sys
import tomllib
from collections.abc import Callable, Mapping
from datetime import date, datetime, time
from typing import Any

import numpy as np

from talus.drawing import Image, draw, map_of
from talus.errors import Closed, MissingPackage, WrongType, WrongValue, check_flag, check_text, short
from talus.frame import named

try:
    from talus import _core
except ImportError as missing:
    _core = None  # type: ignore[assignment]
    _missing = missing
else:
    atexit.register(_core._end_steps)


def _extension() -> Any:
    if _core is None:
        raise MissingPackage("talus.Simulation needs the extension talus._core, which is not built, or not for this Python "
                             f"({_missing}): install the Debian package talus, or build the wheel with ./bootstrap wheel; "
                             "run files can be read without it")
    return _core


def _path(path: Any) -> bytes:
    """Returns the bytes of a path. Raises WrongType for an invalid path."""
    try:
        name = os.fsencode(path)
    except (TypeError, UnicodeError):
        name = b""
    if not name or b"\0" in name:
        raise WrongType(f"{short(path)}: expected the path of a file")
    return name


def _number(value: Any, what: str) -> float:
    """Returns a number. Raises WrongType for other values."""
    try:
        if not isinstance(value, str | bytes):
            return float(value)
    except Exception:  # raised by a user-defined __float__
        pass
    raise WrongType(f"{what} = {short(value)}: expected a number")


def _whole(value: Any, what: str) -> int:
    """Returns a whole number, at most 2^62 in magnitude. Raises WrongType for other values."""
    try:
        return max(-(2**62), min(operator.index(value), 2**62))
    except Exception:
        raise WrongType(f"{what} = {short(value)}: expected a whole number") from None


def _threads(value: Any) -> int:
    """Returns a number of threads. Raises WrongType and WrongValue for other values."""
    threads = _whole(value, "threads")
    if not 1 <= threads <= 256:
        raise WrongValue(f"threads = {short(value)}: expected 1 to 256")
    return threads


def _toml(value: Any, key: str) -> str:
    """Returns a Python value in TOML syntax. Raises WrongType if TOML has no such value."""
    if isinstance(value, np.ndarray) and value.ndim == 0 and not np.ma.is_masked(value):
        value = value.item()
    if isinstance(value, os.PathLike):
        value = os.fsdecode(value)
    if isinstance(value, bool | np.bool_):
        return "true" if value else "false"
    if isinstance(value, int | np.integer):
        return str(int(value))
    if isinstance(value, float | np.floating):
        return repr(float(value))
    if isinstance(value, str):
        escaped = "".join(c if c.isprintable() and c not in '"\\' else f"\\U{ord(c):08x}" for c in value)
        return f'"{escaped}"'
    if isinstance(value, datetime | date | time):
        return value.isoformat()
    if isinstance(value, list | tuple) or isinstance(value, np.ndarray) and value.ndim > 0:
        return "[" + ", ".join(_toml(one, key) for one in value) + "]"
    raise WrongType(f"{key} = {short(value)}: expected a number, a string, a path, True or False, or a list of these")


def _is_list_of_tables(value: Any) -> bool:
    return isinstance(value, list | tuple) and len(value) > 0 and all(isinstance(each, Mapping) for each in value)


def _values(keys: Mapping[str, Any], before: str = "") -> dict[str, str]:
    """Returns keys with their values in TOML, including those of nested tables."""
    found: dict[str, str] = {}
    for key, value in keys.items():
        name = before + check_text(key, "key")
        found |= _values(value, name + ".") if isinstance(value, Mapping) else {name: _toml(value, name)}
    return found


def _tables(keys: Mapping[str, Any]) -> tuple[str, dict[str, Any]]:
    """Returns lists of tables, the commands of a scenario, as TOML; and the other keys."""
    text, others = "", {}
    for key, value in keys.items():
        if not _is_list_of_tables(value):
            others[key] = value
            continue
        for number, table in enumerate(value, 1):
            text += f"[[{_toml(key, key)}]]\n"
            for name, entry in table.items():
                text += f"{_toml(check_text(name, 'key'), key)} = {_toml(entry, f'{key}.{number}.{name}')}\n"
    return text, others


def _settings(*mappings: Mapping[str, Any]) -> list[str]:
    """Returns all keys in the syntax of `--set`; for repeated keys, the last value. Raises WrongType for values that
    TOML cannot represent."""
    values: dict[str, str] = {}
    for keys in mappings:
        try:
            values |= _values(keys)
        except RecursionError:
            raise WrongType(f"{short(keys)}: a list or a table contains itself, or is nested too deeply") from None
    return [f"{key}={value}" for key, value in values.items()]


class Grains(Closed):
    """Grains of a simulation: read-only views of its memory, without a copy. Rows are ids: free grains first, then
    those of the floor. A view follows the steps of its simulation; while a bed is poured, a later view has more rows,
    and rows of the floor move in an earlier view. `grains["gamma"]` is the current value of a quantity of the table in
    docs/export.md, in SI units."""

    __slots__ = ("_core",)

    def __init__(self, simulation: "Simulation") -> None:
        self._core = simulation._core

    def __len__(self) -> int:
        return len(self._core._radius)

    def __repr__(self) -> str:
        return f"<{len(self)} grains, {self.free_count} of them free>"

    def __getitem__(self, name: str) -> np.ndarray:
        return named(self._core._grain_values, name, lambda: self.quantities)

    @property
    def quantities(self) -> list[str]:
        """Names of the quantities of grains: `grains[name]`."""
        return self._core._grain_quantities

    @property
    def free_count(self) -> int:
        """Number of free grains, which come first."""
        return self._core._free_count

    @property
    def free(self) -> np.ndarray:
        """(N,) whether a grain is free, not fixed to the floor."""
        return np.arange(len(self)) < self.free_count

    @property
    def position(self) -> np.ndarray:
        """(N, 2) centres (x, y), m; x in [0, L) of a periodic bed."""
        return self._core._position

    @property
    def velocity(self) -> np.ndarray:
        """(N, 2) velocities (v_x, v_y), m/s."""
        return self._core._velocity

    @property
    def angle(self) -> np.ndarray:
        """(N,) rotation since the start of the run, rad, counter-clockwise positive."""
        return self._core._angle

    @property
    def angular_velocity(self) -> np.ndarray:
        """(N,) angular velocities, rad/s, counter-clockwise positive."""
        return self._core._angular_velocity

    @property
    def radius(self) -> np.ndarray:
        """(N,) radii, m."""
        return self._core._radius

    @property
    def mass(self) -> np.ndarray:
        """(N,) masses, kg/m."""
        return self._core._mass

    @property
    def image(self) -> np.ndarray:
        """(N,) net number of crossings of the periodic edge, right minus left."""
        return self._core._image


class LiveContacts(Closed):
    """Contacts after the last step, including near ones without force: copies, which later steps do not change.
    `contacts["mobilisation"]` is a quantity of the table in docs/export.md for the contacts that carry force, those with
    `contacts.force[:, 0] > 0`."""

    __slots__ = ("_core",)

    def __init__(self, simulation: "Simulation") -> None:
        self._core = simulation._core

    def __len__(self) -> int:
        return len(self._core._gap)

    def __repr__(self) -> str:
        return f"<{len(self)} contacts>"

    def __getitem__(self, name: str) -> np.ndarray:
        return named(self._core._contact_values, name, lambda: self.quantities)

    @property
    def quantities(self) -> list[str]:
        """Names of the quantities of contacts: `contacts[name]`."""
        return self._core._contact_quantities

    @property
    def pair(self) -> np.ndarray:
        """(C, 2) ids a < b of the bodies; b is a plane if it is not below the number of grains."""
        return self._core._pair

    @property
    def normal(self) -> np.ndarray:
        """(C, 2) unit normals, from a to b."""
        return self._core._normal

    @property
    def force(self) -> np.ndarray:
        """(C, 2) forces on b, (f_n, f_t), N/m: along the normal, compression positive, and along (-n_y, n_x). Both are 0
        for a contact that carries no force: less than 1e-9 of the mean weight of a free grain."""
        return self._core._force

    @property
    def gap(self) -> np.ndarray:
        """(C,) gaps, m; negative if bodies overlap."""
        return self._core._gap

    @property
    def shift(self) -> np.ndarray:
        """(C,) periodic image: b touches a from x_b + shift * L."""
        return self._core._shift


class Simulation(Closed):
    """A bed that is stepped by a script, bit-identical to `talus run` with the same scenario and commands.

        sim = talus.Simulation("paper-pbc.toml", seed=7, **{"bed.length": 60})
        sim.deposit()
        while sim["overloaded/fraction"] < 0.5:
            sim.tilt_by(0.25)
        sim.tilt_rate = 0
        sim.run(3.0)

    `scenario` is a file, or a mapping of keys; further keys change it, as with `--set`. SI units; tilts in deg. One thread
    uses a simulation at a time; several simulations can run in parallel threads. Errors are talus.Error, with the exit code
    of the command line as `exit_code`. A derived class may have attributes of its own, which copies share."""

    __slots__ = ("__weakref__", "_core", "_progress")

    def __init__(self, scenario: str | os.PathLike[str] | Mapping[str, Any] | None = None, /, *, threads: int = 1,
                 progress: bool | None = None, **settings: Any) -> None:
        core, threads = _extension(), _threads(threads)
        given: Mapping[str, Any] = scenario if isinstance(scenario, Mapping) else {}
        path = b"" if scenario is None or scenario is given else _path(scenario)
        tables, keys = _tables({**given, **settings})
        self._begin(core.Simulation(path, _settings(keys), tables), progress)
        if threads != 1:
            self._core._use_threads(threads)

    def _begin(self, core: Any, progress: bool | None) -> None:
        self._core = core
        self._progress = progress

    @property
    def grains(self) -> Grains:
        """Views of the grains."""
        return Grains(self)

    @property
    def contacts(self) -> LiveContacts:
        """The contacts."""
        return LiveContacts(self)

    def __repr__(self) -> str:
        return f"<simulation of {len(self.grains)} grains, {self.phase}: tilt {self.tilt:.4g} deg, step {self.step_count}>"

    def __reduce__(self) -> Any:
        raise WrongType("a simulation cannot be pickled; record it, and resume it in the other process")

    # Steps.

    def _tick(self) -> Any:
        """Returns the function that shows progress on a terminal during steps; None if progress is off."""
        if not (sys.stderr.isatty() if self._progress is None else self._progress):
            return None

        def show() -> None:
            print(f"\r{self.phase}: step {self.step_count}, tilt {self.tilt:.3f} deg\x1b[K", end="", file=sys.stderr, flush=True)

        return show

    def _steps(self, method: Any, *goal: Any) -> None:
        tick = self._tick()
        try:
            if not method(*goal, tick):
                raise SystemExit  # the interpreter is ending
        finally:
            if tick is not None:
                print("\r\x1b[K", end="", file=sys.stderr, flush=True)

    def step(self, count: int = 1) -> None:
        """Takes `count` time steps, or fewer if the run ends earlier."""
        self._steps(self._core._step, _whole(count, "step: count"))

    def deposit(self) -> None:
        """Steps until the bed is at rest and its tilt starts."""
        self._steps(self._core._deposit)

    def tilt_to(self, angle: float) -> None:
        """Steps until the tilt passes `angle` (deg) from either side, or the run is over. If the tilt leads away from
        the angle, it is turned first: `tilt_rate` changes its sign, which is a recorded command. A programme
        (tilt.program) is followed. An angle passed by less than one step counts as reached. Raises Error if the tilt
        never gets there: it is held, or its programme does not."""
        self._steps(self._core._tilt_to, _number(angle, "tilt_to: angle"))

    def tilt_by(self, angle: float) -> None:
        """Steps until the tilt has grown by `angle` (deg), or fallen if it is negative, like tilt_to. Starts from the goal
        of the call before, if no step was taken and no rate was set since: the rest of a step is carried over."""
        self._steps(self._core._tilt_by, _number(angle, "tilt_by: angle"))

    def run(self, seconds: float | None = None, *, until: Callable[[], bool] | None = None, every: float | None = None) -> None:
        """Steps for `seconds` of simulated time, or by default to the end of the run, but not beyond the moment at
        which `until()` is true. `until()` is called before the first step and every `every` seconds of simulated time,
        by default after each step. Times are rounded to steps, and the rest is carried over to the next call. Raises
        Error for a time below 0 or below half a step."""
        count = None if seconds is None else self._core._steps_in(_number(seconds, "run: seconds"))
        if until is None:
            self._steps(self._core._finish) if count is None else self._steps(self._core._step, count)
            return
        pause = 0.0 if every is None else _number(every, "run: every") / self._core._time_step
        if not 0 <= pause < np.inf:
            raise WrongValue(f"run: every = {short(every)}: expected 0 s or more")
        due: float = self.step_count
        last = 2**62 if count is None else self.step_count + count
        while not until() and not self.done and self.step_count < last:
            due = max(due + pause, self.step_count + 1)  # at least one step, even if `every` is shorter
            self._steps(self._core._step, min(round(due), last) - self.step_count)

    # Commands.

    def push(self, grain: int | Any, velocity: Any) -> None:
        """Adds (v_x, v_y), m/s, to the velocity of one or several free grains: (2,), or one row for each. Pushes all of
        them, or none if one cannot be pushed."""
        try:
            grains = np.atleast_1d(np.asarray(grain))
        except ValueError:  # rows of different lengths
            grains = np.empty((0, 0))
        if grains.dtype.kind not in "iu" or grains.ndim != 1:
            raise WrongType(f"push({short(grain)}): expected the id of a grain, or a list of ids")
        try:
            values = np.broadcast_to(np.asarray(velocity, dtype=float), (len(grains), 2))
        except (TypeError, ValueError, OverflowError):
            raise WrongValue(f"push: velocity {short(velocity)}: expected (v_x, v_y), or one of these for each grain") from None
        if len(grains) and not -2**31 <= grains.min() <= grains.max() < 2**31:
            raise WrongValue(f"push: there is no grain {grains.max()}")
        self._core._push(grains.tolist(), values.tolist())

    def drop(self, grains: int, x: float, height: float) -> None:
        """Lifts `grains` grains from the free surface and drops them at x (m), from a height (m) above it."""
        self._command(self._core._drop, grains, x, height)

    def drag(self, grain: int, to: Any) -> None:
        """Pulls a grain to a position (x, y), m, with a damped spring, from the next step on."""
        try:
            x, y = to
        except (TypeError, ValueError):
            raise WrongType(f"drag: to = {short(to)}: expected (x, y)") from None
        self._command(self._core._drag, grain, x, y)

    def release(self) -> None:
        """Ends the drag."""
        self._core._release()

    def _command(self, method: Any, *values: Any, name: str = "") -> None:
        """`name`: the attribute that the command sets, in messages."""
        try:
            method(*values)
        except TypeError:
            if name:
                raise WrongType(f"{name} = {short(values[0])}: expected a number") from None
            raise WrongType(f"{method.__name__.strip('_')}{short(values)}: expected numbers") from None

    @property
    def friction(self) -> float:
        """Coefficient of friction between grains; setting it is a command."""
        return self._core._friction

    @friction.setter
    def friction(self, value: float) -> None:
        self._command(self._core._set_friction, value, name="friction")

    @property
    def tilt_rate(self) -> float:
        """Rate of the tilt, deg/s, negative if it falls. Setting it is a command, which also ends a programme; 0 holds
        the tilt."""
        return self._core._tilt_rate

    @tilt_rate.setter
    def tilt_rate(self, value: float) -> None:
        self._command(self._core._set_tilt_rate, value, name="tilt_rate")

    # State.

    @property
    def tilt(self) -> float:
        """Tilt, deg."""
        return self._core.tilt

    @property
    def time(self) -> float:
        """Simulated time, s."""
        return self._core.time

    @property
    def step_count(self) -> int:
        """Number of time steps since the start."""
        return self._core.step_count

    @property
    def phase(self) -> str:
        """"deposition", "tilt", "flow" or "done"."""
        return self._core.phase

    @property
    def done(self) -> bool:
        """Whether the run is over."""
        return self._core.done

    @property
    def residual(self) -> float | None:
        """Residual eta of the last step (docs/solver.md); None before the first step."""
        return self._core.residual

    @property
    def converged(self) -> bool | None:
        """Whether the last step reached its tolerance; None before the first step."""
        return self._core.converged

    @property
    def state_hash(self) -> str:
        """Hash of the complete state on which later steps depend, to the last bit."""
        return self._core.state_hash

    @property
    def theta_c(self) -> float | None:
        """Angle of repose, deg; None while the slope has not failed."""
        return self._core.theta_c

    @property
    def D(self) -> float:
        """Mean diameter of the free grains, m."""
        return self._core.D

    @property
    def length(self) -> float:
        """Length L, the period or the distance between the walls, m."""
        return self._core.length

    @property
    def periodic(self) -> bool:
        """Whether x has the period L; otherwise the bed lies between walls."""
        return self._core.periodic

    @property
    def gravity(self) -> float:
        """Gravity g, m/s^2."""
        return self._core.gravity

    @property
    def scenario(self) -> dict[str, Any]:
        """The scenario with every key, in the units of the scenario, as `Run.scenario`."""
        return tomllib.loads(self.scenario_text)

    @property
    def scenario_text(self) -> str:
        """The scenario with every key, as TOML."""
        return self._core.scenario

    # Measures.

    @property
    def surface_velocity(self) -> float:
        """Mean velocity along x of the surface layer, the free grains above the depth of 3 D below the mean free surface,
        m/s: by it a slope is said to flow."""
        return self._core._surface_velocity

    def surface_height(self, x: float | None = None, width: float | None = None) -> float:
        """Mean height of the free surface above y = 0 over a width around x, m; by default over the whole bed, from its
        middle. A periodic bed continues at its ends."""
        return self._core._surface_height(0.5 * self.length if x is None else _number(x, "surface_height: x"),
                                          self.length if width is None else _number(width, "surface_height: width"))

    def __getitem__(self, name: str) -> float:
        """Returns a scalar of the current state: a quantity of a frame (docs/analysis.md), "overloaded/fraction", or at
        the second threshold "overloaded/fraction[1]"; or an observable (docs/file_format.md), "kinetic_energy". SI
        units, but "tilt" in degrees."""
        return named(self._core._quantity, name, lambda: self.quantities)

    @property
    def quantities(self) -> list[str]:
        """Names of the scalars of the state: `sim[name]`."""
        return self._core._quantities

    def analyse_with(self, **parameters: Any) -> None:
        """Sets parameters of the analysis, as with `talus analyze --set`: l_min=0, gamma_c=0.3."""
        self._core._set_analysis(_settings(parameters))

    def draw(self, map: Any = "gamma", *, width: int = 900, label: str | None = None, unit: str = "", **options: Any) -> Image:
        """Draws a map of the state, like `talus render --map`, `width` px wide, with the options theta_c (degrees), l_min,
        length, threshold, range, colours, turned and bare. Instead of a name, `map` can be values of your own: an array
        with a number (NaN: none), a label (integer, below 0: none) or True or False for each free grain, each grain or
        each contact that carries force, with a label and a unit for the legend."""
        return draw(self._core, map, width, label, unit, options)

    def map(self, map: Any = "gamma", *, label: str | None = None, unit: str = "", **options: Any) -> Any:
        """Returns this map as it is now, for talus.panel and talus.animate."""
        return map_of(self._core, map, label, unit, options)

    def _repr_png_(self) -> bytes:
        return self.draw()._repr_png_()

    # Recording and copies.

    def record(self, path: str | os.PathLike[str], *, overwrite: bool = False) -> None:
        """Records the run from now on, for `talus replay`: as an ordinary run before the first step, and later as a
        branch that starts from the current state."""
        self._core._record(_path(path), check_flag(overwrite, "overwrite"))

    def save(self, path: str | os.PathLike[str], *, overwrite: bool = False) -> None:
        """Writes the current state as a separate run, which resume continues."""
        self._core._save(_path(path), check_flag(overwrite, "overwrite"))

    @property
    def recorded(self) -> bool:
        """Whether the simulation is being recorded."""
        return self._core.recorded

    def commit(self) -> None:
        """Commits all recorded data to disk, as happens at each frame and at the end."""
        self._core.commit()

    def copy(self) -> "Simulation":
        """Returns an independent simulation of the same class with the same state, which is not recorded."""
        other = object.__new__(type(self))
        other._begin(self._core._copy(), self._progress)
        if hasattr(self, "__dict__"):
            vars(other).update(vars(self))
        return other

    __copy__ = copy

    def __deepcopy__(self, memo: Any) -> "Simulation":
        other = memo[id(self)] = self.copy()
        if hasattr(self, "__dict__"):
            vars(other).update(copy.deepcopy(vars(self), memo))
        return other


def resume(path: str | os.PathLike[str], *, threads: int = 1, progress: bool | None = None) -> Simulation:
    """Resumes a recorded run that was stopped, from its last commit, as a Simulation that continues in the same file."""
    threads, simulation = _threads(threads), object.__new__(Simulation)
    simulation._begin(_extension().Simulation._resume(_path(path)), progress)
    if threads != 1:
        simulation._core._use_threads(threads)
    return simulation
