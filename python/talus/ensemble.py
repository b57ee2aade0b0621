"""Ensembles: many runs of one scenario in a folder, and the results of each."""

import json
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
from talus.errors import Closed, Error, MissingFile, MissingName, WrongType, WrongValue, check_text, short, suggestion
from talus.optional import need
from talus.places import numbers_at_places
from talus.run import Run, as_path
from talus.run import open as open_run
from talus.schema import DATA_SETS
from talus.storage import is_file, unreadable
from talus.table import numbered
from talus.units import Units, check_units

FORMAT = "talus ensemble 2"
EARLIER_LINE = "talus ensemble 1\n"  # of manifests that were no JSON
#: Types and shapes of the scalars of a run, with one value per run, threshold or strain.
NUMBERS = tuple(("float64", shape) for shape in ("", "F", "2"))
#: Results of a run that need no analysis, with their units in the table of members.
FOUND = {"theta_r": "deg", "unconverged_steps_deposition": "1", "unconverged_steps": "1"}
MOST_SEEDS = 10000
MOST_VARIANTS = 10000
LARGEST_SEED = 2**63 - 1
LONGEST_NAME = 255  # bytes, for a folder
#: Syntax of "theta_c:0.2": a number of a run, and the required standard error of its mean.
PRECISION = re.compile(r"[\w/]+(?:@\w+)?(\[\d+\])?:((\d+\.?\d*|\.\d+)(e[-+]?\d+)?|inf(inity)?)", re.IGNORECASE | re.ASCII)


class Mean(NamedTuple):
    """Mean over members, as computed by Talus; NaN values do not count."""

    count: int
    mean: float  #: NaN for count 0
    deviation: float  #: standard deviation, with n - 1; NaN for count < 2
    error: float  #: standard error of the mean, deviation / sqrt(n); NaN for count < 2


def mean_of(values: Sequence[float] | np.ndarray) -> Mean:
    """Returns the mean of values with its standard error."""
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

    variant: str  #: "contact.friction=0.3"; empty without variations
    seed: int
    path: Path  #: run file
    stage: str  #: "done", "failed", "claimed" (under way, or abandoned by a worker) or "waiting"
    state_hash: str = ""  #: hash of its last state; this and the following are set once it is done
    version: str = ""  #: version of Talus that computed it
    seconds: float = np.nan  #: wall time of its steps
    numbers: dict[str, float] = field(default_factory=dict)  #: scalars of its run and analysis, by name; NaN: no value
    units: dict[str, str] = field(default_factory=dict)  #: units of the numbers: "deg", "D", "1", ...

    def open(self, units: Units = "SI") -> Run:
        """Opens the run like talus.open; without frames if the ensemble does not keep them. Raises Error if the run
        does not exist yet."""
        return open_run(self.path, units)


def read_member(variant: str, seed: int, path: Path, scenario_of: Callable[[str], dict[str, Any]], bed: str = "") -> Member:
    """Reads a member from its run file, or its stage from the files next to it. `scenario_of`: returns the scenario of
    a variant; `bed`: the hash of its bed, if known. Raises as talus.open does, and Error if the run belongs to another
    member, or its analysis has a version that this package does not read."""
    if not is_file(path):
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
    """Raises Error if a run does not belong to a member. Keys that earlier versions did not have in a scenario are
    ignored."""
    sections = {name: (keys, run.scenario.get(name)) for name, keys in scenario.items()}
    differing = [f"{name}.{key}" for name, (keys, known) in sections.items()
                 if isinstance(keys, dict) and isinstance(known, dict)
                 for key, value in keys.items() if known.get(key, value) != value]
    if run.seed != seed:
        differing.append(f"seed {run.seed}")
    if run.departures:
        differing.append("not of its scenario alone: " + run.departures[0])
    if bed and run.provenance.get("bed_hash", bed) != bed:
        differing.append("its bed")
    if differing:
        raise Error(f"{run.path}: is a run of another member ({', '.join(differing)}); remove it, and `talus ensemble` "
                    "computes the member again")


