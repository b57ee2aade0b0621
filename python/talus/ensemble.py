"""An ensemble: many runs of one scenario in a folder, and the numbers that each has given."""

import os
import re
import tomllib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple, NoReturn

import numpy as np

from talus.checked_file import read_text, text_hash
from talus.errors import Error, WrongType, check_text, short
from talus.manifest import is_sealed
from talus.optional import need
from talus.places import numbers_at_places
from talus.run import Run, as_path
from talus.run import open as open_run
from talus.schema import DATA_SETS
from talus.table import numbered
from talus.units import Units, check_units

FIRST_LINE = "talus ensemble 1"
#: Types and shapes of what there is one of in a run, one for each threshold, or one for each strain.
NUMBERS = tuple(("float64", shape) for shape in ("", "F", "2"))
#: What a run finds by itself, with the unit in which members have it.
FOUND = {"theta_r": "deg", "unconverged_steps_deposition": "1", "unconverged_steps": "1"}
MOST_SEEDS = 10000
MOST_VARIANTS = 10000
LARGEST_SEED = 2**63 - 1
LONGEST_NAME = 255  # bytes, of a folder
#: As "theta_c:0.2": a number of a run, and the standard error that is asked of its mean.
PRECISION = re.compile(r"[\w/]+(?:@\w+)?(\[\d+\])?:((\d+\.?\d*|\.\d+)(e[-+]?\d+)?|inf(inity)?)", re.IGNORECASE | re.ASCII)


class Mean(NamedTuple):
    """A mean over members, as Talus computes it; values that are NaN do not count."""

    count: int
    mean: float  #: NaN for count 0
    deviation: float  #: standard deviation, with n - 1; NaN for count < 2
    error: float  #: standard error of the mean, deviation / sqrt(n); NaN for count < 2


def mean_of(values: Sequence[float] | np.ndarray) -> Mean:
    """The mean of values, and how well it is known."""
    try:
        numbers = np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        numbers = np.array(np.nan)
    if numbers.ndim != 1:
        raise WrongType(f"mean_of({short(values)}): expected a sequence of numbers")
    numbers = numbers[~np.isnan(numbers)]
    count = len(numbers)
    deviation = float(numbers.std(ddof=1)) if count > 1 else np.nan
    return Mean(count, float(numbers.mean()) if count else np.nan, deviation, deviation / max(count, 1) ** 0.5)


@dataclass(frozen=True)
class Member:
    """One run of an ensemble."""

    variant: str  #: "contact.friction=0.3"; empty where nothing varies
    seed: int
    path: Path  #: of its run file
    stage: str  #: "done", "failed", "claimed" (under way, or left by a worker) or "waiting"
    state_hash: str = ""  #: of its last state, once it is done; so are the following
    version: str = ""  #: of the Talus that computed it
    seconds: float = np.nan  #: of its steps
    numbers: dict[str, float] = field(default_factory=dict)  #: of its run and analysis, by name; NaN: no value
    units: dict[str, str] = field(default_factory=dict)  #: of the numbers: "deg", "D", "1", ...

    def open(self, units: Units = "SI") -> Run:
        """The run, as talus.open gives it; without frames where the ensemble does not keep them. Throws Error where it
        is not there, before it has begun."""
        return open_run(self.path, units)


def read_member(variant: str, seed: int, path: Path, scenario_of: Callable[[str], dict[str, Any]], bed: str = "") -> Member:
    """What the run file of a member, or what lies beside it, tells of it. `scenario_of`: gives that of a variant; `bed`: the
    hash of its bed, if that is known. Throws as talus.open does, and Error where the run is that of another member, or its
    analysis is not one that this package reads."""
    if not path.is_file():
        failed = path.with_suffix(".failed").is_file()
        claimed = any(path.parent.glob(path.stem + ".claim-*"))
        return Member(variant, seed, path, "failed" if failed else "claimed" if claimed else "waiting")
    with open_run(path, "D") as run:
        check_owner(run, seed, scenario_of(variant), bed)
        numbers, units = numbers_of(run)
        timing = sum(run["provenance/timing/" + stage] for stage in ("deposition", "tilt"))
        version = "{version} ({git_hash})".format_map({"version": "unknown", "git_hash": "unknown", **run.provenance})
        return Member(variant, seed, path, "done", run["checkpoint/state_hash"], version, timing, numbers, units)


