"""Tables of figures: columns of numbers with their units and meanings, and their CSV files."""

from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass
class Column:
    """A column of numbers; NaN for a missing value."""

    name: str  #: "p_o", as in the CSV file
    unit: str  #: "deg", "D", "1"
    meaning: str
    values: np.ndarray


@dataclass
class Table:
    """A CSV file of a figure: FIGURE.csv, or FIGURE-NAME.csv if the table has a name."""

    name: str
    columns: list[Column]
    in_blocks: bool = False  #: an empty line at each change of the first column

    def __getitem__(self, name: str) -> np.ndarray:
        return next(column.values for column in self.columns if column.name == name)

    def __contains__(self, name: str) -> bool:
        return any(column.name == name for column in self.columns)

    def __len__(self) -> int:
        return len(self.columns[0].values) if self.columns else 0

    def blocks(self) -> list[np.ndarray]:
        """Returns the rows of each block, which have the same number in the first column."""
        first = self.columns[0].values
        return np.split(np.arange(len(first)), np.flatnonzero(np.diff(first)) + 1) if len(first) else []


def column(name: str, unit: str, meaning: str, values: Any) -> Column:
    """Returns a column of any sequence of numbers."""
    return Column(name, unit, meaning, np.asarray(values, dtype=float))


def short_text(value: float) -> str:
    """Returns the shortest digits that read back as the same number, without an exponent from 0.0001 to 10 million."""
    if np.isnan(value):
        return "NaN"
    value = float(value)
    if value == 0 or 1e-4 <= abs(value) < 1e7:
        return repr(value).removesuffix(".0")
    fixed = np.format_float_positional(value, trim="-")
    scientific = np.format_float_scientific(value, trim="-", exp_digits=2)
    return fixed if len(fixed) <= len(scientific) else scientific


def literal(text: str) -> str:
    """Returns a text that matplotlib shows as it is, without formulas."""
    return text.replace("$", r"\$")


def csv_text(table: Table) -> str:
    """Returns the names of the columns and a line for each row, with the digits of short_text. Blocks are separated by an
    empty line, which readers of CSV skip."""
    lines = [",".join(each.name for each in table.columns)]
    cells = [[short_text(value) for value in each.values.tolist()] for each in table.columns]
    rows = [",".join(row) for row in zip(*cells)]
    for k, block in enumerate(table.blocks() if table.in_blocks else [np.arange(len(rows))]):
        lines += [""] * (k > 0) + [rows[row] for row in block]
    return "\n".join(lines) + "\n"
