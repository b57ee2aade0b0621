"""Weakest push that starts an avalanche, as `talus perturb` measures it (docs/studies/metastability.md).

    sim = talus.Simulation("bed.toml")
    sim.tilt_to(15)
    bracket(perturb(sim))                # strongest push without and weakest with an avalanche, sqrt(g D)

A copy of a bed at its tilt is left to itself until it rests; its copies are pushed, with strengths that a bisection chooses.
Strengths are velocities over sqrt(g D), energies are over m g D, m the mass of a disk of diameter D, and times over
sqrt(D / g), so that beds of any grain size can be compared."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

import talus
from talus.simulation import _extension

#: Pushes that a search tries, sqrt(g D). The strongest one alone displaces the surface layer by less than the 5 D that count
#: as an avalanche; a stronger one would count as an avalanche even if nothing gives way.
WEAKEST, STRONGEST = 0.05, 5.0
#: Bisections in the logarithm, after which the ends of a bracket differ by 15 %.
BISECTIONS = 5
#: Factor by which two checks lie outside the bracket.
CHECK = 1.5
#: Longest trial, sqrt(D / g).
LONGEST = 200.0
#: Ends of a trial: at rest by the criterion of a deposition, failed by the rule that defines theta_c, or neither in time. A
#: run stores their numbers (/trials/end).
ENDS = ("rest", "avalanche", "undecided")


@dataclass
class Trial:
    """Response of a bed at fixed tilt."""

    strength: float  #: of the push; 0: none
    energy: float  #: that the push adds
    end: str  #: one of ENDS
    time: float  #: duration
    moved: int  #: free grains displaced by more than D at the end
    displacement: float  #: mean displacement of the surface layer downslope, D


@dataclass
class Bracket:
    """Result of the trials of a bed. The response of a bed is erratic, so there may be exceptions on either side."""

    held: bool = True  #: whether the bed comes to rest without a push; otherwise both ends are 0
    without: float = 0.0  #: strongest push without an avalanche; 0: even the weakest started one
    with_: float = math.inf  #: weakest push with an avalanche; infinite: none started one
    monotone: bool = True  #: whether no push below `without` started an avalanche, and each above `with_` did

    def __str__(self) -> str:
        if not self.held:
            return "does not hold without a push"
        if math.isinf(self.with_):
            return f"no avalanche up to {self.without:.3g} sqrt(g D)"
        return f"threshold in [{self.without:.3g}, {self.with_:.3g}] sqrt(g D){'' if self.monotone else ', erratic'}"


def patch_grains(sim: talus.Simulation, width: float, depth: float, x: float) -> np.ndarray:
    """Returns the ids of the free grains in a part of the surface: centres less than width / 2 along the bed from x (m), and
    not below `depth` under the mean free surface over that width. Width and depth in D."""
    lowest = sim.surface_height(x, width * sim.D) - depth * sim.D
    centres = sim.grains.position[:sim.grains.free_count]
    along = [math.remainder(each - x, sim.length) if sim.periodic else each - x for each in centres[:, 0].tolist()]
    return np.flatnonzero((np.abs(along) < 0.5 * (width * sim.D)) & (centres[:, 1] > lowest))


def follow(sim: talus.Simulation) -> Trial:
    """Steps a simulation, whose tilt must be held, until it rests or its slope has failed."""
    unit, h = math.sqrt(sim.D / sim.gravity), sim._core._time_step
    rest_velocity = sim.scenario["deposition"]["rest_velocity"] * sim.gravity * h
    (flow_velocity, flow_distance), rest_steps = sim._core._flow_rule, _extension().rest_steps
    free = sim.grains.free_count
    before, images = sim.grains.position[:free].copy(), sim.grains.image[:free].copy()
    end, time, displacement, flow, quiet = "undecided", 0.0, 0.0, 0.0, 0
    while end == "undecided" and time < LONGEST * unit:
        sim.step()
        time += h
        velocity = sim.surface_velocity
        displacement += h * velocity / sim.D
        flow = flow + h * velocity if velocity > flow_velocity else 0.0
        quiet = quiet + 1 if sim._core._rms_velocity <= rest_velocity else 0
        if flow >= flow_distance or sim.done:  # done: failed by a flow that began before
            end = "avalanche"
        elif quiet >= rest_steps and sim.converged:
            end = "rest"
    turns = sim.grains.image[:free].astype(float) - images
    dx, dy = (sim.grains.position[:free] - before).T
    dx = dx + turns * sim.length
    return Trial(0.0, 0.0, end, time / unit, int(np.count_nonzero(dx * dx + dy * dy > sim.D * sim.D)), displacement)


def push_trial(bed: talus.Simulation, patch: tuple[float, float], strength: float) -> Trial:
    """Pushes the patch (width, depth; D) in the middle of a copy of the bed downslope, and follows the copy."""
    sim = bed.copy()
    before = sim._core._kinetic_energy
    sim.push(patch_grains(sim, *patch, 0.5 * sim.length), (strength * math.sqrt(sim.gravity * sim.D), 0.0))
    added = sim._core._kinetic_energy - before
    trial = follow(sim)
    disk = sim.scenario["grains"]["density"] * 0.25 * math.pi * sim.D * sim.D
    trial.strength, trial.energy = strength, added / (disk * sim.gravity * sim.D)
    return trial


def bracket(trials: Sequence[Trial]) -> Bracket:
    """Returns the bracket from trials in sequence. Undecided ones count as neither outcome."""
    found = Bracket()
    for trial in trials:
        strength = trial.strength
        if strength == 0.0:
            found.held = trial.end == "rest"
            if not found.held:
                found.with_ = 0.0
        elif trial.end == "avalanche":
            if strength <= found.without:
                found.monotone = False
            else:
                found.with_ = min(found.with_, strength)
        elif trial.end == "rest":
            if strength >= found.with_:
                found.monotone = False
            else:
                found.without = max(found.without, strength)
    return found


def search(trial_at: Callable[[float], Trial]) -> list[Trial]:
    """Makes the trials of a search: strongest, weakest, bisections, checks. It ends early if the strongest push starts no
    avalanche, if the weakest one does not end at rest, or if a bisection is undecided; a check above the strongest push is
    left out."""
    trials: list[Trial] = []

    def ends_with(strength: float, end: str) -> bool:
        trials.append(trial_at(strength))
        return trials[-1].end == end

    if not ends_with(STRONGEST, "avalanche") or not ends_with(WEAKEST, "rest"):
        return trials
    for _ in range(BISECTIONS):
        found = bracket(trials)
        if ends_with(math.sqrt(found.without * found.with_), "undecided"):
            break
    found = bracket(trials)
    trials.append(trial_at(found.without / CHECK))
    if found.with_ * CHECK <= STRONGEST:
        trials.append(trial_at(found.with_ * CHECK))
    return trials


def perturb(sim: talus.Simulation, patch: tuple[float, float] = (10.0, 2.0)) -> list[Trial]:
    """Follows a copy of the bed, held at its tilt, without a push as the first trial; if it comes to rest, searches for the
    threshold of pushes on the bed at rest. `patch`: width and depth of the pushed part of the surface, D."""
    bed = sim.copy()
    bed.tilt_rate = 0.0
    trials = [follow(bed)]
    return trials + search(lambda strength: push_trial(bed, patch, strength)) if trials[0].end == "rest" else trials


@dataclass
class State:
    """A state of a run and the trials on it."""

    tilt: float  #: deg
    trials: list[Trial]


def stored_states(path: str) -> list[State]:
    """Returns the states of a run whose trials are stored with it (/trials), in ascending tilt."""
    states: list[State] = []
    with talus.open(path) as run:
        if "trials/tilt" not in run.quantities:
            return states
        columns = [run[f"trials/{name}"] for name in ("tilt", "velocity", "energy", "end", "time", "moved", "displacement")]
        for tilt, strength, energy, end, time, moved, displacement in zip(*(each.tolist() for each in columns)):
            if end not in (0, 1, 2):
                raise talus.Error(f"{path}: /trials/end holds a value other than 0, 1 and 2")
            if not states or states[-1].tilt != tilt:
                states.append(State(tilt, []))
            states[-1].trials.append(Trial(strength, energy, ENDS[int(end)], time, int(moved), displacement))
    return states


def print_trials(path: str, patch: str) -> None:
    """Prints the bracket, and a line for each trial, as /trials stores it, on the last state of a run, whose tilt must be held."""
    sim = talus.resume(path, progress=False)
    width, depth = map(float, patch.split("x"))
    trials = perturb(sim, (width, depth))
    print(bracket(trials))
    for trial in trials:
        print(trial.strength, trial.energy, ENDS.index(trial.end), trial.time, trial.moved, trial.displacement)


def main(words: list[str]) -> None:
    """Carries out a part of `talus perturb`."""
    part, *arguments = words
    if part == "check":  # that this module works, before long runs
        _extension()
    elif part == "trials":
        print_trials(*arguments)
    else:
        from talus.figures.weakest_push import report

        report(*arguments)
