"""The manifest of the folder in which a run is being computed: which of its files count."""

from dataclasses import dataclass
from pathlib import Path

from talus.errors import Error

NAME = "manifest"
FIRST_LINE = "talus run folder 1"


@dataclass(frozen=True)
class StoredFile:
    path: Path
    size: int  #: bytes
    frames: int = 0  #: of a segment


@dataclass(frozen=True)
class Manifest:
    header: StoredFile
    checkpoint: StoredFile
    segments: list[StoredFile]


def replaces_packed(text: str) -> bool:
    """Whether the run in the folder takes the place of a packed file of its name."""
    return "\nreplaces the packed file\n" in text


def parse_manifest(text: str, folder: Path) -> Manifest:
    """What a manifest says. Throws Error where it is not what talus wrote, or of another version."""
    lines = text.splitlines()
    if not lines or lines[0] != FIRST_LINE:
        raise Error(f"{folder / NAME}: begins with {''.join(lines[:1])!r}, expected {FIRST_LINE!r}: it is damaged, "
                    "or was written by another version of Talus")
    files: dict[str, list[StoredFile]] = {"header": [], "checkpoint": [], "segment": []}
    try:
        for words in (line.split() for line in lines):
            if words[0] in files:
                frames = int(words[4]) if words[0] == "segment" else 0
                files[words[0]].append(StoredFile(folder / words[1], int(words[2]), frames))
        whole = lines[-1].startswith("hash ") and text.endswith("\n")
        [header], [checkpoint] = files["header"], files["checkpoint"]
    except (IndexError, ValueError):
        whole = False
    if not whole:
        raise Error(f"{folder / NAME}: is damaged; keep what is whole of the run: talus repair RUN.h5 -o NEW.h5")
    return Manifest(header, checkpoint, files["segment"])
