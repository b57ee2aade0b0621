"""Values that L. Staron, J.-P. Vilotte and F. Radjai report in "Multiscale Analysis of the Stress State in a Granular Slope in
Transition to Failure" (2005), the same quantities of a run, and their comparison (docs/reproduce.md)."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from talus.ensemble import Mean, mean_of
from talus.figures.tables import short_text
from talus.places import SAME_TILT, frame_not_after
from talus.run import Run, last_rise
from talus.table import numbered

DEPTH = 40.0  #: of the paper's beds, D
LC_CUT = 30.0  #: largest l_c of its data processing, D
#: k_L - k_0 of its Eq. 15, and its accuracy.
WALL_COEFFICIENT, WALL_ACCURACY = 2.5, 0.25
READING_VERSION = "2 "  #: beginning of the keys of further analyses (src/ensemble/member_task.cpp)
THRESHOLDS = 2  #: of the analysis with default parameters: Gamma_c and 2 Gamma_c


class PaperValue(NamedTuple):
    """A value of the paper. Its accuracy is half a step of the printed number, or of the scale from which it was read; for
    theta_c, given as one range for all beds, half the width of the range."""

    name: str  #: "p_o at 0 deg"
    where: str  #: "Sec. V A, Fig. 9"
    text: str  #: wording of the paper: "about 30 %"
    value: float
    accuracy: float
    unit: str  #: "deg", "D" or "1"
    source: str  #: quantity of the analysis from which ours is computed; "@place" if ours is this number of members.csv
    definition: str  #: of our value
    above: bool = False  #: the paper states only that it exceeds `value`


#: Places such as theta_d refer to the same run; theta_d is the tilt at which l_c max jumps.
PACKING = {
    "solid_fraction": PaperValue(
        "solid fraction at 0 deg", "Sec. II B", "about 0.8", 0.8, 0.05, "1", "packing/solid_fraction@0",
        "area of the free grains over the area below the free surface, first frame"),
    "coordination_number": PaperValue(
        "coordination number z at 0 deg", "Sec. II B", "about 3.5", 3.5, 0.05, "1", "contacts/coordination_number@0",
        "force-carrying contacts per grain that carries force, first frame"),
    "normals_near_0": PaperValue(
        "contact normals concentrate near 0 deg", "Sec. II B", "0 deg", 0.0, 5.0, "deg", "contacts/direction_peak",
        "peak of their directions within 30 deg, density smoothed over 5 deg, first frame"),
    "normals_near_60": PaperValue(
        "contact normals concentrate near 60 deg", "Sec. II B", "60 deg", 60.0, 5.0, "deg", "contacts/direction_peak", "the same"),
    "normals_near_120": PaperValue(
        "contact normals concentrate near 120 deg", "Sec. II B", "120 deg", 120.0, 5.0, "deg", "contacts/direction_peak",
        "the same"),
    "stress_ratio_at_0": PaperValue(
        "Gamma at 0 deg", "Sec. IV, Fig. 5", "about 0.08", 0.08, 0.005, "1", "packing/stress_ratio@0",
        "Q/P of the packing, first frame"),
    "theta_c": PaperValue(
        "theta_c", "Sec. IV, Fig. 4", "about 19 to 21 deg, all beds", 20.0, 1.0, "deg", "theta_c",
        "tilt at which the final, sustained flow began"),
    "shear_over_tangent": PaperValue(
        "sigma_T/sigma_N over tan(theta) at theta_c", "Eq. 10, Fig. 4", "1, fits excellently", 1.0, 0.02, "1",
        "packing/failure_ratio", "mean over the last half degree up to theta_c"),
    "stress_ratio_over_sine": PaperValue(
        "Gamma over sin(theta) at theta_c", "Eq. 11, Fig. 5", "1, fits well", 1.0, 0.05, "1", "packing/stress_ratio",
        "mean over the last half degree up to theta_c"),
    "contraction": PaperValue(
        "contraction up to theta_d", "Sec. VI, Fig. 14", "the volume first decreases", 0.0, 0.0, "1", "packing/volume_strain",
        "V0 less the smallest V, over V0; up to theta_c if no dilation sets in; none if the range of the minimum begins at the "
        "first tilt", above=True),
    "dilation": PaperValue(
        "dilation from theta_d to theta_c", "Sec. VI, Fig. 14", "then it increases", 0.0, 0.0, "1", "packing/volume_strain",
        "volume strain at theta_c less that at its minimum; none if it does not rise above its noise", above=True),
    "volume_strain_at_theta_c": PaperValue(
        "volume strain at theta_c", "Sec. VI, Fig. 14", "positive", 0.0, 0.0, "1", "packing/volume_strain@theta_c",
        "(V - V0)/V0 of the last frame up to theta_c", above=True),
}
#: The values that need a threshold for overloaded grains, and the onset of dilation: the paper's chain.
CHAIN = {
    "overloaded_at_0": PaperValue(
        "p_o at 0 deg", "Sec. V A, Fig. 9", "about 30 %", 0.30, 0.025, "1", "overloaded/fraction@0",
        "overloaded grains over those that carry something, first frame"),
    "overloaded_at_theta_d": PaperValue(
        "p_o at theta_d", "Sec. V B, Fig. 9", "0.45", 0.45, 0.025, "1", "overloaded/fraction@theta_d",
        "the same in the frame after the jump of l_c max"),
    "overloaded_at_theta_c": PaperValue(
        "p_o at theta_c", "Sec. V A, Fig. 9", "about 60 %", 0.60, 0.025, "1", "overloaded/fraction@theta_c",
        "the same in the last frame up to theta_c"),
    "overloaded_at_percolation": PaperValue(
        "p_o at percolation", "Sec. V B", "0.45", 0.45, 0.025, "1", "overloaded/fraction@percolation",
        "the same in the first frame from which a cluster spans from floor to surface"),
    "lc_mean_at_0": PaperValue(
        "mean l_c at 0 deg", "Sec. V B, Fig. 12a", "4 D", 4.0, 0.5, "D", "lc/mean@0",
        "mean over the overloaded grains, first frame; a diameter"),
    "lc_mean_at_theta_d": PaperValue(
        "mean l_c at theta_d", "Sec. V B, Fig. 12a", "5 D", 5.0, 0.5, "D", "lc/mean@theta_d",
        "the same in the frame after the jump of l_c max"),
    "lc_mean_at_theta_c": PaperValue(
        "mean l_c at theta_c", "Sec. V B, Fig. 12a", "about 7 D", 7.0, 0.5, "D", "lc/mean@theta_c",
        "the same in the last frame up to theta_c"),
    "lc_max_at_0": PaperValue(
        "largest l_c at 0 deg", "Sec. V B, Fig. 12b", "5 D", 5.0, 2.5, "D", "lc/max@0",
        "largest over the overloaded grains, first frame"),
    "lc_max_before_jump": PaperValue(
        "largest l_c just below theta_d", "Sec. V B, Fig. 12b", "15 D", 15.0, 2.5, "D", "lc/max@before_theta_d",
        "the same in the frame before its jump"),
    "lc_max_after_jump": PaperValue(
        "largest l_c just above theta_d", "Sec. V B, Fig. 12b", "30 D, the cut", 30.0, 2.5, "D", "lc/max@theta_d",
        "the same in the frame after its jump, but at most 30 D, the cut of the paper"),
    "theta_d_by_jump": PaperValue(
        "theta_d: jump of l_c max", "Sec. V B, Fig. 12b", "15 deg", 15.0, 0.5, "deg", "theta_d/lc_jump",
        "frame after the largest increase, up to where the cut is reached"),
    "theta_d_by_percolation": PaperValue(
        "theta_d: percolation", "Sec. V B, Fig. 13", "15 deg", 15.0, 0.5, "deg", "theta_d/percolation",
        "first of at least 3 frames in a row in which a cluster spans from floor to surface"),
    "theta_d_by_dilation": PaperValue(
        "theta_d: onset of dilation", "Sec. VI, Fig. 14", "15 deg", 15.0, 0.5, "deg", "theta_d/dilation",
        "minimum of the volume strain, a mean over 1 deg; none if it does not rise above its noise; an upper bound if its range "
        "begins at the first tilt"),
}
#: The values of beds between walls.
WALLS = {
    "theta_c_of_walls": PACKING["theta_c"],
    "shear_over_tangent_of_walls": PaperValue(
        "sigma_T/sigma_N over tan(theta) at theta_c", "Eq. 15, Fig. 7", "1 - (k_L - k_0)/3 H/L", 1.0, 0.0, "1",
        "packing/failure_ratio", "mean over the last half degree up to theta_c"),
    "wall_gradient": PaperValue(
        "sigma_xx grows downslope at theta_c", "Sec. IV, Fig. 6", "gradient along the bed", 0.0, 0.0, "1", "sections/sigma_xx",
        "mean sigma_xx of the lower half of the bed less that of the upper, over their mean; last half degree up to theta_c",
        above=True),
}
#: The coefficient of Eq. 15, which is fitted to many beds.
COEFFICIENT = PaperValue(
    "k_L - k_0", "Eq. 15, Fig. 7", "about 2.5", WALL_COEFFICIENT, WALL_ACCURACY, "1", "packing/failure_ratio",
    "least squares of Eq. 15 on the ratios of all beds between walls, with the standard error of the fit")


def wall_value(name: str, depth_over_length: float) -> PaperValue:
    """Returns a value of WALLS for a bed with this H / L; only sigma_T / sigma_N depends on it."""
    if name != "shear_over_tangent_of_walls":
        return WALLS[name]
    return WALLS[name]._replace(value=wall_law(WALL_COEFFICIENT, depth_over_length),
                                accuracy=WALL_ACCURACY / 3 * depth_over_length)


# Ours


class Measured(NamedTuple):
    """A value of ours in the unit of the paper's; NaN if the run has none."""

    value: float
    at_most: bool = False  #: only an upper bound, because the event precedes the first frame


