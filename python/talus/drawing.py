"""Pictures: maps of a state or a frame, of quantities of Talus or of values of one's own; panels and movies of them."""

import os
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np

from talus.errors import WrongType, WrongValue, check_flag, check_text, error_of_code, short


class Image(np.ndarray):
    """Picture, (h, w, 4) of uint8, sRGB and alpha, rows from top to bottom. A notebook displays it."""

    def _repr_png_(self) -> bytes:
        return _extension()._png(np.asarray(self))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the picture as a PNG file."""
        with open(_path(path), "wb") as file:
            file.write(self._repr_png_())


def _extension() -> Any:
    from talus.simulation import _extension

    return _extension()


def _path(path: Any) -> bytes:
    from talus.simulation import _path

    return _path(path)


def _text(text: Any, what: str) -> str:
    """Returns a text for a picture. Raises WrongType and WrongValue for other values."""
    try:
        check_text(text, what).encode()
    except UnicodeEncodeError:
        raise WrongValue(f"{what} {short(text)}: expected a text in UTF-8") from None
    return text


def _side(value: Any, what: str) -> int:
    """Returns a side of a picture, px. Raises WrongType and WrongValue for other values."""
    from talus.simulation import _whole

    if not 200 <= (side := _whole(value, what)) <= 16384:
        raise WrongValue(f"{what} = {short(value)}: expected 200 to 16384 px")
    return side


#: Kinds of values by the kind of their numpy type.
KINDS = {"b": "flag", "i": "cluster", "u": "cluster", "f": "number"}


def _choice(what: Any, label: str | None, unit: str) -> Any:
    """Returns the name of a map, or values of one's own, for the extension."""
    if isinstance(what, str):
        if label is not None or unit:
            raise WrongType(f"map {short(what)}: only values of your own take a label and a unit")
        return what
    values, kind = own_values(what, f"map {short(what)}: expected the name of a map, or an array")
    return _extension().OwnQuantity(values, kind, _text("values" if label is None else label, "label"), _text(unit, "unit"),
                                    "values", True)


#: What a grain or contact without a value has.
NO_VALUE = {"flag": 0, "cluster": -1, "number": np.nan}


def own_values(what: Any, expected: str) -> tuple[np.ndarray, str]:
    """Returns values of one's own as floats, and their kind. Raises WrongType, which begins as `expected`, for others."""
    try:
        values = np.asarray(what)
    except Exception:  # raised by a user-defined __array__
        values = np.empty((), object)
    if values.ndim != 1 or values.dtype.kind not in KINDS:
        raise WrongType(f"{expected} with a number, a label (integer) or True or False for each grain or each contact")
    kind, values = KINDS[values.dtype.kind], values.astype(float)
    if isinstance(what, np.ma.MaskedArray):
        values[np.ma.getmaskarray(what)] = NO_VALUE[kind]
    return values, kind


def stored_quantity(run: Any, name: Any, frames: Iterable[Any], label: Any, unit: Any) -> Any:
    """Returns a quantity for the extension that is to be stored with a run: `frames` has the values of each frame."""
    if not re.fullmatch("[a-z][a-z0-9_-]{0,39}", check_text(name, "name")):
        raise WrongValue(f"name {short(name)}: expected up to 40 lower-case letters, digits, _ and -, beginning with a letter")
    if re.sub("_[0-9][0-9_]*$", "", name) in (known := _extension()._names_of_talus()) or name in known:
        raise WrongValue(f"name {short(name)}: is that of a map or a quantity of Talus; choose another")
    try:
        arrays = [own_values(each, f"frame {k}: {short(each)}: expected an array") for k, each in enumerate(frames)]
    except TypeError as error:
        raise error if isinstance(error, WrongType) else WrongType(f"values {short(frames)}: expected an array for each frame")
    if len(arrays) != len(run.frames) or not arrays:
        raise WrongValue(f"{len(arrays)} arrays: expected one for each of the {len(run.frames)} frames")
    kind = arrays[0][1]
    grains, free = len(run.id), int(run.free.sum())
    of_grains = all(len(values) in (free, grains) for values, _ in arrays)
    rows = []
    for k, (values, its_kind) in enumerate(arrays):
        carries = np.arange(grains) < len(values) if of_grains else run.frames[k]._carries
        if its_kind != kind:
            raise WrongType(f"frame {k}: a {its_kind}, after a {kind}: expected numbers, integers or flags in all frames")
        if len(values) != carries.sum():
            raise WrongValue(f"frame {k}: {len(values)} values: expected one for each of the {free} free grains, of all {grains} "
                             f"grains, or of the {carries.sum()} contacts that carry force")
        rows.append(np.full(len(carries), NO_VALUE[kind], float))
        rows[-1][carries] = values
    return _extension().OwnQuantity(np.concatenate(rows), kind, _text(name if label is None else label, "label"),
                                    _text(unit, "unit"), name, of_grains)


