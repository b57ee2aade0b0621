"""Other admissible forces of a bed whose grains are held in place (docs/studies/admissible-forces.md). A frictional packing with
more contacts than balance needs has many admissible sets of forces. They are sought from many first guesses, and what is measured
with each set is compared.

    found = search("runs/demo.h5", frame=40)
    found.stored, [each.values for each in found.sets if each.admissible]"""

import argparse
import json
import math
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from talus.simulation import _extension

#: Largest rms velocity, over g h, of a bed that is considered at rest, as in a run.
AT_REST = 0.005
#: Iterations of `balance` between two checks of its residual.
CHECK_EVERY = 20
#: First guesses, in the order of the search, and its methods. Random forces act on closed contacts only; the mean of their
#: normal forces is that of the stored ones times a random number between 0 and 2, and |f_t| is uniform up to mu f_n. After
#: these the three random starts follow in turn.
ATTEMPTS = (("stored", "contact dynamics"), ("zero", "balance"), ("halved", "balance"), ("doubled", "balance"),
            ("zero", "contact dynamics"), ("zero", "shuffled sweeps"))
RANDOM_STARTS = ("scattered", "exponential", "uniform")

Impulses = tuple[np.ndarray, np.ndarray]  #: normal and tangential impulses of the contacts, N s


class Random:
    """Generator PCG-XSH-RR 64/32 (O'Neill 2014), with the numbers of src/core/random.h on every platform."""

    MULTIPLIER, INCREMENT, MASK = 6364136223846793005, 1442695040888963407, 2**64 - 1

    def __init__(self, seed: int) -> None:
        self.state = (seed + self.INCREMENT) & self.MASK
        self.next()

    def next(self) -> int:
        old = self.state
        self.state = (old * self.MULTIPLIER + self.INCREMENT) & self.MASK
        shifted, rotation = ((old >> 18 ^ old) >> 27) & 0xFFFFFFFF, old >> 59
        return (shifted >> rotation | shifted << (-rotation & 31)) & 0xFFFFFFFF

    def uniform(self, low: float = 0.0, high: float = 1.0) -> float:
        first = self.next()
        return low + (high - low) * ((first << 21 ^ self.next() >> 11) * 2.0**-53)

    def below(self, bound: int) -> int:
        threshold = 2**32 % bound
        while (draw := self.next()) < threshold:
            pass
        return draw % bound

    def exponential(self) -> float:
        """Returns a number exponentially distributed with mean 1, by comparisons of uniform numbers (von Neumann 1951)."""
        whole = 0.0
        while True:
            last = first = self.uniform()
            odd = True  # whether the length of the descending run is odd
            while (now := self.uniform()) < last:
                last, odd = now, not odd
            if odd:
                return whole + first
            whole += 1.0

    def order(self, count: int) -> list[int]:
        """Returns the numbers below `count` in a random order (Fisher and Yates)."""
        order = list(range(count))
        for k in range(count, 1, -1):
            other = self.below(k)
            order[k - 1], order[other] = order[other], order[k - 1]
        return order