def check_owner(run: Run, seed: int, scenario: dict[str, Any], bed: str) -> None:
    """Throws Error where a run is not that of a member. What earlier versions did not have in a scenario is left out."""
    sections = {name: (keys, run.scenario.get(name)) for name, keys in scenario.items()}
    differing = [f"{name}.{key}" for name, (keys, known) in sections.items()
                 if isinstance(keys, dict) and isinstance(known, dict)
                 for key, value in keys.items() if known.get(key, value) != value]
    if run.seed != seed:
        differing.append(f"seed {run.seed}")
    if bed and run.provenance.get("bed_hash", bed) != bed:
        differing.append("its bed")
    if differing:
        raise Error(f"{run.path}: is a run of another member ({', '.join(differing)}); remove it, and `talus ensemble` "
                    "computes the member again")


def numbers_of(run: Run) -> tuple[dict[str, float], dict[str, str]]:
    """What there is one of in a run, or one for each threshold: of its analysis, and what it found by itself; with the
    units. Nothing of a run that is not analysed yet."""
    numbers: dict[str, float] = {}
    units: dict[str, str] = {}
    if not run.storage.has("analysis/version"):
        return numbers, units
    for path, field_of_path in DATA_SETS.items():
        name = path.removeprefix("analysis/")
        if path != name and field_of_path[:2] in NUMBERS and name in run.analysis:
            for k, value in enumerate(np.atleast_1d(run.analysis[name])):
                numbers[numbered(name, k)] = float(value)
                units[numbered(name, k)] = run.analysis.unit(name)
    for name, (value, unit) in numbers_at_places(run).items():
        numbers[name], units[name] = value, unit
    for name, unit in FOUND.items():
        numbers[name], units[name] = run.results.get(name, np.nan), unit
    return numbers, units


