"""Safe reading of untrusted files: bytes must match the hash stored when they were written. Only HDF5 data sets in the
table of run files are read, if they are in the file itself and no larger than it can hold."""

import os
import stat
import sys
from math import prod
from pathlib import Path
from typing import Any, BinaryIO

import h5py
import numpy as np
import xxhash

from talus.errors import Error
from talus.schema import DATA_SETS

SEAL = b"talus run file 1\n"
SEAL_SIZE = 512
READ_SIZE = 1 << 20
#: Maximum size of a text file, bytes; the manifest of a run with a million segments is smaller.
MAX_TEXT = 1 << 27
#: Maximum number of values read at once: 4 GiB of doubles.
MAX_VALUES = 1 << 29
#: Maximum compression ratio of deflate.
MAX_DEFLATION = 1032
#: Filters accepted: deflate, shuffle, and checksums. For any other filter HDF5 would load a plugin library.
FILTERS = (h5py.h5z.FILTER_DEFLATE, h5py.h5z.FILTER_SHUFFLE, h5py.h5z.FILTER_FLETCHER32)
TYPES = {"float32": h5py.h5t.IEEE_F32LE, "float64": h5py.h5t.IEEE_F64LE, "int8": h5py.h5t.STD_I8LE,
         "int32": h5py.h5t.STD_I32LE, "int64": h5py.h5t.STD_I64LE, "uint64": h5py.h5t.STD_U64LE}
#: Identity of a file whose bytes were checked: device, inode, size and time of the last change.
Identity = tuple[int, int, int, int]


def require_files() -> None:
    """Raises Error in a process that was forked while another thread was using Talus, where HDF5 would wait for ever."""
    extension = sys.modules.get("talus._core")
    if extension is not None:
        extension._require_files()


def open_regular(path: Path) -> BinaryIO:
    """Opens a regular file for reading, without waiting for the other end of a pipe. Raises OSError, or Error if it is
    not regular."""
    descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_CLOEXEC", 0))
    if not stat.S_ISREG(os.fstat(descriptor).st_mode):
        os.close(descriptor)
        raise Error(f"{path}: is not a regular file")
    return os.fdopen(descriptor, "rb")


def read_text(path: Path) -> str:
    """Reads a small text file. Raises OSError, or Error if it is not regular or too large."""
    with open_regular(path) as file:
        if (size := os.fstat(file.fileno()).st_size) > MAX_TEXT:
            raise Error(f"{path}: has {size} bytes, more than such a file can have")
        return file.read(size).decode("utf-8", "surrogateescape")


def bytes_hash(data: bytes) -> str:
    """Returns a hash in the format of Talus: 16 hexadecimal digits."""
    return xxhash.xxh3_64_hexdigest(data)


def text_hash(text: str) -> str:
    return bytes_hash(text.encode("utf-8", "surrogateescape"))


def identity_of(descriptor: int) -> Identity:
    status = os.fstat(descriptor)
    return status.st_dev, status.st_ino, status.st_size, status.st_mtime_ns


def hash_of_rest(file: BinaryIO) -> str:
    hasher = xxhash.xxh3_64()
    while block := file.read(READ_SIZE):
        hasher.update(block)
    return hasher.hexdigest()


def read_seal(path: Path) -> tuple[bytes, Identity]:
    """Returns the first lines of a packed file and its identity. Raises OSError, or Error if it is not a run."""
    with open_regular(path) as file:
        begin = file.read(SEAL_SIZE)
        identity = identity_of(file.fileno())
    if not begin.startswith(SEAL):
        raise Error(f"{path}: is not a Talus run file (it does not begin with {SEAL.decode().strip()!r})")
    return begin, identity


def check_seal(path: Path) -> tuple[bytes, Identity]:
    """Raises Error if the bytes of a packed file do not match its first lines, the seal. Returns the seal and the
    identity of the file."""
    begin, identity = read_seal(path)
    with open_regular(path) as file:
        file.seek(SEAL_SIZE)
        size = identity[2]
        said = begin[len(SEAL):].split(b"\n")[0]
        # Compares the size first, so that a truncated file is detected without reading it.
        seal = b"%ssize %d\nxxh3 of all after byte 512 %s\n" % (
            SEAL, size, hash_of_rest(file).encode() if said == b"size %d" % size else b"")
        if begin != seal.ljust(SEAL_SIZE, b"\0") or identity_of(file.fileno()) != identity:
            raise Error(f"{path}: is damaged: it has {size} bytes, but its first lines say otherwise, or have another "
                        f"hash; restore it from a copy, or save its intact pieces with: talus repair {path} -o NEW.h5")
    return begin, identity