def measure(run: Run, numbers: Mapping[str, float]) -> dict[str, list[dict[str, Measured]]]:
    """Returns the values of an analysed run, opened in SI units, whose scalars are `numbers`, by analysis: "stored" for that
    of the run file, the same with p_o over all grains, and the further analyses that the file holds (READINGS). Of each
    there is one dictionary for each threshold; a further analysis has only the values of the CHAIN. Empty dictionaries if
    the slope has not failed."""
    if math.isnan(numbers["theta_c"]):
        return {"stored": [{}] * THRESHOLDS, OF_ALL: [{}] * THRESHOLDS}
    derived = _derived(run)
    stored = {name: [{key: derived[key] if key in derived else _number(key, paper, numbers, f, of_all)
                      for key, paper in (PACKING | CHAIN | WALLS).items()} for f in range(THRESHOLDS)]
              for name, of_all in (("stored", False), (OF_ALL, True))}
    dilation = derived["theta_d_by_dilation"]
    names = [name.removeprefix("readings/key/") for name in run.quantities
             if name.startswith("readings/key/") and run[name].startswith(READING_VERSION)]
    return stored | {name: [_chain_of(values, bounds, dilation) for values, bounds in zip(
        run["readings/value/" + name], run["readings/at_most/" + name])] for name in names}


