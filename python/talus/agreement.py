"""Chart of `talus reproduce`: the distance of each value from the paper's, in units of the tolerance of the comparison."""

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from talus import paper
from talus.figures.data import Data
from talus.figures.panels import Page
from talus.figures.style import CM, COLOURS, SYMBOLS, as_math, letter, new_figure
from talus.figures.tables import Table, column
from talus.paper import BASES, CHAIN, PACKING, STORED, WALLS, PaperValue, Spread

if TYPE_CHECKING:
    from talus.reproduce import Reproduction

TITLE = "Our values and the paper's"
CAPTION = (
    "Our value minus the paper's, in units of the tolerance of the comparison; values in the gray band agree (full symbols). (a) "
    "The packing, by preparation of the periodic bed, and beds between walls. (b) Overloaded grains, their lengths and theta_d, in "
    "the periodic bed of the paper's preparation, by reading of \"overloaded\". Arrows: values beyond the axis. A cross at the "
    "right: the value does not occur. Numbers at the right are those of the paper.")
COLUMNS = (
    ("row", "1", "row of the chart, counted from 1 at the top"),
    ("series", "1", "preparation or reading, counted from 1 in the order of the key"),
    ("ours", "unit of the row", "mean over the runs; NaN if the value occurs in none"),
    ("deviation", "unit of the row", "standard deviation over the runs"),
    ("paper", "unit of the row", "value of the paper"),
    ("tolerance", "unit of the row", "largest difference for agreement: accuracy of the paper and one standard deviation of ours"),
    ("score", "1", "(ours - paper) / tolerance; NaN if the value does not occur"),
    ("agrees", "1", "1 if they agree, else 0"),
)
#: Words of rows and series, and what the chart shows instead.
WORDS = (("theta", "θ"), ("sigma", "σ"), ("gamma", "γ"), ("Gamma", "Γ"), (">=", "≥"), ("l_c", "ℓ_c"), (" deg", "°"),
         ("contact normals concentrate", "normals"), ("single grains", "grains alone"),
         (" over tan(θ) at θ_c", " / tan(θ_c)"), ("number z", "number $z$"), ("k_L - k_0", "$k_L$ − $k_0$"))
LIMIT = 6.0  #: end of the axis
ROW, HEAD, FOOT, KEY_ROW = 0.42, 0.45, 1.0, 0.36  # cm


@dataclass
class Chart:
    """Rows from top to bottom, with one symbol for each series."""

    name: str
    series: list[str]  #: descriptions of the symbols
    labels: list[str] = field(default_factory=list)  #: of the rows
    papers: list[str] = field(default_factory=list)  #: the paper's value in each row
    values: list[tuple[float, ...]] = field(default_factory=list)  #: rows of the table

    def add_row(self, value: PaperValue, label: str, ours: list[tuple[Spread, float]]) -> None:
        """Adds a row for one value, for each series ours in a bed of a depth (D). Values for which the paper gives no number,
        and those that cannot be compared, are left out; so is a row without any."""
        charted = False
        for k, (spread, depth) in enumerate(ours, 1):
            judged = paper.judge(value, spread, depth)
            if value.above or judged.verdict == "not comparable":
                continue
            charted, occurs = True, judged.verdict != "absent"
            self.values.append((len(self.labels) + 1, k, spread.values.mean, spread.values.deviation, value.value, judged.tolerance,
                                judged.difference / judged.tolerance if occurs else math.nan, judged.verdict == "agrees"))
        if charted:
            self.labels.append(label)
            self.papers.append(f"{value.value:.3g}" + {"1": "", "deg": "°"}.get(value.unit, f" {value.unit}"))

    @property
    def table(self) -> Table:
        values = np.array(self.values, float).reshape(-1, len(COLUMNS))
        return Table(self.name, [column(*head, each) for head, each in zip(COLUMNS, values.T)])


def charts_of(found: "Reproduction") -> list[Chart]:
    """Returns the chart of the packing, with one symbol for each preparation of the periodic bed, and that of the chain of
    overloaded grains for the paper's own preparation, with one symbol for each reading."""
    beds = found.beds
    packing = Chart("packing", [beds[bed].preparation for bed in found.preparations])
    for key, value in PACKING.items():
        packing.add_row(value, value.name, [(found.spread(bed, key, STORED), beds[bed].depth) for bed in found.preparations])
    for key in WALLS:
        for k, bed in enumerate(beds):
            if not bed.periodic:  # poured, as in the first preparation
                value = paper.wall_value(key, found.depth_over_length(k))
                packing.add_row(value, f"{bed.text}: {value.name}", [(found.spread(k, key), bed.depth)])
    if found.wall_coefficient().values.count > 1:
        packing.add_row(paper.COEFFICIENT, f"walls: {paper.COEFFICIENT.name}", [(found.wall_coefficient(), paper.DEPTH)])
    chain = Chart("chain", [reading.base for reading in BASES])
    for first in found.preparations[:1]:
        for key, value in CHAIN.items():
            readings = BASES[:1] if key == "theta_d_by_dilation" else BASES
            chain.add_row(value, value.name, [(found.spread(first, key, reading), beds[first].depth) for reading in readings])
    return [packing, chain]


