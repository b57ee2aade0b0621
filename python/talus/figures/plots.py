"""Figures of the plots of the window, which writes them as JSON (src/app/plot_export.cpp)."""

import json
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from talus.figures.catalogue import Recipe
from talus.figures.data import Data
from talus.figures.files import figure_files, write_figure
from talus.figures.panels import Key, Page, arrange, panels
from talus.figures.style import MARK, as_math, curve_style, logarithmic, set_title
from talus.figures.tables import Table, column
from talus.simulation import _extension

FORMATS = ("pdf", "png")


def numbers(values: Sequence[float | None]) -> np.ndarray:
    return np.array([np.nan if value is None else value for value in values], dtype=float)


def title_and_unit(title: str) -> tuple[str, str]:
    """Splits "θ (°)" into the title and the unit of an axis."""
    text, found, unit = title.removesuffix(")").rpartition(" (")
    return (text, {"°": "deg"}.get(unit, unit)) if found else (title, "1")


def plot_data(plot: dict[str, Any]) -> Data:
    """Returns the tables of a plot: curves over the same places share one."""
    data = Data(f"{plot['title']} over {plot['x_title']}" + (f", {plot['note']}" if plot["note"] else ""), facts={"plot": plot})
    title, unit = title_and_unit(plot["x_title"])

    def table_over(x: np.ndarray) -> Table:
        for table in data.tables:
            if np.array_equal(table.columns[0].values, x):
                return table
        data.tables.append(Table(str(len(data.tables) + 1) if data.tables else "", [column("x", unit, title, x)]))
        return data.tables[-1]

    for each in plot["series"]:
        table_over(numbers(each["x"])).columns.append(column(each["column"], each["unit"], each["meaning"], numbers(each["y"])))
    return data


def draw_plot(data: Data, page: Page) -> Figure:
    """Draws the curves of a plot, thin lines for laws."""
    plot, key = data.facts["plot"], Key()
    axes = panels(page, 1, row=0.75 * page.width)
    several = len(plot["series"]) > 1
    for k, each in enumerate(plot["series"]):
        look = curve_style(k, symbols=False) | {"linestyle": "-", "linewidth": 0.5 if each["law"] else 1}
        axes[0].plot(numbers(each["x"]), numbers(each["y"]), **look)
        if several:
            key.line(as_math(each["label"]), **look)
    if plot["theta_c"] is not None:
        key.line("$θ_c$", **MARK)
        axes[0].axvline(plot["theta_c"], **MARK)
    if plot["note"]:
        key.line(as_math(plot["note"]), linestyle="none")
    low, high = plot["range"] or axes[0].get_xlim()
    axes[0].set_xlim((high, low) if plot["falling"] else (low, high))
    if plot["logarithmic"]:
        logarithmic(axes[0].yaxis)
    title, unit = title_and_unit(plot["x_title"])
    set_title(axes[0], "x", as_math(title), unit)
    title, unit = title_and_unit(plot["title"])
    set_title(axes[0], "y", as_math(title), unit)
    return arrange(axes, key, page=page)


def main(words: Sequence[str]) -> None:
    """Writes the plots of a JSON file, `words[0]`, as figures into the folder `words[1]`."""
    source, folder, command = words
    plots = json.loads(Path(source).read_text(encoding="utf-8"))
    made = []
    for plot in plots:
        recipe = Recipe("plot-" + plot["name"].replace("/", "-"), plot["title"], "", lambda groups, wanted: None, draw_plot)
        made.append((recipe, plot_data(plot)))
    for recipe, data in made:
        for name in figure_files(recipe, data, FORMATS):
            _extension()._output_target(os.fsencode(Path(folder) / name), False, [])
    _extension()._prepare_folder(os.fsencode(folder))
    for recipe, data in made:
        write_figure(recipe, data, [], Path(folder), formats=FORMATS, command=command)
