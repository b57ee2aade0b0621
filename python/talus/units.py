"""Units of values: those of the file, or those of the tables that Talus prints."""

from typing import Any, Literal

import numpy as np

from talus.errors import WrongValue, short

#: "SI": as in the file, lengths in m and angles in rad. "D": lengths in mean diameters and angles in degrees, as in
#: scenarios and in the tables of Talus. All other units (m^2, m/s, Pa, N/m, J/m, 1/rad) are the same in both.
Units = Literal["SI", "D"]


def check_units(units: str) -> None:
    """Raises WrongValue if `units` is neither "SI" nor "D"."""
    if not isinstance(units, str) or units not in ("SI", "D"):
        raise WrongValue(f'units={short(units)}: expected "SI" (m, rad) or "D" (mean diameters, deg)')


def rounded_degrees(radians: Any) -> Any:
    """Returns angles in degrees without the rounding errors of sums of steps: multiples of 1e-9, never -0."""
    return np.round(np.degrees(radians), 9) + 0.0


def unit_in(units: Units, unit: str) -> str:
    """Returns the unit of values stored in `unit`: "D" and "deg" for "m" and "rad" if `units` is "D"."""
    return unit if units == "SI" else {"m": "D", "rad": "deg"}.get(unit, unit)


def values_in(units: Units, unit: str, values: Any, mean_diameter: float) -> Any:
    """Returns converted values, stored in `unit`; `mean_diameter` in m."""
    if units == "SI" or unit not in ("m", "rad"):
        return values
    if isinstance(values, np.ndarray):
        # The quotient of floats in single precision may round up to L.
        values = values.astype(np.float64, copy=False)
    if unit == "m":
        return values / mean_diameter
    return np.degrees(values)
