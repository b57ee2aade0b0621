"""Values at characteristic frames before failure, named as in `members.csv`: "overloaded/fraction@theta_c"."""

import numpy as np

from talus.run import Run, last_rise
from talus.table import numbered

#: Places of each quantity; the same table is in src/analysis/failure/transition.cpp.
PLACES = {
    "packing/solid_fraction": ("0", "theta_c"),
    "contacts/coordination_number": ("0", "theta_d", "theta_c"),
    "packing/stress_ratio": ("0", "theta_d", "theta_c"),
    "packing/volume_strain": ("theta_d", "theta_c"),
    "packing/centre_of_mass_strain": ("theta_d", "theta_c"),
    "overloaded/fraction": ("0", "theta_d", "percolation", "theta_c"),
    "overloaded/fraction_of_all": ("0", "theta_d", "percolation", "theta_c"),
    "lc/mean": ("0", "theta_d", "theta_c"),
    "lc/max": ("0", "before_theta_d", "theta_d", "theta_c"),
}
#: Scalar of the run, or of each threshold, that gives the tilt of a place.
TILTS = {"theta_c": "theta_c", "theta_d": "theta_d/lc_jump", "before_theta_d": "theta_d/lc_jump",
         "percolation": "theta_d/percolation"}
SAME_TILT = 1e-9


def numbers_at_places(run: Run) -> dict[str, tuple[float, str]]:
    """Returns values and units for an analysed run; NaN if it does not reach the place."""
    tilts = run.storage.read("frames/tilt")[: run.frames_of_tilt]
    first, end = last_rise(tilts)
    rise = np.abs(tilts[first:end])
    found: dict[str, tuple[float, str]] = {}
    if not len(tilts):
        return found
    for name, places in PLACES.items():
        if name not in run.analysis:  # a slope that has not failed has no thresholds
            continue
        columns = np.reshape(run.analysis[name], (len(tilts), -1)).T
        for place in places:
            for f, column in enumerate(columns):
                k = _frame_at(run, rise, place, f)
                value = float(column[first + k]) if k >= 0 else np.nan
                found[numbered(f"{name}@{place}", f)] = value, run.analysis.unit(name)
    return found


def _frame_at(run: Run, rise: np.ndarray, place: str, f: int) -> int:
    """Returns the last frame of a rise up to the tilt of a place, the first of several at the same tilt; -1: none."""
    if place == "0":
        return 0 if len(rise) else -1
    if not run.storage.has("analysis/" + TILTS[place]):
        return -1
    tilts = np.atleast_1d(run.storage.read("analysis/" + TILTS[place]))
    tilt = tilts[min(f, len(tilts) - 1)] if len(tilts) else np.nan
    if np.isnan(tilt):
        return -1
    k = frame_not_after(rise, tilt)
    return k - (place == "before_theta_d") if k >= 0 else -1


def frame_not_after(tilts: np.ndarray, tilt: float) -> int:
    """Returns the last of the ascending tilts that is not above `tilt`, the first of several equal ones; -1: none. The
    tolerance suits deg and rad, because tilts are multiples of a step up to rounding."""
    last = int(np.searchsorted(tilts, tilt + SAME_TILT, side="right")) - 1
    return int(np.searchsorted(tilts, tilts[last] - SAME_TILT)) if last >= 0 else -1