def numbers_of(run: Run) -> tuple[dict[str, float], dict[str, str]]:
    """Returns the scalars of a run, and those of each threshold, from its analysis and from its own results, with
    units. Empty for a run without analysis."""
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


class Ensemble(Closed):
    """Members of an ensemble at the time of opening.

        ensemble = talus.open_ensemble("runs/friction")
        ensemble.variants, ensemble.mean("theta_c", "contact.friction=0.3")
        for member in ensemble.done():
            with member.open() as run: ...

    Numbers are those of `members.csv`, with the names and units of its columns: angles in deg, lengths in D."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.version = ""  #: version of Talus that started it
        self.until = ""  #: required precision; empty: none
        self.keep = "all"  #: members whose frames are kept: "all", "analysis" (none), or the number of lowest seeds
        self.seeds: list[int] = []
        self.variants: list[str] = []  #: names such as "contact.friction=0.3"; [""] without variations
        #: Full names of variants with shortened names, e.g. "deposition.file=/beds/dense.csv".
        self.full_names: dict[str, str] = {}
        self._origins: list[dict[str, str]] = []  #: hashes of the scenario and the bed of each variant
        self._read_manifest()
        scenario_of = cache(self.scenario)  # each is read once, if a member of it is done
        #: All members, by seed, and by variant for each seed.
        self.members = [read_member(variant, seed, folder / variant / f"seed-{seed}.h5", scenario_of, origin.get("bed", ""))
                        for seed in self.seeds for variant, origin in zip(self.variants, self._origins)]
        self._refuse_copies()
        self._is_closed = True

    def _read_manifest(self) -> None:
        path = self.folder / "ensemble.manifest"
        if not is_file(path):
            raise MissingFile(f"{self.folder}: no ensemble here; start one with: talus ensemble SCENARIO --seeds 1-50 -o "
                        f"{self.folder}")
        try:
            text = read_text(path)
        except (ValueError, OSError):
            refuse_manifest(path)
        if text.startswith(EARLIER_LINE):
            raise Error(f"{path} was written by an earlier revision of Talus; start another ensemble from its scenario, and move the "
                        "runs there")
        body, key, seal = text.rpartition('"hash": ')
        if seal != f'"{text_hash(body + key)}"\n}}\n':
            refuse_manifest(path)
        try:
            manifest = json.loads(text, object_pairs_hook=object_without_copies)
        except (ValueError, RecursionError):
            refuse_manifest(path)
        place = ""

        def read(part: Any, parent: str, name: str) -> str:
            nonlocal place
            place = parent + name
            if not isinstance(part, dict) or not isinstance(part.get(name), str):
                raise ValueError("expected a text")
            return str(part[name])

        try:
            if read(manifest, "/", "format") != FORMAT:
                raise ValueError(f"expected {FORMAT}: another version of Talus wrote it")
            self.version = read(manifest, "/", "version")
            self.seeds = parse_seeds(read(manifest, "/", "seeds"))
            if until := read(manifest, "/", "until"):
                self.until = check_precision(until)
            if keep := read(manifest, "/", "keep"):
                self.keep = check_keep(keep)
            variants = manifest.get("variants")
            place = "/variants"
            if not isinstance(variants, list) or not variants:
                raise ValueError("expected a list of variants")
            for k, variant in enumerate(variants):
                parent = f"/variants/{k}/"
                check_name(name := read(variant, parent, "name"), self.variants)
                self.variants.append(name)
                if full_name := read(variant, parent, "full_name"):
                    self.full_names[name] = full_name
                self._origins.append({key: read(variant, parent, key) for key in ("scenario", "bed")})
        except ValueError as error:
            refuse_manifest(path, f", at {place}: {error}")

    def _refuse_copies(self) -> None:
        """Raises Error if two seeds of a variant have the same state hash, except for beds from a file, in which nothing
        is random."""
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
        """Returns the scenario of a variant with every key, in the units of the scenario; the seed is that of the first
        member. Raises Error if its file is missing, or has changed since the ensemble was started."""
        variant = self._variant(variant)
        path = self.folder / "scenarios" / f"{variant or 'scenario'}.toml"
        try:
            text = read_text(path)
            if text_hash(text) != self._origins[self.variants.index(variant)]["scenario"]:
                raise Error(f"{path}: has changed since the ensemble was started; expected the original scenario: "
                            "undo the change, or start another ensemble with it")
            return tomllib.loads(text)
        except (OSError, ValueError, RecursionError) as error:
            kind = MissingFile if isinstance(error, FileNotFoundError) else Error
            raise kind(f"{path}: cannot be read: {error}") from error

    def done(self, variant: str | None = None) -> list[Member]:
        """Returns the members with complete runs, of all variants or of one."""
        chosen = self.variants if variant is None else [self._variant(variant)]
        return [member for member in self.members if member.stage == "done" and member.variant in chosen]

    def numbers(self, name: str, variant: str | None = None) -> np.ndarray:
        """Returns a number of each finished member of a variant, by seed; NaN if a member has no value. The variant may
        be omitted if there is only one. Raises Error if no member has a number of this name."""
        check_text(name, "the number")
        members = self.done(self._variant(variant))
        known = dict.fromkeys(name for member in members for name in member.numbers)
        if members and name not in known:
            raise MissingName(f"{self.folder}: members have no number {name}{suggestion(name, known)}")
        return np.array([member.numbers.get(name, np.nan) for member in members])

    def mean(self, name: str, variant: str | None = None) -> Mean:
        """Returns the mean of a number over the finished members of a variant that have it."""
        return mean_of(self.numbers(name, variant))

    def unit(self, name: str) -> str:
        """Returns the unit of a number: "deg", "D", "1". Raises Error if no member has it."""
        check_text(name, "the number")
        for member in self.done():
            if name in member.units:
                return member.units[name]
        raise MissingName(f"{self.folder}: members have no number {name}{suggestion(name, self.quantities)}")

    @property
    def quantities(self) -> list[str]:
        """Names of the numbers of finished members: `ensemble.numbers(name)`."""
        return list(dict.fromkeys(name for member in self.done() for name in member.numbers))

    def measure(self, function: Callable[[Run], Any], variant: str | None = None, units: Units = "SI") -> np.ndarray:
        """Applies a function to the run of each finished member of a variant and returns the results by seed; they must
        be values, or arrays of the same shape."""
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
            raise WrongValue(f"{self.folder}: the function gives arrays of several shapes; expected one") from None

    def settings(self, variant: str | None = None) -> dict[str, Any]:
        """Returns the keys in which the variants differ, with the values of one of them: {"contact.friction": 0.3}.
        Raises Error as `scenario` does."""
        return self._all_settings()[self._variant(variant)]

    def _all_settings(self) -> dict[str, dict[str, Any]]:
        scenarios = {variant: flat(self.scenario(variant)) for variant in self.variants}
        first = scenarios[self.variants[0]]
        varied = [key for key in first if any(each.get(key) != first[key] for each in scenarios.values())]
        return {variant: {key: each.get(key) for key in varied} for variant, each in scenarios.items()}

    def to_pandas(self) -> Any:
        """Returns a DataFrame like `members.csv`, with all digits: one row for each finished member, with variant, the
        keys in which variants differ, seed, state_hash, version, seconds, and its numbers. Raises ImportError without
        pandas."""
        settings = {variant: {key: ", ".join(value) if isinstance(value, list) else value for key, value in each.items()}
                    for variant, each in self._all_settings().items()}
        rows = [{"variant": m.variant, **settings[m.variant], "seed": m.seed, "state_hash": m.state_hash, "version": m.version,
                 "seconds": m.seconds, **m.numbers} for m in self.done()]
        return need("pandas", "to_pandas()").DataFrame(rows)

    def _variant(self, variant: str | None) -> str:
        if variant is None and len(self.variants) == 1:
            return self.variants[0]
        if not isinstance(variant, str) or variant not in self.variants:
            named = "name a variant" if variant is None else f"has no variant {short(variant)}"
            raise MissingName(f"{self.folder}: {named}; it has {', '.join(self.variants) or 'none'}")
        return variant


def flat(scenario: dict[str, Any]) -> dict[str, Any]:
    """Returns the keys of a scenario with their sections, "bed.length"; those of command 1 are "command.1.kind", ...,
    in the order of docs/scenario.md."""
    keys: dict[str, Any] = {}
    for name, value in scenario.items():
        if isinstance(value, list) and name == "command":
            commands = [{"at": "none", "time": "none", "kind": "", "grain": -1, "x": 0.0, "y": 0.0, **each} for each in value]
            keys |= {f"command.{k}.{key}": each for k, command in enumerate(commands, 1) for key, each in command.items()}
        elif isinstance(value, dict):
            keys |= {f"{name}.{key}": each for key, each in value.items()}
        else:
            keys[name] = value
    return keys


def parse_seeds(text: str) -> list[int]:
    """Parses "1-3,8" as 1, 2, 3, 8, each once. Raises ValueError if the text has another form, or too many or too large
    seeds for an ensemble."""
    seeds: set[int] = set()
    for part in text.split(","):
        first, dash, last = part.partition("-")
        if not all(digits.isascii() and digits.isdigit() and len(digits) < 20 for digits in (first, last if dash else first)):
            raise ValueError("expected seeds such as 1-3,8")
        begin, end = int(first), int(last if dash else first)
        if end < begin or end > LARGEST_SEED or end - begin >= MOST_SEEDS:
            raise ValueError(f"expected seeds up to {LARGEST_SEED}, at most {MOST_SEEDS}")
        seeds.update(range(begin, end + 1))
        if len(seeds) > MOST_SEEDS:
            raise ValueError(f"expected at most {MOST_SEEDS} seeds")
    return sorted(seeds)


def object_without_copies(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Returns an object of JSON. Raises ValueError if two of its members have one name."""
    found = dict(pairs)
    if len(found) < len(pairs):
        raise ValueError("expected unique names")
    return found


