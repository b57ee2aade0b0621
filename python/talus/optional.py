"""Packages that only some functions need."""

import importlib
from types import ModuleType

from talus.errors import MissingPackage


def need(name: str, purpose: str) -> ModuleType:
    """Returns the package `name`. Raises ImportError, with installation instructions, if it is missing."""
    try:
        return importlib.import_module(name)
    except ImportError as missing:
        raise MissingPackage(
            f"{purpose} needs {name}, which is not installed: apt install python3-{name}, or pip install {name}"
        ) from missing