class Balance:
    """Impulses that hold bodies at rest. If all velocities vanish, any impulses in Coulomb's cones obey the contact law, so all
    sets of impulses in balance solve the contact problem; they form a convex set (McNamara and Herrmann 2004). The solvers of
    runs need not end in it: on a slope they may let bodies move."""

    def __init__(self, held: Any) -> None:
        self.a, self.b, self.mu, self.closed = held.a, held.b, held.mu, held.cn <= 0
        self.nx, self.ny = held.nx, held.ny
        self.free = (held.vx, held.vy, held.omega)
        self.inverse_mass, self.lever = held.inverse_mass, held.lever
        self.turn = held.inverse_inertia * held.lever
        self.both = np.concatenate([self.a, self.b])
        spin = held.lever * self.turn
        self.wn = self.inverse_mass[self.a] + self.inverse_mass[self.b]  # diagonal of the Delassus operator (T8)
        self.wt = self.wn + spin[self.a] + spin[self.b]
        self.stretch = np.sqrt(self.wt / self.wn)
        self.slope = self.mu * self.stretch

    def velocities(self, p: Impulses, free: Sequence[np.ndarray] | None = None) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Returns the velocities v_free + M^-1 H P of the bodies (T6)."""
        (pn, pt), (vx, vy, omega) = p, self.free if free is None else free
        fx, fy = pn * self.nx - pt * self.ny, pn * self.ny + pt * self.nx
        sums = [np.bincount(self.both, np.concatenate(parts), len(vx)) for parts in ((-fx, fx), (-fy, fy), (pt, pt))]
        return vx + self.inverse_mass * sums[0], vy + self.inverse_mass * sums[1], omega - self.turn * sums[2]

    def relative(self, v: tuple[np.ndarray, np.ndarray, np.ndarray]) -> Impulses:
        """Returns the relative velocities of the contacts (T5), without those that overlaps and restitution demand."""
        vx, vy, omega = v
        dx, dy, spin = vx[self.b] - vx[self.a], vy[self.b] - vy[self.a], self.lever * omega
        return dx * self.nx + dy * self.ny, dy * self.nx - dx * self.ny - (spin[self.a] + spin[self.b])

    def largest_eigenvalue(self) -> float:
        """Estimates the largest eigenvalue of D^-1 W from below by power iteration; D is the diagonal of W."""
        still = [np.zeros_like(each) for each in self.free]
        pn = np.where(np.arange(len(self.a)) % 2 == 0, 1.0, -1.0)  # far from any smooth mode
        pt, norm = pn, 1.0
        for _ in range(60):
            un, ut = self.relative(self.velocities((pn, pt), still))
            before = pn @ pn + pt @ pt
            pn, pt = un / self.wn, ut / self.wt
            square = pn @ pn + pt @ pt
            norm = math.sqrt(square / before)
            pn, pt = pn / math.sqrt(square), pt / math.sqrt(square)
        return norm

    def descend(self, step: float, p: Impulses) -> Impulses:
        """Makes a projected gradient step: the nearest point of the cones |P_t| <= mu P_n, with tangential lengths multiplied by
        `stretch`. Open contacts carry nothing."""
        un, ut = self.relative(self.velocities(p))
        pn, pt = p[0] - step * un / self.wn, p[1] - step * ut / self.wt
        side = np.abs(pt) * self.stretch
        outside = side > self.slope * pn
        inside = np.maximum((pn + self.slope * side) / (1 + self.slope * self.slope), 0)
        pt = np.where(outside, np.copysign(self.mu * inside, pt), pt) * self.closed
        return np.where(outside, inside, pn) * self.closed, pt

    def residual(self, p: Impulses) -> float:
        """Returns || P' - P || / || P ||, P' the projected gradient step of length 1 from P. It vanishes at the minimum even if the
        bodies are not held there."""
        after = self.descend(1.0, p)
        change, norm = ((each[0] @ each[0] + each[1] @ each[1]) for each in ((after[0] - p[0], after[1] - p[1]), p))
        scale = norm if norm > 0 else after[0] @ after[0] + after[1] @ after[1]
        return math.sqrt(change / scale) if scale > 0 else 0.0

    def solve(self, p: Impulses, tolerance: float, max_iterations: int) -> tuple[Impulses, int, float]:
        """Minimises the kinetic energy of v_free + M^-1 H P over Coulomb's cones of the closed contacts, by projected gradients
        with Nesterov's momentum, and so ends near the admissible set closest to the guess. Returns it, iterations and residual."""
        step = 0.9 / self.largest_eigenvalue()
        at, t, iterations = p, 1.0, 0
        while True:
            if iterations % CHECK_EVERY == 0 or iterations >= max_iterations:
                eta = self.residual(p)
                if eta <= tolerance or iterations >= max_iterations:
                    return p, iterations, eta
            after = self.descend(step, at)
            moved = after[0] - p[0], after[1] - p[1]
            # Whether the momentum points uphill: the step opposes the move.
            if (self.wn * (at[0] - after[0])) @ moved[0] + (self.wt * (at[1] - after[1])) @ moved[1] > 0:
                t = 1.0
            t_next = 0.5 * (1 + math.sqrt(1 + 4 * t * t))
            share, t = (t - 1) / t_next, t_next
            at, p = (after[0] + share * moved[0], after[1] + share * moved[1]), after
            iterations += 1


@dataclass
class ForceSet:
    """Forces found by an attempt, and what is measured with them."""

    start: str  #: first guess
    method: str
    pn: np.ndarray  #: impulses of the contacts, N s
    pt: np.ndarray
    iterations: int
    eta: float  #: residual
    converged: bool
    momentum_left: float  #: rms velocity after the step, over g h: 0 if all grains are balanced, 1 if all fall
    unbalanced: int  #: number of free grains with a velocity above 0.1 g h
    distance: float  #: || P - P_stored || / || P_stored || over all contacts
    values: list[float] = field(default_factory=list)  #: of the quantities

    @property
    def admissible(self) -> bool:
        """Whether the method has converged and these forces hold the bed at rest by the criterion of a run."""
        return self.converged and self.momentum_left <= AT_REST

    @property
    def name(self) -> str:
        return self.start if self.method == "balance" else f"{self.start}, {self.method}"


