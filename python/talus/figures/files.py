"""Files of figures: pictures, CSV tables, and the provenance, which appear together when all are complete."""

import fcntl
import json
import os
import shutil
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from talus.errors import FailedFile
from talus.figures.catalogue import Recipe
from talus.figures.data import Data
from talus.figures.groups import Group
from talus.figures.panels import Page
from talus.figures.style import styled, write
from talus.figures.tables import Table, csv_text
from talus.simulation import _extension

TEMPORARY = ".talus.part"


def table_file(recipe: Recipe, table: Table) -> str:
    return f"{recipe.name}{'-' if table.name else ''}{table.name}.csv"


def figure_files(recipe: Recipe, data: Data, formats: Sequence[str]) -> list[str]:
    """Returns the names of all files of a figure, its provenance last."""
    return [*(f"{recipe.name}.{ending}" for ending in formats), *(table_file(recipe, table) for table in data.tables),
            f"{recipe.name}.json"]


def earlier_files(folder: Path, recipe: Recipe) -> list[str]:
    """Returns the names of the files of an earlier figure in a folder, as its provenance lists them; none without one."""
    name = recipe.name
    try:
        provenance = json.loads((folder / f"{name}.json").read_text(encoding="utf-8"))
        if provenance["figure"] != name:
            return []
        tables = [str(table["file"]) for table in provenance["tables"]]
    except (OSError, ValueError, KeyError, TypeError):
        return []
    mine = [file for file in tables if file.startswith(f"{name}-") and file.endswith(".csv") and "/" not in file]
    return [*mine, *(f"{name}.{ending}" for ending in ("csv", "pdf", "svg", "png", "json"))]


def remove_files(folder: Path, names: Sequence[str]) -> None:
    for name in names:
        (folder / name).unlink(missing_ok=True)


def provenance(recipe: Recipe, data: Data, groups: Sequence[Group], command: str) -> dict[str, Any]:
    """Returns contents and sources of a figure: title, caption, version, command; path, seed, hashes and parameters of the
    analysis of each run; name, unit and meaning of each column."""
    sources = {run.path for run in data.runs}
    runs = [{"path": run.path, "group": group.label, "seed": run.seed, "state_hash": run.state_hash,
             "scenario_hash": run.core.scenario_hash, "analysis_key": run.core.analysis_key, "analysis": run.core.parameters}
            for group in groups for run in group.runs if run.path in sources]
    tables = [{"file": table_file(recipe, table), "columns": [{"name": each.name, "unit": each.unit, "meaning": each.meaning}
                                                              for each in table.columns]} for table in data.tables]
    return {"figure": recipe.name, "title": data.title or recipe.title, "caption": data.caption, "version": _extension().version_text,
            "command": command, "runs": runs, "tables": tables}


def creation_error(text: str) -> FailedFile:
    error = FailedFile(text)
    error.exit_code = 73
    return error


def locked_folder(path: Path, what: str) -> int:
    """Makes a folder, unless it exists, and returns it open and locked. Another process that removes leftovers (base/locked_file.h)
    may take a folder for one until it is locked; then it is recreated."""
    while True:
        try:
            path.mkdir(exist_ok=True)
            lock = os.open(path, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC)
        except FileNotFoundError as error:
            if not path.parent.is_dir():
                raise creation_error(f"{path}: cannot be made: {error.strerror}") from None
            continue
        except OSError as error:
            raise creation_error(f"{path}: cannot be made: {error.strerror}") from None
        try:
            fcntl.flock(lock, fcntl.LOCK_SH | fcntl.LOCK_NB)  # fails only if it is written
            fcntl.flock(lock, fcntl.LOCK_EX)
            if path.is_dir() and os.path.samestat(os.fstat(lock), path.stat()):
                return lock
        except BlockingIOError:
            os.close(lock)
            raise creation_error(f"{what} is being drawn by another process in the same folder; wait for it to end, or choose "
                                 "another folder with -o") from None
        os.close(lock)


@contextmanager
def workshop(path: Path, what: str) -> Iterator[None]:
    """Provides an empty temporary folder, which is removed at the end. One that a killed process has left is emptied. Raises
    FailedFile if another process uses it."""
    lock = locked_folder(path, what)
    try:
        try:
            remove_files(path, os.listdir(path))
            yield
        finally:
            shutil.rmtree(path, ignore_errors=True)
    finally:
        os.close(lock)


def write_figure(recipe: Recipe, data: Data, groups: Sequence[Group], folder: Path, *, formats: Sequence[str] = ("pdf", "png"),
                 width: float = 0, height: float = 0, style: Any = None, command: str = "") -> None:
    """Writes all files of a figure into a folder. They are made in a temporary folder and renamed when all are complete, the
    provenance last; further files of an earlier figure of this name are removed. Raises FailedFile if a file cannot be
    written."""
    page, title = Page(width or recipe.width, height), data.title or recipe.title
    part = folder / (recipe.name + TEMPORARY)
    with workshop(part, recipe.name):
        pictures = [part / f"{recipe.name}.{ending}" for ending in formats]
        if recipe.write is not None:
            recipe.write(data, page, pictures, title)
        else:
            with styled(style):
                figure = recipe.draw(data, page)
            write(figure, pictures, title, recipe.dpi, style)
        for table in data.tables:
            (part / table_file(recipe, table)).write_text(csv_text(table), encoding="utf-8")
        text = json.dumps(provenance(recipe, data, groups, command), indent=2, ensure_ascii=False) + "\n"
        (part / f"{recipe.name}.json").write_text(text, encoding="utf-8", errors="surrogateescape")
        earlier, names = earlier_files(folder, recipe), figure_files(recipe, data, formats)
        for name in names:
            _extension()._publish_file(os.fsencode(part / name), os.fsencode(folder / name))
        remove_files(folder, [name for name in earlier if name not in names])
