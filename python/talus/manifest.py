"""Manifest of the folder in which a run is being computed, which lists the valid files."""

from dataclasses import dataclass, field
from pathlib import Path

from talus.checked_file import SEAL, SEAL_SIZE, bytes_hash, open_regular, text_hash
from talus.errors import Error

NAME = "manifest"
FIRST_LINE = "talus run folder 1"


@dataclass(frozen=True)
class StoredFile:
    path: Path
    size: int  #: bytes
    hash: str  #: hash of all bytes, 16 hexadecimal digits
    sizes: dict[str, int] = field(default_factory=dict)  #: row counts of a segment, by the letters of the shapes


@dataclass(frozen=True)
class Manifest:
    header: StoredFile
    checkpoint: StoredFile
    segments: list[StoredFile]


def hides_packed(text: str, packed: Path) -> bool:
    """Whether the name of the run stands for the folder with this manifest and not for the packed file: it has not been
    packed into this file, which it replaces, or which is no run."""
    if not text:
        return False
    try:
        with open_regular(packed) as file:
            begin = file.read(SEAL_SIZE)
    except (OSError, Error):
        return True
    for line in text.split("\n"):
        if line.startswith("packed "):
            return line != "packed " + bytes_hash(begin)
    return "\nreplaces the packed file\n" in text or not begin.startswith(SEAL)


def is_sealed(text: str) -> bool:
    """Whether the last line is the hash of all lines before it."""
    body, _, seal = text.rpartition("hash ")
    return text.endswith("\n") and seal == text_hash(body) + "\n"


def stored_file(folder: Path, words: list[str]) -> StoredFile:
    """Parses the line of a file: "header header.h5 SIZE HASH", with row counts for a segment. Raises ValueError for an
    invalid line."""
    kind, name, size, hash_text, *counts = words
    if not name.endswith(".h5") or "/" in name or len(counts) != (4 if kind == "segment" else 0):
        raise ValueError
    return StoredFile(folder / name, int(size), hash_text, dict(zip("TMRS", map(int, counts))))


def parse_manifest(text: str, folder: Path) -> Manifest:
    """Parses a manifest. Raises Error if it was not written by Talus, is of another version, or names a file outside
    its folder."""
    lines = text.split("\n")
    if lines[0] != FIRST_LINE:
        raise Error(f"{folder / NAME}: begins with {lines[0]!r}, expected {FIRST_LINE!r}: it is damaged, "
                    "or was written by another version of Talus")
    kinds = ("header", "checkpoint", "segment")
    try:
        if not is_sealed(text):
            raise ValueError
        files = [(line.split()[0], stored_file(folder, line.split())) for line in lines if line.startswith(kinds)]
        [header], [checkpoint], segments = ([file for kind, file in files if kind == each] for each in kinds)
        if len({file.path for _, file in files}) < len(files):
            raise ValueError
    except ValueError:
        raise Error(f"{folder / NAME}: is damaged (its hash does not match its lines, or they name a file that does not "
                    "belong to a run folder); save the intact pieces of the run: talus repair RUN.h5 -o NEW.h5") from None
    return Manifest(header, checkpoint, segments)