def data_of(found: "Reproduction", runs: list[Any]) -> Data | None:
    """Returns the data of the chart, made from these runs; None if nothing can be compared."""
    charts = charts_of(found)
    if not any(chart.labels for chart in charts):
        return None
    return Data(CAPTION, tables=[chart.table for chart in charts], runs=runs, facts={"charts": charts})


def typeset(text: str) -> str:
    for word, shown in WORDS:
        text = text.replace(word, shown)
    return as_math(text)


def draw(data: Data, page: Page) -> Figure:
    """Draws the two charts, side by side or, on a narrow page, one above the other."""
    shown = [(chart, table, letter(k)) for k, (chart, table) in enumerate(zip(data.facts["charts"], data.tables)) if chart.labels]
    keys = [[Line2D([], [], linestyle="none", marker=SYMBOLS[k], color=COLOURS[k], label=f"{typeset(series)} {name}")
             for k, series in enumerate(chart.series)] for chart, _, name in shown]
    rows = [max(len(chart.labels), 6) for chart, _, _ in shown]
    if not page.narrow:
        rows = [max(rows)] * len(rows)
    key = KEY_ROW * (sum(map(len, keys)) if page.narrow else max(map(len, keys))) + 0.15
    heights = [ROW * count + HEAD + FOOT for count in rows]
    least = sum(heights) if page.narrow else heights[0]
    height = max(page.height, key + least)
    figure = new_figure(page.width, height)
    figure.legend(handles=[each for column in keys for each in column], loc="upper left", ncols=1 if page.narrow else len(keys),
                  bbox_to_anchor=(0.01, 1 - 0.1 / height), columnspacing=6, handletextpad=0.4)
    room, left, top = page.width / (1 if page.narrow else 2), 0.0, height - key
    for (chart, table, name), own in zip(shown, heights):
        own *= (height - key) / least
        draw_chart(figure, chart, table, name, left, top, room, own)
        left, top = (left, top - own) if page.narrow else (left + room, top)
    return figure


def draw_chart(figure: Figure, chart: Chart, table: Table, name: str, left: float, top: float, room: float, height: float) -> None:
    """Draws a chart into a box, given in cm, with the labels of the rows at its left and the paper's values at its right."""
    labels, papers = list(map(typeset, chart.labels)), [*map(typeset, chart.papers), "paper"]
    size = 7.0
    widths = [max(width_of(figure, text, size) for text in texts) + 0.3 for texts in (labels, papers)]
    share = min(1.0, 0.65 * room / sum(widths))  # of the letters, so that the panel has at least a third of the room
    size, (before, after) = size * share, (share * width for width in widths)
    width, whole = room - before - after, figure.get_size_inches() / CM
    axes = figure.add_axes((float((left + before) / whole[0]), float((top - height + FOOT) / whole[1]), float(width / whole[0]),
                            float((height - HEAD - FOOT) / whole[1])))
    count = len(labels)
    axes.set(xlim=(-LIMIT - 0.5, LIMIT + 0.5), ylim=(count + 0.5, 0.5), xlabel="(ours − paper) / tolerance", yticks=[],
             xticks=[-5, 0, 5])
    axes.axvspan(-1, 1, color="#e4e4e4", linewidth=0, zorder=0)
    axes.axvline(0, color="#555555", linewidth=0.8, zorder=0.5)
    gap, at = 0.1 / width, axes.get_yaxis_transform()
    for k, (label, value) in enumerate(zip(labels, papers), 1):
        axes.text(-gap, k, label, transform=at, ha="right", va="center", fontsize=size)
        axes.text(1 + gap, k, value, transform=at, ha="left", va="center", fontsize=size, color="#555555")
        if k < count:
            axes.axhline(k + 0.5, color="#dddddd", linewidth=0.5, zorder=0.5)
    above = 1 + 0.12 / (height - HEAD - FOOT)
    axes.text(-gap, above, name, transform=axes.transAxes, ha="right", va="bottom", fontsize=size)
    axes.text(1 + gap, above, papers[-1], transform=axes.transAxes, ha="left", va="bottom", fontsize=size, color="#555555")
    draw_symbols(axes, table, len(chart.series))


def draw_symbols(axes: Axes, table: Table, series: int) -> None:
    """Draws the symbols of a row below each other: full ones agree, arrows lie beyond the axis, crosses do not occur."""
    for row, k, score, agrees in zip(table["row"], table["series"], table["score"], table["agrees"]):
        y = row + (k - 0.5 * (series + 1)) * 0.27
        colour, symbol = COLOURS[int(k) - 1], SYMBOLS[int(k) - 1]
        if math.isnan(score):
            axes.plot(LIMIT + 0.2, y, marker="x", color=colour)
        elif abs(score) > LIMIT:
            side = math.copysign(1, score)
            arrow = {"arrowstyle": "-|>", "color": colour, "linewidth": 0.8, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 5}
            axes.annotate("", (side * (LIMIT + 0.4), y), (side * (LIMIT - 0.4), y), arrowprops=arrow)
        else:
            axes.plot(score, y, marker=symbol, color=colour, markerfacecolor=colour if agrees else "white")


def width_of(figure: Figure, text: str, size: float) -> float:
    """Returns the width of a text in cm."""
    drawn = figure.text(0, 0, text, fontsize=size)
    width = drawn.get_window_extent(figure.canvas.get_renderer()).width / figure.dpi / CM
    drawn.remove()
    return float(width)