def _number(key: str, paper: PaperValue, numbers: Mapping[str, float], f: int, of_all: bool) -> Measured:
    source = paper.source.replace("overloaded/fraction@", "overloaded/fraction_of_all@") if of_all else paper.source
    k = f if source.startswith(("overloaded/", "lc/", "theta_d/")) else 0
    value = numbers.get(numbered(source, k), math.nan)
    at_percolation = key in ("theta_d_by_percolation", "overloaded_at_percolation") and not math.isnan(value)
    bound = at_percolation and math.isnan(numbers[numbered("theta_d/percolation_error", f)])
    return _cut(key, Measured(value, bound))


def _cut(key: str, measured: Measured) -> Measured:
    """Values beyond the cut of the paper's data processing are unknown in the paper."""
    return measured._replace(value=min(measured.value, LC_CUT)) if key == "lc_max_after_jump" else measured


def _chain_of(values: np.ndarray, bounds: np.ndarray, dilation: Measured) -> dict[str, Measured]:
    """Returns the chain of a further analysis from its row in the run file."""
    found = {key: _cut(key, Measured(float(value), bool(bound))) for key, value, bound in zip(CHAIN, values, bounds)}
    return found | {"theta_d_by_dilation": dilation}


def _derived(run: Run) -> dict[str, Measured]:
    """Returns the values that combine several numbers of a run that has failed."""
    tilts = run["frames/tilt"][: run.frames_of_tilt]
    rise = slice(*last_rise(tilts))
    tilt, theta_c = np.abs(tilts[rise]), run.analysis["theta_c"]
    strain = run.analysis["packing/volume_strain"][rise]
    at_theta_c = max(frame_not_after(tilt, theta_c), 0)
    last = np.flatnonzero(tilt[:at_theta_c] >= theta_c - np.radians(0.5)).tolist() + [at_theta_c]
    ratios = run.analysis["packing/stress_ratio"][rise][last] / np.sin(tilt[last])
    upper, lower = np.array_split(run.analysis["sections/sigma_xx"][rise][last], 2, axis=1)
    peaks = np.degrees(run.analysis["contacts/direction_peak"][rise][0])
    # The range of the minimum of the strain says whether contraction and dilation are more than noise.
    onset, low, high = (float(run.analysis[f"theta_d/dilation{end}"][0]) for end in ("", "_low", "_high"))
    from_start = low <= tilt[0] + SAME_TILT
    minimum = at_theta_c if math.isnan(onset) else max(frame_not_after(tilt, onset), 0)
    return {
        "normals_near_0": Measured(float(peaks[0] - 180 if peaks[0] > 90 else peaks[0])),
        "normals_near_60": Measured(float(peaks[1])),
        "normals_near_120": Measured(float(peaks[2])),
        "stress_ratio_over_sine": Measured(float(ratios.mean())),
        "contraction": Measured(math.nan if from_start and not math.isnan(onset) else -float(strain[minimum])),
        "dilation": Measured(math.nan if math.isnan(onset) else float(strain[at_theta_c] - strain[minimum])),
        "theta_d_by_dilation": Measured(float(np.degrees(high if from_start else onset)), bool(from_start)),
        "wall_gradient": Measured(float((2 * (lower.sum(1) - upper.sum(1)) / (lower.sum(1) + upper.sum(1))).mean())),
    }


