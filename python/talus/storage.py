"""Storage of the data sets of a run: its packed file, or its folder while it is being computed."""

import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from talus.checked_file import (CheckedFile, Identity, as_text, check_seal, check_stored, field_of, read_seal, read_text,
                                require_files)
from talus.errors import Error, FailedFile, MissingFile, MissingName
from talus.manifest import NAME, StoredFile, hides_packed, parse_manifest
from talus.trial_walk import require_walkable

SERIES = ("frames/", "contacts/", "observables/", "steps/", "commands/")
STATE = ("checkpoint/", "results/", "provenance/timing/")


def is_file(path: Path) -> bool:
    """Returns whether there is a file. Raises OSError if the system cannot look, as for a name that is too long; Path.is_file
    of Python 3.14 returns False then."""
    try:
        return stat.S_ISREG(path.stat().st_mode)
    except (FileNotFoundError, NotADirectoryError, ValueError):  # the last for text that cannot be a name
        return False


def find_run(path: Path) -> Path:
    """Returns the packed file of the run called `path`, or its folder while it is being computed. Raises Error if
    neither exists."""
    folder_of_run = path.parent / (path.name + ".run")
    if is_file(path) and not hides_packed(manifest_text(folder_of_run), path):
        return path
    for folder in (path, folder_of_run):
        if (folder / NAME).is_file():
            return folder
    if path.is_file():
        return path
    if (path / "ensemble.manifest").exists():
        raise Error(f"{path}: is the folder of an ensemble; open it with talus.open_ensemble")
    if folder_of_run.is_dir() or path.name.endswith(".run") and path.is_dir():
        raise MissingFile(f"{folder_of_run if folder_of_run.is_dir() else path}: nothing is committed there yet; wait for the first "
                    "checkpoint, or repeat the command of the run")
    raise MissingFile(f"{path}: no such run; expected a run file, or a folder {folder_of_run}")


def manifest_text(folder: Path) -> str:
    """Returns the manifest of a folder; empty if there is none."""
    try:
        return read_text(folder / NAME)
    except OSError:
        return ""


