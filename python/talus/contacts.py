"""Contacts of a frame, with their end points."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from talus.optional import need


@dataclass(frozen=True)
class Contacts:
    """Force-carrying contacts of a frame, as arrays of K rows in the order of the file. Lengths are in the units of the
    run; forces in N/m, per metre of thickness."""

    pair: np.ndarray  #: (K, 2) ids (a, b) of the bodies, a < b; b = N + k is plane k of the boundary (floor, walls)
    shift: np.ndarray  #: (K,) periodic image: b touches a from x_b + shift L
    normal: np.ndarray  #: (K, 2) unit normal n, from a to b
    point: np.ndarray  #: (K, 2) contact point, in the image of a
    force: np.ndarray  #: (K, 2) force (f_n, f_t) on b along n and t = (-n_y, n_x); f_n > 0 is compression
    status: np.ndarray  #: (K,) 0 open, 1 sticking, 2 sliding: friction fully mobilised
    start: np.ndarray  #: (K, 2) centre of a
    end: np.ndarray  #: (K, 2) centre of b in the image that touches a, possibly outside [0, L); for a plane: point
    between_grains: np.ndarray  #: (K,) whether b is a grain (of the floor or free), not a plane
    period: float  #: L of a periodic bed; 0 between walls
    #: (K,) moment on b, N (per metre of thickness), counter-clockwise positive; the opposite moment acts on a. None if
    #: contacts do not resist rolling (contact.rolling_friction = 0)
    moment: np.ndarray | None = None
    frame: Any = field(default=None, repr=False, compare=False)  #: frame of the contacts

    def __getitem__(self, name: str) -> np.ndarray:
        """Returns a quantity of the table in docs/export.md, `contacts["mobilisation"]`, in SI units."""
        from talus.frame import named

        return named(self.frame._measured._contact_values, name, lambda: self.quantities)

    @property
    def quantities(self) -> list[str]:
        """Names of the quantities of contacts: `contacts[name]`."""
        return self.frame._measured._contact_quantities

    def __len__(self) -> int:
        return len(self.pair)

    @property
    def branch(self) -> np.ndarray:
        """(K, 2) vector from the centre of a to that of b, or to the point on a plane: end - start."""
        return self.end - self.start

    @property
    def tangent(self) -> np.ndarray:
        """(K, 2) unit tangent t, the normal turned by +90 degrees."""
        return np.stack([-self.normal[:, 1], self.normal[:, 0]], axis=1)

    @property
    def force_on_b(self) -> np.ndarray:
        """(K, 2) force on b along (x, y), N/m; the opposite force acts on a."""
        return self.force[:, :1] * self.normal + self.force[:, 1:] * self.tangent

    def lines(self) -> tuple[np.ndarray, np.ndarray]:
        """Returns lines from centre to centre for drawing, (J, 2, 2), and the contact of each, (J,). A contact across
        the periodic edge has two lines, one at each edge; parts outside [0, L] must be clipped."""
        lines = np.stack([self.start, self.end], axis=1)
        across = np.flatnonzero((self.shift != 0) & (self.period > 0))
        again = lines[across]
        again[:, :, 0] -= (self.shift[across] * self.period)[:, None]
        return np.concatenate([lines, again]), np.concatenate([np.arange(len(self)), across])

    def to_pandas(self) -> Any:
        """Returns a DataFrame with one row for each contact: a, b, shift, x, y (the point), n_x, n_y, f_n, f_t, status,
        branch_x, branch_y, and moment if contacts resist rolling. Raises ImportError without pandas."""
        pairs = {"": self.point, "n_": self.normal, "branch_": self.branch}
        columns = {"a": self.pair[:, 0], "b": self.pair[:, 1], "shift": self.shift}
        columns |= {prefix + axis: values[:, i] for prefix, values in pairs.items() for i, axis in enumerate("xy")}
        columns |= {"f_n": self.force[:, 0], "f_t": self.force[:, 1], "status": self.status}
        if self.moment is not None:
            columns["moment"] = self.moment
        return need("pandas", "to_pandas()").DataFrame(columns)
