"""The error of this package."""


class Error(Exception):
    """What was found, where, what was expected, and what to do."""