def check_stored(path: Path, size: int, expected: str) -> Identity:
    """Raises Error if a file does not have the size and hash stated in the manifest of its folder. Returns its
    identity."""
    hint = "; save its intact pieces with: talus repair RUN.h5 -o NEW.h5"
    with open_regular(path) as file:
        identity = identity_of(file.fileno())
        if identity[2] != size:
            raise Error(f"{path}: is damaged: it has {identity[2]} bytes, the manifest says {size}{hint}")
        if (found := hash_of_rest(file)) != expected:
            raise Error(f"{path}: is damaged: its hash is {found}, the manifest says {expected}{hint}")
    return identity


def open_unlocked(path: Path) -> tuple[h5py.File, Identity]:
    """Opens a file and returns it with its identity, regardless of locks, because a file under its final name is
    complete. Opens it first with the default settings of h5py, because HDF5 refuses to open one file in one process
    with different lock settings."""
    for options in ({}, {"locking": False}):
        try:
            file = h5py.File(path, "r", **options)
            return file, identity_of(file.id.get_vfd_handle())
        except FileNotFoundError:
            raise
        except (OSError, TypeError, ValueError):  # no lock; h5py before 3.5, or HDF5 before 1.10.7
            continue
    stream = open_regular(path)
    return h5py.File(stream, "r"), identity_of(stream.fileno())


def is_encodable(name: str) -> bool:
    """Whether a text can be a name in a file: not if it contains lone surrogates, apart from those by which Python
    represents bytes that are not UTF-8."""
    try:
        name.encode("utf-8", "surrogateescape")
        return True
    except UnicodeEncodeError:
        return False


def field_of(name: str) -> tuple[str, str, str] | None:
    """Returns type, shape and unit of a data set by its path without the first slash; None if run files have no such
    data set. Texts below /help are not in the table."""
    if name in DATA_SETS:
        return DATA_SETS[name]
    group, _, last = name.rpartition("/")
    if last in ("", ".", "..") or "\0" in name or not is_encodable(name):
        return None
    if group.partition("/")[0] == "help":
        return "text", "", "1"
    return DATA_SETS.get(group + "/*")