class Ensemble:
    """The members of an ensemble at the time when it was opened.

        ensemble = talus.open_ensemble("runs/friction")
        ensemble.variants, ensemble.mean("theta_c", "contact.friction=0.3")
        for member in ensemble.done():
            with member.open() as run: ...

    Numbers are those of `members.csv`, by the names and in the units of its columns: angles in deg, lengths in D."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.version = ""  #: of the Talus that began it
        self.until = ""  #: the precision that was asked for; empty: none
        self.keep = "all"  #: whose frames stay: of "all", "analysis" (of none), or of so many seeds, the lowest
        self.seeds: list[int] = []
        self.variants: list[str] = []  #: names, as "contact.friction=0.3"; [""] where nothing varies
        #: By the names of variants that were shortened: all of them, as "deposition.file=/beds/dense.csv".
        self.full_names: dict[str, str] = {}
        self._origins: list[dict[str, str]] = []  #: hashes of the scenario and the bed of each variant
        self._read_manifest()
        scenario_of = cache(self.scenario)  # each is read once, where a member of it is done
        #: All of them, by seed, and of each seed by variant.
        self.members = [read_member(variant, seed, folder / variant / f"seed-{seed}.h5", scenario_of, origin.get("bed", ""))
                        for seed in self.seeds for variant, origin in zip(self.variants, self._origins)]
        self._refuse_copies()

    def _read_manifest(self) -> None:
        path = self.folder / "ensemble.manifest"
        if not path.is_file():
            raise Error(f"{self.folder}: no ensemble here; begin one with: talus ensemble SCENARIO --seeds 1-50 -o "
                        f"{self.folder}")
        try:
            text = read_text(path)
        except (ValueError, OSError):
            refuse_manifest(path)
        lines = text.split("\n")[:-1]
        if not lines or lines[0] != FIRST_LINE or not is_sealed(text):
            refuse_manifest(path)
        for number, line in enumerate(lines[1:], 2):
            kind, _, rest = line.partition(" ")
            try:
                self._take_line(kind, rest)
            except (IndexError, ValueError) as error:
                refuse_manifest(path, f", in line {number}: {line!r} ({error})")
        if not self.seeds or not self.variants:
            refuse_manifest(path)

    def _take_line(self, kind: str, rest: str) -> None:
        """Adds what a line of the manifest says. Throws ValueError where talus writes no such line."""
        if kind == "version":
            self.version = rest
        elif kind == "until":
            self.until = check_precision(rest)
        elif kind == "keep":
            self.keep = check_keep(rest)
        elif kind == "seeds":
            self.seeds = parse_seeds(rest)
        elif kind == "variant":
            scenario, _, name = rest.partition(" ")
            check_name(name, self.variants)
            self.variants.append(name)
            self._origins.append({"scenario": scenario})
        elif kind == "full":
            self.full_names[self.variants[-1]] = rest
        elif kind == "bed":
            self._origins[-1]["bed"] = rest
        elif kind not in ("task", "hash"):
            raise ValueError(f"there is no {short(kind)}")

    def _refuse_copies(self) -> None:
        """Throws Error where two seeds of a variant have one state hash, but for the bed of a file: nothing is random there."""
        first: dict[tuple[str, str], Member] = {}
        for member in self.done():
            other = first.setdefault((member.variant, member.state_hash), member)
            if other is not member and not self._has_bed_of_file(member.variant):
                raise Error(f"{other.path} and {member.path} have the same state_hash, which two seeds never have: one "
                            "is a copy")

    def _has_bed_of_file(self, variant: str) -> bool:
        deposition = self.scenario(variant).get("deposition")
        return isinstance(deposition, dict) and deposition.get("method") == "file"

    def __repr__(self) -> str:
        return f"<ensemble {self.folder}: {len(self.done())} of {len(self.members)} members done>"

    def scenario(self, variant: str | None = None) -> dict[str, Any]:
        """The scenario of a variant with every key, in its own units; the seed is that of the first member. Throws Error
        where its file is not there, or was changed since the ensemble began."""
        variant = self._variant(variant)
        path = self.folder / "scenarios" / f"{variant or 'scenario'}.toml"
        try:
            text = read_text(path)
            if text_hash(text) != self._origins[self.variants.index(variant)]["scenario"]:
                raise Error(f"{path}: was changed since the ensemble began; expected the scenario that it was made with: "
                            "undo the change, or begin another ensemble with it")
            return tomllib.loads(text)
        except (OSError, ValueError, RecursionError) as error:
            raise Error(f"{path}: cannot be read: {error}") from error

    def done(self, variant: str | None = None) -> list[Member]:
        """The members whose run files are there; of all variants, or of one."""
        chosen = self.variants if variant is None else [self._variant(variant)]
        return [member for member in self.members if member.stage == "done" and member.variant in chosen]

    def numbers(self, name: str, variant: str | None = None) -> np.ndarray:
        """A number of each member of a variant that is done, by seed; NaN where a member has no value. The variant may
        be left out where there is one only. Throws Error where no member has a number of this name."""
        check_text(name, "the number")
        members = self.done(self._variant(variant))
        known = dict.fromkeys(name for member in members for name in member.numbers)
        if members and name not in known:
            raise Error(f"{self.folder}: members have no number {name}; they have {', '.join(known)}")
        return np.array([member.numbers.get(name, np.nan) for member in members])

    def mean(self, name: str, variant: str | None = None) -> Mean:
        """The mean of a number over the members of a variant that are done and have it."""
        return mean_of(self.numbers(name, variant))

    def unit(self, name: str) -> str:
        """The unit of a number: "deg", "D", "1". Throws Error where no member has it."""
        check_text(name, "the number")
        for member in self.done():
            if name in member.units:
                return member.units[name]
        raise Error(f"{self.folder}: members have no number {name}")

    def measure(self, function: Callable[[Run], Any], variant: str | None = None, units: Units = "SI") -> np.ndarray:
        """What a function of your own gives for the run of each member of a variant that is done, by seed; values or
        arrays of one shape."""
        if not callable(function):
            raise WrongType(f"measure({short(function)}): expected a function of a run")
        check_units(units)
        values = []
        for member in self.done(self._variant(variant)):
            with member.open(units) as run:
                values.append(function(run))
        try:
            return np.array(values)
        except ValueError:
            raise Error(f"{self.folder}: the function gives arrays of several shapes; expected one") from None

    def to_pandas(self) -> Any:
        """A DataFrame as `members.csv`: one row for each member that is done, with variant, seed, state_hash, version,
        seconds, and its numbers. Throws ImportError without pandas."""
        rows = [{"variant": m.variant, "seed": m.seed, "state_hash": m.state_hash, "version": m.version,
                 "seconds": m.seconds, **m.numbers} for m in self.done()]
        return need("pandas", "to_pandas()").DataFrame(rows)

    def _variant(self, variant: str | None) -> str:
        if variant is None and len(self.variants) == 1:
            return self.variants[0]
        if not isinstance(variant, str) or variant not in self.variants:
            named = "name a variant" if variant is None else f"has no variant {short(variant)}"
            raise Error(f"{self.folder}: {named}; it has {', '.join(self.variants) or 'none'}")
        return variant


def parse_seeds(text: str) -> list[int]:
    """ "1-3,8": 1, 2, 3, 8, each once. Throws ValueError where the text has another form, or too many seeds or too large
    ones for an ensemble."""
    seeds: set[int] = set()
    for part in text.split(","):
        first, dash, last = part.partition("-")
        if not all(digits.isascii() and digits.isdigit() and len(digits) < 20 for digits in (first, last or first)):
            raise ValueError("expected seeds as 1-3,8")
        begin, end = int(first), int(last if dash else first)
        if end < begin or end > LARGEST_SEED or end - begin >= MOST_SEEDS:
            raise ValueError(f"expected seeds up to {LARGEST_SEED}, at most {MOST_SEEDS}")
        seeds.update(range(begin, end + 1))
        if len(seeds) > MOST_SEEDS:
            raise ValueError(f"expected at most {MOST_SEEDS} seeds")
    return sorted(seeds)


def refuse_manifest(path: Path, reason: str = "") -> NoReturn:
    raise Error(f"{path}: is not what talus wrote{reason}; the runs beside it are not affected: talus.open opens "
                "each") from None


def check_precision(text: str) -> str:
    """The text. Throws ValueError if it has another form than "theta_c:0.2", or asks for no error above 0."""
    found = PRECISION.fullmatch(text)
    if not found or not float(found[2]) > 0:
        raise ValueError("expected a quantity and the standard error asked of its mean, such as theta_c:0.2")
    return text


def check_keep(text: str) -> str:
    """The text. Throws ValueError unless it is "all", "analysis" or a number."""
    is_number = text.isascii() and text.isdigit() and int(text.lstrip("0")[:21] or 0) < 2**64
    if text not in ("all", "analysis") and not is_number:
        raise ValueError("expected all, analysis, or the number of seeds whose runs are kept")
    return text


def check_name(name: str, others: Sequence[str]) -> None:
    """Throws ValueError where the name of a variant is not that of a folder in the one of the ensemble, or one of others."""
    parts = name.split("/") if name else []
    if not name.isprintable() or "\ufffd" in name or any(
            part in ("", ".", "..") or len(part.encode()) > LONGEST_NAME for part in parts):
        raise ValueError("expected a variant whose name is that of a folder in this one")
    if (name or "scenario") in [other or "scenario" for other in others]:
        raise ValueError("expected each name once")
    if len(others) == MOST_VARIANTS:
        raise ValueError(f"expected at most {MOST_VARIANTS} variants")


def open_ensemble(folder: str | Path) -> Ensemble:
    """Opens the folder of an ensemble, whatever of it is done. Throws Error where there is none, or its manifest or the
    run of a member is damaged or that of another."""
    path = as_path(folder)
    try:
        return Ensemble(Path(os.path.abspath(path)))  # another process may be in another folder
    except OSError as error:
        raise Error(f"{short(str(path))}: cannot be opened: {error}") from None
