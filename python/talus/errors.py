"""The errors of this package."""

from typing import Any


class Error(Exception):
    """What was found, where, what was expected, and what to do. Control characters, which names in a file may hold, are
    written as escapes."""

    def __init__(self, text: str) -> None:
        super().__init__("".join(c if c.isprintable() else c.encode("unicode_escape", "backslashreplace").decode()
                                 for c in text))

    __str__ = Exception.__str__  # that of a KeyError is in quotation marks


class MissingIndex(Error, IndexError):
    """An index outside of a sequence, which Python knows as an IndexError."""


class MissingName(Error, KeyError):
    """A name that a table does not have, which Python knows as a KeyError."""


class WrongType(Error, TypeError):
    """A value of a type that a call does not take, which Python knows as a TypeError."""


class WrongValue(Error, ValueError):
    """A value that a call does not take, which Python knows as a ValueError."""


class MissingPackage(Error, ImportError):
    """A package that only some calls need, and that is not installed."""


def check_text(name: Any, what: str) -> str:
    """The name. Throws WrongType if it is not a text."""
    if not isinstance(name, str):
        raise WrongType(f"{what} {short(name)}: expected a text")
    return name


def short(value: Any) -> str:
    """A value as a message quotes it."""
    try:
        text = repr(value)
    except Exception:
        text = f"<{type(value).__name__}>"
    return text if len(text) <= 60 else text[:57] + "..."