def wall_point(run: Run, numbers: Mapping[str, float]) -> tuple[float, float]:
    """Returns H / L of a bed at failure, from its volume, and (sigma_T / sigma_N) / tan(theta); NaN if it has not failed."""
    if math.isnan(numbers["theta_c"]):
        return math.nan, math.nan
    tilts = run["frames/tilt"][: run.frames_of_tilt]
    rise = slice(*last_rise(tilts))
    volume = run.analysis["packing/volume"][rise][frame_not_after(np.abs(tilts[rise]), run.analysis["theta_c"])]
    return float(volume / run.length**2), numbers["packing/failure_ratio"]


def wall_law(k: float, depth_over_length: Any) -> Any:
    """Returns (sigma_T / sigma_N) / tan(theta) of beds between walls with this H / L by the paper's Eq. 15, k = k_L - k_0."""
    return 1 - k / 3 * depth_over_length


# Comparison


@dataclass(frozen=True)
class Spread:
    """A value over several seeds."""

    runs: int  #: with or without a value
    values: Mean
    at_most: bool = False  #: a run gives only an upper bound


def spread_of(values: Sequence[Measured]) -> Spread:
    return Spread(len(values), mean_of([value for value, _ in values]),
                  any(at_most and not math.isnan(value) for value, at_most in values))


