"""Where the data sets of a run lie: in its packed file, or in the folder that it has while it is computed."""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from talus.errors import Error
from talus.manifest import NAME, Manifest, parse_manifest, replaces_packed

SEAL = b"talus run file 1\n"
SERIES = ("frames/", "contacts/", "observables/", "steps/", "commands/")
STATE = ("checkpoint/", "results/", "provenance/timing/")


def find_run(path: Path) -> Path:
    """The packed file of the run called `path`, or its folder while it is being computed. Throws Error where there is
    neither."""
    beside = path.with_name(path.name + ".run")
    if path.is_file() and not replaces_packed(manifest_text(beside)):
        return path
    for folder in (path, beside):
        if (folder / NAME).is_file():
            return folder
    if path.is_file():
        return path
    if (path / "ensemble.manifest").exists():
        raise Error(f"{path}: is the folder of an ensemble: talus.open_ensemble opens it")
    if beside.is_dir() or path.name.endswith(".run") and path.is_dir():
        raise Error(f"{beside if beside.is_dir() else path}: nothing is committed there yet; wait for the first "
                    "checkpoint, or start the command of the run again")
    raise Error(f"{path}: no such run; expected a run file, or a folder {beside}")


def manifest_text(folder: Path) -> str:
    """The manifest of a folder; empty where there is none."""
    try:
        return (folder / NAME).read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""


def check_seal(path: Path) -> None:
    """Throws Error where the first lines of a packed file are not those of a run, or tell of another size. Bytes that
    were changed are noticed by `talus check` only, or when HDF5 cannot read them."""
    with path.open("rb") as file:
        begin = file.read(512)
    if not begin.startswith(SEAL):
        raise Error(f"{path}: is not a Talus run file (it does not begin with {SEAL.decode().strip()!r})")
    words = begin[len(SEAL):].split(b"\n")[0].split()
    size = path.stat().st_size
    if words != [b"size", str(size).encode()]:
        raise Error(f"{path}: is damaged: it has {size} bytes, but its first lines say otherwise; restore it from a "
                    f"copy, or save what is undamaged with: talus repair {path} -o NEW.h5")


class Storage:
    """The data sets of one run by their paths in docs/file_format.md, without the first slash. One file at a time is
    open."""

    def __init__(self, place: Path, manifest: str = "") -> None:
        """`manifest`: the text of the manifest where `place` is a folder."""
        self.place = place
        self.complete = place.is_file()
        self._open_path: Path | None = None
        self._open_file: h5py.File | None = None
        if self.complete:
            check_seal(place)
            self.header = self.state = place
            self.parts = [place]
            self.frames = [len(self._whole(place, "frames/tilt"))]  #: of each part
        else:
            self._take(parse_manifest(manifest, place))

    def _take(self, manifest: Manifest) -> None:
        for file in [manifest.header, manifest.checkpoint, *manifest.segments]:
            if not file.path.is_file():
                raise Error(f"{file.path}: is missing, although the manifest names it")
            if (size := file.path.stat().st_size) != file.size:
                raise Error(f"{file.path}: is damaged: it has {size} bytes, the manifest says {file.size}")
        self.header, self.state = manifest.header.path, manifest.checkpoint.path
        self.parts = [segment.path for segment in manifest.segments]
        self.frames = [segment.frames for segment in manifest.segments]

    def check(self, name: str) -> None:
        """Throws Error where the run has no data set of this name. While it has no segment yet, any series may be."""
        files = self._files_of(name)
        if files and not any(self._holds(path, name) for path in files):
            raise Error(f"{self.place}: has no data set {name}")

    def read(self, name: str) -> Any:
        """All values of a data set; none of a series while the run has no segment. Throws Error where the run has no
        data set of this name."""
        self.check(name)
        values = [self._whole(path, name) for path in self._files_of(name) if self._holds(path, name)]
        if len(values) < 2:
            return values[0] if values else np.zeros(0)
        return joined_offsets(values) if name == "contacts/offset" else np.concatenate(values)

    def read_frame(self, name: str, k: int) -> np.ndarray:
        """What a data set holds of frame k: a row of it, or the contacts of the frame. 0 <= k < sum(frames)."""
        part = 0
        while k >= self.frames[part]:
            k -= self.frames[part]
            part += 1
        path = self.parts[part]
        with self._file(path) as file:
            if name.startswith("contacts/"):
                first, last = file["contacts/offset"][k : k + 2]
                return file[name][first:last]
            return file[name][k]

    def attribute(self, name: str, attribute: str) -> str:
        """A text beside a data set; empty where there is none."""
        for path in self._files_of(name)[:1]:
            with self._file(path) as file:
                return as_text(file[name].attrs.get(attribute, ""))
        return ""

    def help(self, name: str) -> str:
        """What a data set means; empty in a folder, which has no help."""
        with self._file(self.header) as file:
            entry = file.get("help/" + name)
            return as_text(entry[()]) if isinstance(entry, h5py.Dataset) else ""

    def names(self, group: str) -> list[str]:
        """The data sets below a group, in alphabetical order, by their paths from there; none where there is no such
        group."""
        found: list[str] = []
        for path in self._files_of(group + "/")[:1]:
            with self._file(path) as file:
                if group in file:
                    file[group].visititems(lambda name, item: found.append(name) if isinstance(item, h5py.Dataset) else None)
        return found

    def close(self) -> None:
        if self._open_file is not None:
            self._open_file.close()
        self._open_path = self._open_file = None

    def _files_of(self, name: str) -> list[Path]:
        if name.startswith(SERIES) or name.endswith("/value"):
            return self.parts
        return [self.state if name.startswith(STATE) else self.header]

    def _holds(self, path: Path, name: str) -> bool:
        with self._file(path) as file:
            return isinstance(file.get(name), h5py.Dataset)

    def _whole(self, path: Path, name: str) -> Any:
        with self._file(path) as file:
            value = file[name][()]
            return as_text(value) if isinstance(value, bytes) else value

    @contextmanager
    def _file(self, path: Path) -> Iterator[h5py.File]:
        """The file at `path`. What HDF5 cannot read of it is an Error."""
        try:
            if self._open_path != path:
                self.close()
                self._open_file = open_unlocked(path)
                self._open_path = path
            assert self._open_file is not None
            yield self._open_file
        except FileNotFoundError:
            raise Error(f"{path}: is not there any more: the run has gone on, or is complete, since it was opened; "
                        "open it again") from None
        except BlockingIOError:
            raise Error(f"{path}: another process writes to it; open it when that has ended") from None
        except (OSError, KeyError, RuntimeError, ValueError) as error:
            raise Error(f"{path}: is damaged: {error.args[0] if error.args else error}; restore it from a copy, or "
                        "save what is undamaged with: talus repair RUN.h5 -o NEW.h5") from error


def open_unlocked(path: Path) -> h5py.File:
    """The file, once its writer has let go of it: it keeps its lock for an instant after the file has its name."""
    for _ in range(100):
        try:
            return h5py.File(path, "r")
        except BlockingIOError:
            time.sleep(0.05)
    return h5py.File(path, "r")


def as_text(value: Any) -> str:
    return value.decode("utf-8", "replace").rstrip("\0") if isinstance(value, bytes) else str(value)


def joined_offsets(parts: list[np.ndarray]) -> np.ndarray:
    """The offsets of contacts, which begin at 0 in each part, counted on through all of them."""
    lengths = np.concatenate([np.diff(part) for part in parts])
    return np.concatenate([[0], np.cumsum(lengths)])
