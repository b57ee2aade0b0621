"""Errors of this package."""

from typing import Any


class Error(Exception):
    """Error that states what was found, where, what was expected, and what to do. Control characters, which names in a
    file may contain, are escaped."""

    def __init__(self, text: str) -> None:
        super().__init__("".join(c if c.isprintable() else c.encode("unicode_escape", "backslashreplace").decode()
                                 for c in text))

    __str__ = Exception.__str__  # that of KeyError adds quotation marks


class MissingIndex(Error, IndexError):
    """Error for an index outside a sequence; also an IndexError."""


class MissingName(Error, KeyError):
    """Error for a name that a table does not have; also a KeyError."""


class WrongType(Error, TypeError):
    """Error for a value of a wrong type; also a TypeError."""


class WrongValue(Error, ValueError):
    """Error for an invalid value; also a ValueError."""


class MissingPackage(Error, ImportError):
    """Error for an optional package that is not installed; also an ImportError."""


def check_text(name: Any, what: str) -> str:
    """Returns the name. Raises WrongType if it is not a string."""
    if not isinstance(name, str):
        raise WrongType(f"{what} {short(name)}: expected a string")
    return name


def short(value: Any) -> str:
    """Returns a short form of a value for messages."""
    try:
        text = repr(value)
    except Exception:
        text = f"<{type(value).__name__}>"
    return text if len(text) <= 60 else text[:57] + "..."