@dataclass
class FrameForces:
    """A frame and its admissible forces. `stored` and the values of each set are in the order of `quantities`."""

    tilt: float  #: deg
    contacts: int  #: number of contacts of the problem, including near ones
    quantities: list[tuple[str, float]]  #: name, and threshold over Gamma_c, 0 without; lengths are in D
    stored: list[float]  #: values with the forces stored by the run, as in `talus analyze`
    sets: list[ForceSet]  #: the first is from the stored forces

    @property
    def others(self) -> list[ForceSet]:
        return self.sets[1:]

    @property
    def admissible(self) -> int:
        return sum(each.admissible for each in self.others)

    def spread(self, q: int) -> np.ndarray:
        """Returns the values of quantity q over the admissible sets, except that from the stored forces."""
        values = np.array([each.values[q] for each in self.others if each.admissible], dtype=float)
        known: np.ndarray = values[~np.isnan(values)]
        return known


def attempts(count: int) -> list[tuple[str, str]]:
    """Returns start and method of each attempt: the first from the stored forces, and `count` others."""
    found = list(ATTEMPTS)
    while len(found) <= count:
        found.append((RANDOM_STARTS[len(found) % 3], "balance"))
    return found[: count + 1]


def first_guess(held: Any, start: str, random: Random) -> Impulses:
    """Returns the first guess of an attempt."""
    pn, pt = held.pn, held.pt
    if start in ("exponential", "uniform"):
        carrying = pn[pn > 0]
        mean = (carrying.sum() / len(carrying) if len(carrying) else 0.0) * random.uniform(0, 2)
        shares = np.array([(random.exponential() if start == "exponential" else 2 * random.uniform(), random.uniform(-1, 1))
                           for _ in range(len(pn))]).reshape(-1, 2).T
        pn = mean * shares[0] * (held.cn <= 0)
        return pn, held.mu * pn * shares[1]
    factor: Any = {"stored": 1.0, "zero": 0.0, "halved": 0.5, "doubled": 2.0}.get(start)
    if factor is None:
        factor = np.array([2 * random.uniform() for _ in range(len(pn))])
    return factor * pn, factor * pt


def find_forces(held: Any, balance: Balance, start: str, method: str, tolerance: float, max_iterations: int,
                random: Random) -> ForceSet:
    """Carries out an attempt."""
    p = first_guess(held, start, random)
    if method == "balance":
        (pn, pt), iterations, eta = balance.solve(p, tolerance, max_iterations)
        converged = eta <= tolerance
    else:
        sweeps = method == "shuffled sweeps"
        order = random.order(len(p[0])) if sweeps else list(range(len(p[0])))
        pn, pt, iterations, eta, converged = held.solve(*p, sweeps, tolerance, max_iterations, order)
    vx, vy, omega = (each[: held.free_count] for each in balance.velocities((pn, pt)))
    squares = vx * vx + vy * vy
    rim = held.radius[: held.free_count] * omega
    scale = held.pn @ held.pn + held.pt @ held.pt
    away = (pn - held.pn) @ (pn - held.pn) + (pt - held.pt) @ (pt - held.pt)
    return ForceSet(start, method, pn, pt, iterations, eta, converged,
                    math.sqrt((squares + rim * rim).mean()) / held.fall if len(vx) else 0.0,
                    int(np.count_nonzero(squares > (0.1 * held.fall) ** 2)), math.sqrt(away / scale) if scale > 0 else math.nan)


def search(path: str, frame: int, *, solutions: int = 20, tolerance: float = 3e-7, max_iterations: int = 20000, seed: int = 1,
           settings: Sequence[str] = ()) -> FrameForces:
    """Searches for the forces of a frame of a run and measures each set with the functions of an ordinary analysis.

    solutions: attempts in addition to that from the stored forces; tolerance: residual to reach; seed: of the random starts and
    orders; settings: parameters of the analysis, "l_min=0". Raises Error if Gamma_c is not known, if the parameters average over
    frames, or if contacts resist rolling."""
    held = _extension().HeldFrame(path, frame, list(settings))
    balance, random = Balance(held), Random(seed)
    sets = [find_forces(held, balance, *attempt, tolerance, max_iterations, random) for attempt in attempts(solutions)]
    for each in sets:
        each.values = held.values(each.pn, each.pt)
    quantities = [("Gamma", 0.0), ("critical_share", 0.0)]
    quantities += [(name, factor) for factor in held.factors for name in ("p_o", "lc_mean", "lc_max")]
    return FrameForces(math.degrees(held.tilt), len(held.a), quantities, held.stored_values(), sets)