class CheckedFile:
    """An open HDF5 file."""

    def __init__(self, path: Path, identity: Identity, sizes: dict[str, int]) -> None:
        """`identity`: identity of the file whose bytes were checked. `sizes`: known values of the letters of shapes."""
        self.path = path
        self._file, opened = open_unlocked(path)
        self._size = identity[2]
        self._sizes = {"": dict(sizes), "analysis": {"N": sizes["N"]} if "N" in sizes else {}}
        self._sets: dict[str, h5py.h5d.DatasetID] = {}
        if opened != identity:
            self.close()
            raise Error(f"{path}: has changed since it was opened; open it again")

    def close(self) -> None:
        self._sets.clear()
        self._file.close()

    def refuse(self, name: str, problem: str) -> Error:
        return Error(f"{self.path}: data set /{name} {problem}")

    def has(self, name: str) -> bool:
        """Whether the file has an object of this name, of any kind."""
        return name in self._sets or self._find(name) is not None

    def rows(self, name: str) -> int:
        return int(self._open(name).shape[0])

    def read(self, name: str, first: int = 0, count: int | None = None) -> Any:
        """Returns all values of a data set, or those of some rows, or the bytes of a text. Raises Error if it does not
        agree with the table of run files."""
        data_set = self._open(name)
        shape = data_set.shape
        if shape and count is not None:
            if not 0 <= first <= first + count <= shape[0]:
                raise self.refuse(name, f"has {shape[0]} rows; row {first + count} was requested")
            shape = (count, *shape[1:])
        if prod(shape) > MAX_VALUES:
            raise self.refuse(name, f"has {prod(shape)} values, more than can be read at once; read it frame by frame")
        values = h5py.Dataset(data_set)
        return values[()] if not shape else values[first : first + shape[0]]

    def definition(self, name: str) -> str:
        """Returns the definition stored with a data set; empty if there is none."""
        data_set = self._open(name)
        if not h5py.h5a.exists(data_set, b"definition"):
            return ""
        attribute = h5py.h5a.open(data_set, b"definition")
        kind = attribute.get_type()
        if not is_fixed_text(kind) or attribute.shape != ():
            raise self.refuse(name, "has a definition that is not text")
        text = np.empty((), dtype=f"S{kind.get_size()}")
        attribute.read(text, mtype=kind)
        return as_text(text[()])

    def names(self, group: str) -> list[str]:
        """Returns the data sets below a group that are both in the table and in the file, by their paths relative to
        the group."""
        below = [name for name in DATA_SETS if name.startswith(group + "/")]
        found = {name for name in below if not name.endswith("/*") and self.has(name)}
        for parent in (name[:-2] for name in below if name.endswith("/*")):
            found |= {f"{parent}/{child}" for child in self._children(parent)}
        return sorted((name[len(group) + 1 :] for name in found), key=lambda name: name.split("/"))

    def _children(self, group: str) -> list[str]:
        """Returns the names in a group except those of subgroups."""
        parent = self._find(group)
        if not isinstance(parent, h5py.h5g.GroupID):
            return []
        names = [name.decode("utf-8", "surrogateescape") for name in parent]
        return [name for name in names if not isinstance(self._find(f"{group}/{name}", links=True), h5py.h5g.GroupID)]

    def _find(self, name: str, links: bool = False) -> Any:
        """Returns the object at a path; None if there is none. Raises Error if the path contains a link, because links
        are not followed; with `links` a link gives None."""
        here = h5py.h5g.open(self._file.id, b"/")
        for part in name.split("/"):
            key = part.encode("utf-8", "surrogateescape")
            if not isinstance(here, h5py.h5g.GroupID) or not here.links.exists(key):
                return None
            if here.links.get_info(key).type != h5py.h5l.TYPE_HARD:
                if links:
                    return None
                raise self.refuse(name, "is a link to another place, which is not followed")
            here = h5py.h5o.open(here, key)
        return here

    def _open(self, name: str) -> h5py.h5d.DatasetID:
        if name not in self._sets:
            self._sets[name] = self._checked(name)
        return self._sets[name]

    def _checked(self, name: str) -> h5py.h5d.DatasetID:
        found, field = self._find(name), field_of(name)
        if found is None or field is None:
            raise self.refuse(name, "is missing")
        if not isinstance(found, h5py.h5d.DatasetID):
            raise self.refuse(name, "is not a data set")
        kind, expected = found.get_type(), field[0]
        if not (is_fixed_text(kind) if expected == "text" else TYPES[expected].equal(kind)):
            raise self.refuse(name, f"is not of the type {expected}")
        layout = found.get_create_plist()
        if layout.get_layout() == h5py.h5d.VIRTUAL or layout.get_external_count() > 0:
            raise self.refuse(name, "has its values in another file")
        if any(layout.get_filter(i)[0] not in FILTERS for i in range(layout.get_nfilters())):
            raise self.refuse(name, "is compressed by a filter that Talus does not use")
        if found.get_space().get_simple_extent_type() == h5py.h5s.NULL:
            raise self.refuse(name, "has no shape")
        self._check_shape(name, field[1], found.shape)
        chunk = layout.get_chunk() if layout.get_layout() == h5py.h5d.CHUNKED else ()
        if max(prod(found.shape), prod(chunk)) * kind.get_size() > MAX_DEFLATION * self._size:
            raise self.refuse(name, f"of shape {list(found.shape)} is larger than the file can hold")
        return found

    def _check_shape(self, name: str, expected: str, shape: tuple[int, ...]) -> None:
        """Compares a shape with "T+1", "T N 2": a letter has the same value in all data sets, separately for the
        analysis."""
        sizes = self._sizes["analysis" if name.startswith("analysis/") else ""]
        extents = expected.split()
        fits = len(extents) == len(shape)
        for extent, size in zip(extents, shape):
            letter, _, more = extent.partition("+") if extent[0].isalpha() else ("", "", extent)
            rest = size - int(more or 0)
            fits = fits and rest >= 0 and (sizes.setdefault(letter, rest) == rest if letter else rest == 0)
        if not fits:
            known = ", ".join(f"{letter} = {size}" for letter, size in sizes.items() if letter in expected)
            raise self.refuse(name, f"has shape {list(shape)}, expected [{expected}]{known and ' with ' + known}")


def is_fixed_text(kind: h5py.h5t.TypeID) -> bool:
    return isinstance(kind, h5py.h5t.TypeStringID) and not kind.is_variable_str()


def as_text(value: bytes) -> str:
    return value.decode("utf-8", "replace").split("\0")[0]