def refuse_manifest(path: Path, reason: str = "") -> NoReturn:
    raise Error(f"{path}: was not written by talus{reason}; the runs next to it are not affected: open each "
                "with talus.open") from None


def check_precision(text: str) -> str:
    """Returns the text. Raises ValueError if it has another form than "theta_c:0.2", or the error is not above 0."""
    found = PRECISION.fullmatch(text)
    if not found or not float(found[2]) > 0:
        raise ValueError("expected a quantity and the standard error required of its mean, such as theta_c:0.2")
    return text


def check_keep(text: str) -> str:
    """Returns the text. Raises ValueError unless it is "all", "analysis" or a number."""
    is_number = text.isascii() and text.isdigit() and int(text.lstrip("0")[:21] or 0) < 2**64
    if text not in ("all", "analysis") and not is_number:
        raise ValueError("expected all, analysis, or the number of seeds whose runs are kept")
    return text


def check_name(name: str, others: Sequence[str]) -> None:
    """Raises ValueError if the name of a variant is not that of a folder in the ensemble's folder, or is already used."""
    if not name.isprintable() or "\ufffd" in name or "/" in name or name in (".", "..") or len(name.encode()) > LONGEST_NAME:
        raise ValueError("expected a variant whose name is a folder in this one")
    if (name or "scenario") in [other or "scenario" for other in others]:
        raise ValueError("expected unique names")
    if len(others) == MOST_VARIANTS:
        raise ValueError(f"expected at most {MOST_VARIANTS} variants")


def open_ensemble(folder: str | Path) -> Ensemble:
    """Opens the folder of an ensemble, finished or not. Raises Error if there is none, or if its manifest or the run of
    a member is damaged or belongs to another ensemble or member."""
    path = as_path(folder)
    try:
        return Ensemble(Path(os.path.abspath(path)))  # another process may be in another folder
    except Error:
        raise
    except OSError as error:
        raise unreadable(short(str(path)), error) from None