class Judgement(NamedTuple):
    verdict: str  #: "agrees", "differs", "absent" (no run shows what the paper reports) or "not comparable"
    difference: float  #: our value minus the paper's
    tolerance: float  #: largest difference that still agrees
    reason: str = ""  #: of "not comparable"

    @property
    def text(self) -> str:
        """Returns "agrees"; "differs by +0.62 (tolerance 0.03)"; "does not occur"; "not comparable: ..."."""
        if self.verdict == "differs":
            tolerance = f" (tolerance {self.tolerance:.2g})" if self.tolerance > 0 else ""
            return f"differs by {self.difference:+.2g}{tolerance}"
        return {"absent": "does not occur", "not comparable": f"not comparable: {self.reason}"}.get(self.verdict, self.verdict)


def judge(paper: PaperValue, ours: Spread, depth: float) -> Judgement:
    """Compares the mean over the seeds with the paper's value: it agrees if the difference does not exceed the accuracy of the
    paper's number plus one standard deviation over the seeds (the accuracy alone for one seed), or, if the paper states only
    that the value exceeds a number, if it does. An upper bound differs if it lies below the value by more than the tolerance.
    A length in D cannot be compared if the bed, of this `depth` (D), is not as deep as the paper's, because lengths end at
    the depth."""
    difference = ours.values.mean - paper.value
    tolerance = 0.0 if paper.above else paper.accuracy + (ours.values.deviation if ours.values.count > 1 else 0.0)
    if ours.runs == 0:
        return Judgement("not comparable", difference, tolerance, "no such run is complete")
    if paper.unit == "D" and depth != DEPTH:
        return Judgement("not comparable", difference, tolerance, f"H = {short_text(depth)} D, not {short_text(DEPTH)} D")
    if ours.values.count == 0:
        return Judgement("absent", difference, tolerance)
    if paper.above:
        return Judgement("agrees" if difference > 0 else "differs", difference, tolerance)
    if ours.at_most and difference >= -tolerance:
        return Judgement("not comparable", difference, tolerance, "only a bound")
    rounding = 1e-9  # allows for a difference equal to the tolerance
    return Judgement("agrees" if abs(difference) <= tolerance + rounding else "differs", difference, tolerance)


# Readings


OF_ALL = "stored; p_o over all grains"


class Reading(NamedTuple):
    """A reading of the paper's definitions of overloaded grains and of what follows from them."""

    base: str  #: "single grains, gamma >= Gamma_c"
    change: str  #: the factor that differs from the first reading of this base, or empty
    analysis: str  #: name of the analysis with "CUT" for l_c cut as in the paper (analysis_name)
    threshold: int  #: index


#: All readings: those without a change are single grains with the printed threshold and with twice it, and grains with their
#: first neighbours. The names of analyses are their parameters, which src/ensemble/member_task.cpp sets.
READINGS = [
    *(Reading(base, change, analysis, f)
      for f, base in enumerate(("single grains, gamma >= Gamma_c", "single grains, gamma >= 2 Gamma_c"))
      for change, analysis in (
          ("", "l_min=0"),
          ("grains with 3 contacts or more", "l_min=0,min_contacts=3"),
          ("moments averaged over 1 deg", "l_min=0,averaging=1"),
          ("neighbours joined", "l_min=0,joining=neighbours"),
          ("3 contacts, averaged and neighbours", "l_min=0,min_contacts=3,averaging=1,joining=neighbours"),
          ("l_c cut as in the paper", "l_min=0,lc_cut=CUT"),
          *((("l_c ends at Gamma_c", "l_min=0,lc_factor=1"),
             ("l_c ends at Gamma_c, neighbours joined", "l_min=0,lc_factor=1,joining=neighbours")) if f == 1 else ()))),
    *(Reading("grains with first neighbours, gamma >= Gamma_c", change, analysis, 0)
      for change, analysis in (
          ("", "stored"),
          ("p_o over all grains", OF_ALL),
          ("moments averaged over 1 deg", "averaging=1"),
          ("neighbours joined", "joining=neighbours"),
          ("l_c cut as in the paper", "lc_cut=CUT"),
          ("neighbourhoods of at least 4 D", "l_min=4"))),
]
BASES = [reading for reading in READINGS if not reading.change]
STORED = BASES[-1]  #: the reading of the stored analysis