def statistics(values: np.ndarray) -> dict[str, float]:
    """Returns mean, standard deviation (with n - 1), least and largest value; NaN for too few."""
    some, several = len(values) > 0, len(values) > 1
    return {"mean": float(values.mean()) if some else math.nan, "deviation": float(values.std(ddof=1)) if several else math.nan,
            "least": float(values.min()) if some else math.nan, "largest": float(values.max()) if some else math.nan}


def as_json(found: FrameForces, frame: int) -> str:
    """Returns the result for a frame as JSON; NaN is null."""
    def known(value: Any) -> Any:
        if isinstance(value, dict):
            return {name: known(each) for name, each in value.items()}
        if isinstance(value, list):
            return [known(each) for each in value]
        return None if isinstance(value, float) and not math.isfinite(value) else value

    spreads = [{"quantity": name, "threshold_factor": factor or None, "stored": found.stored[q], "count": len(found.spread(q)),
                **statistics(found.spread(q))} for q, (name, factor) in enumerate(found.quantities)]
    sets = [{"start": each.name, "iterations": each.iterations, "eta": each.eta, "converged": each.converged,
             "admissible": each.admissible, "momentum_left": each.momentum_left, "unbalanced": each.unbalanced,
             "distance": each.distance, "values": each.values} for each in found.sets]
    return json.dumps(known({"frame": frame, "tilt_deg": found.tilt, "contacts": found.contacts, "others": len(found.others),
                             "admissible": found.admissible, "spreads": spreads, "solutions": sets}), indent=2)


def number(value: float, digits: int) -> str:
    """Returns a number with this many decimals; "-" for NaN, no minus for 0."""
    text = "-" if math.isnan(value) else f"{value:.{digits}f}"
    return text[1:] if text.startswith("-") and len(text) > 1 and float(text) == 0 else text


def aligned(titles: Sequence[str], rows: Sequence[Sequence[str]]) -> Iterator[str]:
    """Yields the lines of a table with its first column and one without a title aligned to the left."""
    full = [list(titles), *([*row, *[""] * (len(titles) - len(row))] for row in rows)]
    widths = [max(map(len, cells)) for cells in zip(*full)]
    for row in full:
        cells = [cell.ljust(width) if k == 0 or not title else cell.rjust(width)
                 for k, (cell, width, title) in enumerate(zip(row, widths, titles))]
        yield ("  " + "  ".join(cells)).rstrip()


def as_text(found: FrameForces, frame: int, tolerance: float) -> str:
    """Returns the result for a frame as two tables: the sets, and the spread of each quantity."""
    def verdict(each: ForceSet) -> str:
        if each.admissible:
            return ""
        return "leaves grains unsupported, not counted" if each.converged else "not converged, not counted"

    sets = [[each.name, str(each.iterations), f"{each.eta:.1e}", f"{each.momentum_left:.1e}", str(each.unbalanced),
             number(each.distance, 3), number(each.values[0], 4), number(each.values[2], 4), number(each.values[3], 3),
             verdict(each)] for each in found.sets]
    spreads = []
    for q, (name, factor) in enumerate(found.quantities):
        values = found.spread(q)
        cells = [number(each, 5) for each in statistics(values).values()] if len(values) else ["none"]
        spreads.append([f"{name} at {factor:g} Gamma_c" if factor else name, number(found.stored[q], 5), *cells])
    lines = [f"frame {frame} at {number(found.tilt, 3)} deg, {found.contacts} contacts: {found.admissible} of {len(found.others)} "
             f"other sets of forces are admissible (eta {tolerance:.1e})",
             *aligned(["start", "iterations", "eta", "momentum", "unbalanced", "distance", "Gamma", "p_o", "lc_mean", ""], sets),
             "", *aligned(["quantity", "stored", "mean", "deviation", "least", "largest"], spreads)]
    return "\n".join(lines) + "\n"


def main(words: list[str]) -> None:
    """Carries out `talus forces`, which has checked the options and chosen the frames."""
    parser = argparse.ArgumentParser(add_help=False)
    parser.add_argument("run")
    parser.add_argument("frames", type=int, nargs="*")
    parser.add_argument("--solutions", type=int)
    parser.add_argument("--tol", type=float)
    parser.add_argument("--max-iterations", type=int)
    parser.add_argument("--seed", type=int)
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--json", action="store_true")
    given = parser.parse_args(words)
    for k, frame in enumerate(given.frames):
        found = search(given.run, frame, solutions=given.solutions, tolerance=given.tol, max_iterations=given.max_iterations,
                       seed=given.seed, settings=given.set)
        before = ("[", ",\n")[k > 0] if given.json else "\n" * (k > 0)
        sys.stdout.write(before + (as_json(found, frame) if given.json else as_text(found, frame, given.tol)))
        sys.stdout.flush()
    if given.json:
        print("]" if given.frames else "[]")
