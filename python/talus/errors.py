"""Errors of this package."""

import difflib
import errno
import re
from collections.abc import Iterable
from typing import Any


class Error(Exception):
    """Error that states what was found, where, what was expected, and what to do. Control characters, which names in a
    file may contain, are escaped. `exit_code` is the exit code of the command line (docs/errors.md)."""

    exit_code = 65  #: bad data, unless a subclass or the program states another

    def __init__(self, text: str) -> None:
        super().__init__("".join(c if c.isprintable() else c.encode("unicode_escape", "backslashreplace").decode()
                                 for c in text))

    __str__ = Exception.__str__  # that of KeyError adds quotation marks, that of OSError the errno


class MissingIndex(Error, IndexError, ValueError):
    """Error for an index or an angle without a frame; also an IndexError and a ValueError."""

    exit_code = 64


class MissingName(Error, KeyError):
    """Error for a name that a table does not have; also a KeyError."""

    exit_code = 64


class MissingAttribute(Error, AttributeError):
    """Error for an attribute that a class does not have; also an AttributeError."""

    exit_code = 64


class WrongType(Error, TypeError):
    """Error for a value of a wrong type; also a TypeError."""

    exit_code = 64


class WrongValue(Error, ValueError):
    """Error for an invalid value; also a ValueError."""

    exit_code = 64


class MissingPackage(Error, ImportError):
    """Error for an optional package that is not installed; also an ImportError."""

    exit_code = 69


class MissingFile(Error, FileNotFoundError):
    """Error for a file that does not exist or cannot be read; also a FileNotFoundError."""

    exit_code = 66

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.errno = errno.ENOENT


class FailedFile(Error, OSError):
    """Error for a file that cannot be created, read or written; also an OSError."""

    exit_code = 74


class OutOfMemory(Error, MemoryError):
    """Error for a lack of memory; also a MemoryError."""

    exit_code = 71


#: Classes by exit code; other errors of the extension are plain.
CLASSES = {64: WrongValue, 65: WrongValue, 66: MissingFile, 71: OutOfMemory, 73: FailedFile, 74: FailedFile}


def error_of_code(code: int, text: str) -> Error:
    """Returns the error of the extension with an exit code. A key is named as in Python, not as an option of a command."""
    error: Error = CLASSES.get(code, Error)(re.sub("^--set .*?: error: (?=key |unknown key )", "", text))
    error.exit_code = code
    return error


def suggestion(name: str, known: Iterable[str]) -> str:
    """Returns "; did you mean 'this'?" for the names most similar to a misspelt one, or a list of all if they are few."""
    group = name.rpartition("/")[0]
    names = list(dict.fromkeys(known))
    siblings = {each.rpartition("/")[2]: each for each in names if each.rpartition("/")[0] == group}
    near = [siblings[leaf] for leaf in difflib.get_close_matches(name.rpartition("/")[2], siblings, 2, 0.5)]
    near = near or difflib.get_close_matches(name, names, 2, 0.5) or [each for each in names if name.lower() in each.lower()][:2]
    if near:
        return f"; did you mean {' or '.join(map(repr, near))}?"
    return f"; expected one of {', '.join(names)}" if 0 < len(names) <= 20 else ""


class Closed:
    """Base of classes whose objects take no other attributes than those that they begin with, so that a misspelt one is an
    error. Objects of a class derived from them outside this package may have attributes of their own."""

    __slots__ = ()

    def __setattr__(self, name: str, value: Any) -> None:
        kind, own = type(self), getattr(self, "__dict__", None)
        is_open = own is not None and not (own.get("_is_closed") and kind.__module__.startswith("talus."))
        if not (is_open or hasattr(kind, name) or name in (own or ())):
            known = [each for each in dir(self) if not each.startswith("_")]
            raise MissingAttribute(f"{kind.__name__} has no attribute {name!r}{suggestion(name, known)}")
        try:
            super().__setattr__(name, value)
        except AttributeError:
            raise MissingAttribute(f"{kind.__name__}.{name} cannot be set") from None


def check_text(name: Any, what: str) -> str:
    """Returns the name. Raises WrongType if it is not a string."""
    if not isinstance(name, str):
        raise WrongType(f"{what} {short(name)}: expected a string")
    return name


def check_flag(value: Any, what: str) -> bool:
    """Returns True or False. Raises WrongType for other values."""
    if isinstance(value, bool) or type(value).__name__ in ("bool_", "bool"):
        return bool(value)
    raise WrongType(f"{what} = {short(value)}: expected True or False")


def short(value: Any) -> str:
    """Returns a short form of a value for messages."""
    try:
        text = repr(value)
    except Exception:
        text = f"<{type(value).__name__}>"
    return text if len(text) <= 60 else text[:57] + "..."
