"""Checks of the values of a run, as in the program, so that nothing computed from them exceeds its arrays."""

from typing import TYPE_CHECKING

import numpy as np

from talus.errors import Error

if TYPE_CHECKING:
    from talus.run import Run

#: Series without missing values.
ALWAYS_FINITE = {f"{table}/{name}" for table in ("frames", "observables", "steps") for name in ("time", "tilt", "phase", "step")}


def refuse(place: object, name: str, problem: str) -> Error:
    return Error(f"{place}: data set /{name} {problem}; restore it from a copy, or compute the run again")


def check_between(place: object, name: str, values: np.ndarray, low: float, high: float = np.inf) -> None:
    values = np.asarray(values)
    if not np.all(np.isfinite(values) & (values >= low) & (values <= high)):
        wanted = f"finite numbers >= {low:.6g}" if high == np.inf else f"numbers from {low:.6g} to {high:.6g}"
        raise refuse(place, name, f"holds values other than {wanted}")


def check_statics(place: object, d: float, edges: np.ndarray, radius: np.ndarray, mass: np.ndarray,
                  species: np.ndarray) -> None:
    """Checks that lengths are consistent with one bed, and that free grains precede those of the floor; d, edges and
    radius in m."""
    grains = "particles/grains/"
    check_between(place, "parameters/mean_diameter", np.array(d), 1e-9, 1e9)
    check_between(place, grains + "box/edges", edges, 0.1 * d, 1e6 * d)
    check_between(place, grains + "radius", radius, 1e-3 * d, 1e3 * d)
    check_between(place, grains + "mass", mass, 0)
    check_between(place, grains + "species", species, 0, 1)
    if not len(species) or species[0] != 0 or np.any(np.diff(species) < 0):
        raise refuse(place, grains + "species", "has no free grain, or one after a grain of the floor")


def check_series(place: object, name: str, values: np.ndarray) -> None:
    if name in ALWAYS_FINITE and not np.all(np.isfinite(values)):
        raise refuse(place, name, "holds a value that is not a finite number")


def check_frame_values(run: "Run", name: str, values: np.ndarray) -> None:
    """Checks the `values` of one frame, in the units of the file."""
    if values.dtype.kind == "f" and not name.endswith("gamma/value") and not np.all(np.isfinite(values)):
        raise refuse(run.path, name, "holds a value that is not a finite number")
    if name in ("particles/grains/position/value", "contacts/point") and np.any(np.abs(values) > run.farthest):
        raise refuse(run.path, name, "holds a position farther away than a grain can be")
    if name == "particles/grains/image/value" and np.any(values[:, 1]):
        raise refuse(run.path, name, "holds a periodic image across the depth of the bed, which is not periodic")
    if name == "contacts/status" and np.any((values < 0) | (values > 2)):
        raise refuse(run.path, name, "holds a value other than 0, 1 and 2")
    if name == "contacts/shift" and np.any((values < -100) | (values > 100)):
        raise refuse(run.path, name, "holds a value beyond -100 to 100")
    if name == "contacts/pair":
        a, b, grains = *values.T, len(run.id)
        if np.any((a < 0) | (a >= grains) | (b <= a) | (b >= grains + run.planes)):
            raise refuse(run.path, name, f"joins bodies other than a < b < {grains + run.planes} with a grain a")