def _options(values: Mapping[str, Any]) -> Any:
    """Returns the options of a map for the extension."""
    chosen = _extension().MapOptions()
    for name, value in values.items():
        try:
            setattr(chosen, name, value)
        except AttributeError:
            raise WrongType(f"draw has no option {short(name)}") from None
        except TypeError:
            raise WrongType(f"draw: {name} = {short(value)}: expected a value of another type") from None
    return chosen


@contextmanager
def _named_as_arguments() -> Iterator[None]:
    """Names options in errors as arguments of Python, not as those of the command line."""
    try:
        yield
    except WrongValue as error:
        raise WrongValue(re.sub("--([a-z-]*[a-z])", lambda found: found[1].replace("-", "_"), str(error))) from None


def draw(core: Any, what: Any, width: int, label: str | None, unit: str, options: Mapping[str, Any]) -> Image:
    """Draws a map of a simulation or frame of the extension."""
    with _named_as_arguments():
        return core._draw(_choice(what, label, unit), _options({"width": width, **options})).view(Image)


def map_of(core: Any, what: Any, label: str | None, unit: str, options: Mapping[str, Any]) -> Any:
    """Returns a map of a simulation or frame of the extension, for panel and animate."""
    if "width" in options:
        raise WrongType("map has no option 'width': give it to talus.panel")
    with _named_as_arguments():
        return core._map(_choice(what, label, unit), _options(options))


def _rows(pictures: Iterable[Any], what: str) -> list[list[Any]]:
    """Returns lists of maps, all of one length."""
    rows = [list(each) if isinstance(each, Sequence) else [each] for each in pictures]
    if not rows or len({len(row) for row in rows}) != 1 or not rows[0]:
        raise WrongValue(f"{what}: expected one or more maps, or lists of maps of one length")
    for row in rows:
        for each in row:
            if not isinstance(each, _extension().Map):
                raise WrongType(f"{what}: {short(each)}: expected a map, such as frame.map('gamma')")
    return rows


def panel(rows: Iterable[Any], *, width: int = 1200, title: str = "") -> Image:
    """Draws maps as one picture, `width` px wide, like `talus panel`: `rows` has a map, or a list of maps side by side, for
    each row. Equal titles, legends and the scale bar appear once. Maps come from frame.map and sim.map."""
    return _extension()._panel(_rows(rows, "panel"), _text(title, "title"), _side(width, "panel: width")).view(Image)


def animate(path: str | os.PathLike[str], pictures: Iterable[Any], *, size: tuple[int, int] = (1280, 720), fps: float = 10.0,
            overwrite: bool = False) -> None:
    """Writes a movie (.mp4, .webm or .gif) by ffmpeg: `pictures` has a map, or a list of maps, for each picture. All
    pictures have the same layout; give values of your own the same `range` in all of them."""
    name, replace = _path(path), check_flag(overwrite, "overwrite")
    if os.path.isdir(name) or (os.path.lexists(name) and not replace):
        raise error_of_code(73, f"{os.fsdecode(name)}: exists already; replace a file with overwrite=True")
    try:
        width, height = size
        rate = float(fps)
    except (TypeError, ValueError, OverflowError):
        raise WrongType(f"animate: size = {short(size)}, fps = {short(fps)}: expected (width, height) in px, and a number") from None
    if not 0.1 <= rate <= 240.0:
        raise WrongValue(f"animate: fps = {rate:.6g}: expected 0.1 to 240")
    _extension()._animate(name, _rows(pictures, "animate"), _side(width, "animate: width"), _side(height, "animate: height"), rate)
