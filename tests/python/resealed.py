"""Run files changed by someone who knows the format: afterwards all hashes are correct again."""

import json
import re
from pathlib import Path

import h5py
import xxhash


def seal(path):
    """Writes the correct size and hash into the first lines of a packed file."""
    data = Path(path).read_bytes()[512:]
    lines = b"talus run file 1\nsize %d\nxxh3 of all after byte 512 %s\n" % (
        len(data) + 512, xxhash.xxh3_64_hexdigest(data).encode())
    Path(path).write_bytes(lines.ljust(512, b"\0") + data)
    return path


def sealed(path, change):
    """Changes an HDF5 file and seals it again."""
    with h5py.File(path, "r+") as file:
        change(file)
    return seal(path)


def sealed_text(text):
    """Returns a manifest whose last line is the hash of the others."""
    body = text[: text.rindex("hash ")]
    return body + f"hash {xxhash.xxh3_64_hexdigest(body.encode())}\n"


def ensemble_manifest(variants=({},), **members):
    """Returns the manifest of an ensemble of seed 1, with the given members and variants, and the hash that belongs to it."""
    members = {"format": "talus ensemble 2", "version": "0.1.0", "seeds": "1", "until": "", "task": "", "keep": "", **members}
    members["variants"] = [{"name": "", "full_name": "", "scenario": "0", "bed": "", **variant} for variant in variants]
    return sealed_json(json.dumps(members, indent=1, ensure_ascii=False))


def sealed_json(text):
    """Returns an object of JSON with the hash of its text as its last member."""
    body = text.rstrip().removesuffix("}").rstrip() + ',\n "hash": '
    return f'{body}"{xxhash.xxh3_64_hexdigest(body.encode("utf-8", "surrogateescape"))}"\n}}\n'


def reseal_folder(folder):
    """Writes the correct sizes and hashes of its files into the manifest of a folder."""
    manifest = Path(folder) / "manifest"
    lines = manifest.read_text().splitlines(keepends=True)
    for k, line in enumerate(lines):
        words = line.split()
        if words[0] in ("header", "checkpoint", "segment") and (Path(folder) / words[1]).is_file():
            data = (Path(folder) / words[1]).read_bytes()
            words[2:4] = str(len(data)), xxhash.xxh3_64_hexdigest(data)
            lines[k] = " ".join(words) + "\n"
    manifest.write_text(sealed_text("".join(lines)))


def change_manifest(folder, pattern, replacement):
    manifest = Path(folder) / "manifest"
    text = manifest.read_text()
    changed = re.sub(pattern, replacement, text, flags=re.MULTILINE)
    assert changed != text
    manifest.write_text(sealed_text(changed))