def analysis_name(reading: Reading, depth: float) -> str:
    """Returns the name of the analysis of a reading for a bed of this depth, D; the paper's cut is 3/4 of its depth."""
    return reading.analysis.replace("CUT", short_text(LC_CUT / DEPTH * depth))


@dataclass(frozen=True)
class Result:
    """The chain of one preparation under one reading."""

    preparation: int  #: index of the bed
    reading: int  #: index in READINGS
    spreads: list[Spread]  #: over the seeds, in the order of CHAIN
    judgements: list[Judgement]

    @property
    def agreeing(self) -> int:
        """Number of values that agree: the score."""
        return sum(each.verdict == "agrees" for each in self.judgements)

    @property
    def comparable(self) -> int:
        return sum(each.verdict != "not comparable" for each in self.judgements)

    @property
    def deviation(self) -> float:
        """Median of |ours - paper| / paper over the comparable values, infinite for one that does not occur; NaN if nothing
        can be compared."""
        shares = [math.inf if each.verdict == "absent" else abs(each.difference / paper.value)
                  for each, paper in zip(self.judgements, CHAIN.values()) if each.verdict != "not comparable"]
        return float(np.median(shares)) if shares else math.nan

    @property
    def rank(self) -> tuple[float, float]:
        """The smaller, the nearer to the paper; equal results have equal ranks."""
        return -self.agreeing, math.inf if math.isnan(self.deviation) else self.deviation


def judge_reading(preparation: int, reading: int, runs: Sequence[Mapping[str, Measured]], depth: float) -> Result:
    """Judges the chain of one preparation under one reading; `runs` holds the values of each seed."""
    spreads = [spread_of([run.get(key, Measured(math.nan)) for run in runs]) for key in CHAIN]
    judgements = [judge(paper, spread, depth) for paper, spread in zip(CHAIN.values(), spreads)]
    return Result(preparation, reading, spreads, judgements)


@dataclass(frozen=True)
class Conclusion:
    """What follows from all results together."""

    best: list[Result]  #: those with the highest score; of these, with the smallest deviation
    smallest_deviation: Result | None  #: of all
    complete: bool  #: a best result agrees in every comparable value
    #: Values of CHAIN, by their places, that no result brings within tolerance, and the result that comes nearest; None if
    #: the value occurs in none.
    missed: list[tuple[int, Result | None]]
    reading_scores: dict[int, float]  #: mean score of each reading over preparations
    preparation_scores: dict[int, float]  #: mean score of each preparation over readings


def conclude(results: Sequence[Result]) -> Conclusion:
    """Draws the conclusions from at least one result."""
    first = min(results, key=lambda result: result.rank)
    best = [result for result in results if result.rank == first.rank]
    missed: list[tuple[int, Result | None]] = []
    for v in range(len(CHAIN)):
        judged = [(result, result.judgements[v]) for result in results if result.judgements[v].verdict != "not comparable"]
        if not judged or any(each.verdict == "agrees" for _, each in judged):
            continue
        occurring = [(result, each) for result, each in judged if each.verdict != "absent"]
        nearest = min(occurring, key=lambda found: abs(found[1].difference))[0] if occurring else None
        missed.append((v, nearest))

    def scores(keys: Sequence[int]) -> dict[int, float]:
        return {key: mean_of([result.agreeing for k, result in zip(keys, results) if k == key]).mean for key in sorted(set(keys))}

    comparable = [result for result in results if not math.isnan(result.deviation)]
    least = min(comparable, key=lambda result: result.deviation) if comparable else None
    return Conclusion(best, least, any(0 < result.agreeing == result.comparable for result in best), missed,
                      scores([result.reading for result in results]), scores([result.preparation for result in results]))