class Storage:
    """The data sets of one run by their paths in docs/file_format.md, without the first slash. One file is open at a
    time, and each file is compared with its hash before it is first read."""

    def __init__(self, place: Path, manifest: str = "", known: tuple[bytes, Identity] | None = None) -> None:
        """`manifest`: text of the manifest if `place` is a folder. `known`: seal and identity of a packed file whose
        hash was already checked."""
        self.place = place
        #: Absolute path, which stays valid if the process changes its folder.
        self.absolute = place = Path(os.path.abspath(place))
        self.complete = place.is_file()
        self._open_file: CheckedFile | None = None
        self._identities: dict[Path, Identity] = {}
        #: Mark that identifies the contents under this name: the seal, or the manifest.
        self.mark: bytes = manifest.encode("utf-8", "surrogateescape")
        if self.complete:
            with reported_as_damage(place):
                self.mark, self._identities[place] = known if known and read_seal(place) == known else check_seal(place)
            self._stored = {place: StoredFile(place, 0, "")}
            self.header = self.state = place
            self.parts = [place]
        else:
            files = parse_manifest(manifest, place)
            self._stored = {file.path: file for file in (files.header, files.checkpoint, *files.segments)}
            for path in self._stored:
                if not os.path.isfile(path):  # raises no OSError if the whole path is too long
                    raise MissingFile(f"{path}: is missing, although the manifest names it")
            self.header, self.state = files.header.path, files.checkpoint.path
            self.parts = [segment.path for segment in files.segments]
        with self._file(self.header) as file:
            self.grains = file.rows("particles/grains/species")
        self.frames = [self._rows(path, "frames/tilt") for path in self.parts]  #: number in each part

    @property
    def known(self) -> tuple[bytes, Identity] | None:
        """Value of `known` for another Storage of the same packed file."""
        return (self.mark, self._identities[self.absolute]) if self.complete else None

    def has(self, name: str) -> bool:
        """Whether a file of the run has the data set; true for any series while the run has no segment yet."""
        files = self._files_of(name)
        return field_of(name) is not None and (not files or any(self._holds(path, name) for path in files))

    def check(self, name: str) -> None:
        """Raises Error if the run has no data set of this name."""
        if not self.has(name):
            raise Error(f"{self.place}: has no data set {name}")

    def read(self, name: str) -> Any:
        """Returns all values of a data set; none for a series while the run has no segment. Raises Error if the run has
        no data set of this name, or if it does not agree with the table of data sets."""
        self.check(name)
        # Segments without contacts have no moments; all other data sets are in each segment.
        holds = self._holds if name == "contacts/moment" else lambda *_: True
        values = [self._whole(path, name) for path in self._files_of(name) if holds(path, name)]
        if len(values) < 2:
            return values[0] if values else np.zeros(0)
        with reported_as_damage(self.place):
            return joined_offsets(values) if name == "contacts/offset" else np.concatenate(values)

    def read_frame(self, name: str, k: int) -> np.ndarray:
        """Returns the values of a data set for frame k: a row of it, or the contacts of the frame. 0 <= k <
        sum(frames)."""
        if field_of(name) is None:
            raise MissingName(f"{self.place}: has no data set {name}")
        part = 0
        while k >= self.frames[part]:
            k -= self.frames[part]
            part += 1
        with self._file(self.parts[part]) as file:
            if name.startswith(("contacts/", "own/contacts/")):
                first, last = file.read("contacts/offset", k, 2).tolist()
                rows = file.rows("contacts/pair")
                if not 0 <= first <= last <= rows:
                    raise file.refuse("contacts/offset", f"does not ascend within the {rows} contacts")
                return file.read(name, first, last - first)
            return file.read(name, k, 1)[0]

    def unit(self, name: str) -> str:
        field = field_of(name)
        return field[2] if field else ""

    def meaning(self, name: str) -> str:
        """Returns the definition of a data set; empty if no file states it."""
        for path in self._files_of(name)[:1]:
            with self._file(path) as file:
                if text := file.definition(name):
                    return text
        with self._file(self.header) as file:
            return as_text(file.read("help/" + name)) if file.has("help/" + name) else ""

    def names(self, group: str) -> list[str]:
        """Returns the data sets below a group in alphabetical order, by their paths relative to it; none if the group
        does not exist."""
        for path in self._files_of(group + "/")[:1]:
            with self._file(path) as file:
                return file.names(group)
        return []

    def close(self) -> None:
        if self._open_file is not None:
            self._open_file.close()
        self._open_file = None

    def _files_of(self, name: str) -> list[Path]:
        if name.startswith(SERIES) or name.endswith("/value"):
            return self.parts
        return [self.state if name.startswith(STATE) else self.header]

    def _holds(self, path: Path, name: str) -> bool:
        with self._file(path) as file:
            return file.has(name)

    def _rows(self, path: Path, name: str) -> int:
        with self._file(path) as file:
            return file.rows(name)

    def _whole(self, path: Path, name: str) -> Any:
        with self._file(path) as file:
            values = file.read(name)
            if name == "contacts/offset" and (values[0] != 0 or np.any(np.diff(values) < 0)):
                raise file.refuse(name, "does not ascend from 0")
            return as_text(values) if isinstance(values, bytes) else values

    def _opened(self, path: Path) -> CheckedFile:
        if self._open_file is not None and self._open_file.path == path:
            return self._open_file
        self.close()
        stored = self._stored[path]
        if path not in self._identities:
            self._identities[path] = check_stored(path, stored.size, stored.hash)
        sizes = stored.sizes | ({"N": self.grains} if path in self.parts and not self.complete else {})
        require_walkable(path, self._identities[path])
        self._open_file = CheckedFile(path, self._identities[path], sizes)
        return self._open_file

    @contextmanager
    def _file(self, path: Path) -> Iterator[CheckedFile]:
        """Yields the file at `path`; failures to read it are raised as Error."""
        require_files()
        with reported_as_damage(path):
            yield self._opened(path)


def unreadable(path: Path | str, error: Exception) -> Error:
    """Returns the error for a file or folder that cannot be opened."""
    reason = error.strerror if isinstance(error, OSError) and error.strerror else error
    failed = FailedFile(f"{path}: cannot be opened: {reason}")
    failed.exit_code = MissingFile.exit_code
    return failed


@contextmanager
def reported_as_damage(path: Path) -> Iterator[None]:
    """Converts everything that a file can raise in h5py and numpy to Error."""
    try:
        yield
    except Error:
        raise
    except FileNotFoundError:
        raise MissingFile(f"{path}: no longer exists: the run has continued or was completed since it was opened; "
                    "open it again") from None
    except PermissionError as error:
        raise unreadable(path, error) from None
    except MemoryError:
        raise Error(f"{path}: out of memory while it was read; if enough memory is available, the file is malformed") from None
    except Exception as error:
        raise Error(f"{path}: is damaged: {error.args[0] if error.args else error}; restore it from a copy, or "
                    "save its intact pieces with: talus repair RUN.h5 -o NEW.h5") from error


def joined_offsets(parts: list[np.ndarray]) -> np.ndarray:
    """Returns the offsets of contacts, which start at 0 in each part, as offsets into all parts together."""
    lengths = np.concatenate([np.diff(part) for part in parts])
    return np.concatenate([[0], np.cumsum(lengths)])
