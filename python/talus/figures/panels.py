"""Panels of a figure: their arrangement with room for their texts, the legend above them, and curves of groups."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import matplotlib
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.cbook import is_math_text
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.text import Text
from matplotlib.ticker import AutoLocator, MaxNLocator

from talus.errors import WrongValue
from talus.figures.data import Data
from talus.figures.style import CM, COLOURS, NARROW, as_math, curve_style, letter, new_figure
from talus.figures.tables import Table

GAP = 0.2  # cm, between panels and at the edges
SYMBOLS_OF_A_CURVE = 16
SMALLEST = 4.5  # points, of letters that do not fit otherwise
LOWEST = 1.8  # cm, height of a panel


@dataclass(frozen=True)
class Page:
    """Size of a figure in cm."""

    width: float
    height: float = 0  #: 0: as high as its panels require
    ax: Axes | None = None  #: drawn there, for a figure of one panel

    @property
    def narrow(self) -> bool:
        return self.width <= NARROW


def panels(page: Page, count: int, *, row: float, wide: int = 3, narrow: int = 2, share_x: bool = False,
           share_y: bool = False, **options: Any) -> list[Axes]:
    """Returns `count` panels of a new figure, or that of the page: `wide` in a row, `narrow` on a narrow page, in rows of
    a height of `row` cm. With `share_x` (`share_y`) only the lowest (first) panels have numbers."""
    if page.ax is not None:
        if count != 1:
            raise WrongValue(f"ax: this figure has {count} panels, and needs a figure of its own")
        return [page.ax]
    columns = min(count, narrow if page.narrow else wide)
    rows = -(-count // columns)
    figure = new_figure(page.width, max(page.height, 2.5 * rows) if page.height else row * rows)
    found: list[Axes] = []
    for k in range(count):
        first = found[0] if found else None
        axes = figure.add_subplot(rows, columns, k + 1, sharex=first if share_x else None, sharey=first if share_y else None, **options)
        axes.tick_params(labelbottom=not share_x or k + columns >= count, labelleft=not share_y or k % columns == 0)
        found.append(axes)
    return found


def mark_panels(axes: Sequence[Axes]) -> None:
    """Puts letters above the panels, (a), (b), ...; none if there is one panel."""
    for k, each in enumerate(axes):
        if len(axes) > 1:
            each.set_title(letter(k), loc="left")


def has_numbers(axes: Axes, which: str) -> bool:
    """Whether a panel has the numbers, and thus the title, of its horizontal ("x") or vertical axis."""
    axis = axes.xaxis if which == "x" else axes.yaxis
    return bool(axis.get_major_ticks(1)[0].label1.get_visible())


def text_width(figure: Figure, text: str, points: float) -> float:
    """Returns the width of a text in cm."""
    renderer = figure.canvas.get_renderer()
    is_math = bool(is_math_text(text))
    shown = text if is_math else text.replace(r"\$", "$")
    width: float = renderer.get_text_width_height_descent(shown, FontProperties(size=points), is_math)[0]
    return width / figure.dpi / CM


def broken(figure: Figure, text: str, points: float, room: float) -> str:
    """Returns the text in lines of at most `room` cm, broken at blanks outside of formulas, and in long words anywhere."""
    if text_width(figure, text, points) <= room:
        return text
    lines = [""]
    for word in re.findall(r"(?:\\\$|(?<!\\)\$(?:\\\$|[^$])*\$|[^\s$])+", text):
        longer = f"{lines[-1]} {word}".strip()
        if not lines[-1] or text_width(figure, longer, points) <= room:
            lines[-1] = longer
        else:
            lines.append(word)
        while "$" not in lines[-1] and len(lines[-1]) > 1 and (wide := text_width(figure, lines[-1], points)) > room:
            cut = max(1, int(0.95 * len(lines[-1]) * room / wide))
            lines[-1:] = [lines[-1][:cut], lines[-1][cut:]]
    return "\n".join(lines)


class Key:
    """Entries of the legend above the panels."""

    def __init__(self) -> None:
        self.handles: list[Artist] = []
        self.labels: list[str] = []

    def line(self, label: str, **look: Any) -> None:
        self.handles.append(Line2D([], [], **look))
        self.labels.append(label)

    def box(self, label: str, **look: Any) -> None:
        self.handles.append(Patch(linewidth=0, **look))
        self.labels.append(label)

    def draw(self, figure: Figure, width: float) -> float:
        """Draws the legend at the top, in as many columns as fit into the width of the figure (cm), and returns its height."""
        if not self.labels:
            return 0.0
        points = FontProperties(size=matplotlib.rcParams["legend.fontsize"]).get_size_in_points()
        room = width - 2 * GAP
        handle = (matplotlib.rcParams["legend.handlelength"] + matplotlib.rcParams["legend.handletextpad"]) * points / 72 * 2.54
        spacing = matplotlib.rcParams["legend.columnspacing"] * points / 72 * 2.54
        labels = [broken(figure, label, points, room - handle) for label in self.labels]
        widths = [handle + max(text_width(figure, line, points) for line in label.split("\n")) for label in labels]
        columns = next(n for n in range(len(labels), 0, -1) if n == 1 or fits(widths, n, spacing, room))
        legend = figure.legend(self.handles, labels, ncol=columns, loc="upper left", bbox_to_anchor=(0, 1))
        renderer = figure.canvas.get_renderer()
        height = legend.get_window_extent(renderer).height / figure.dpi / CM
        figure.talus_legend = legend
        return float(height)


def fits(widths: Sequence[float], columns: int, spacing: float, room: float) -> bool:
    """Whether entries of these widths fit into columns, of which a legend gives the first ones one entry more."""
    return bool(sum(max(part) for part in np.array_split(widths, columns)) + spacing * (columns - 1) <= room)


def free_axes(figure: Figure, x: float, y: float, width: float, height: float, **options: Any) -> Axes:
    """Returns axes at a place in cm from the lower left corner of the figure."""
    whole, high = figure.get_size_inches() / CM
    return figure.add_axes((x / whole, y / high, width / whole, height / high), **options)


def strip(figure: Figure, bottom: float, height: float) -> Axes:
    """Returns a strip over the full width of the figure whose coordinates are cm from its lower left corner."""
    width = figure.get_size_inches()[0] / CM
    axes = free_axes(figure, 0, bottom, width, height)
    axes.set_xlim(0, width)
    axes.set_ylim(0, height)
    axes.set_axis_off()
    return axes


def arrange(axes: Sequence[Axes], key: Key | None = None, *, page: Page, above: float = 0, below: float = 0) -> Figure:
    """Gives each panel the room that its texts need, and draws the legend above them. `above`, `below`: room in cm for more
    than the panels; `figure.talus_top` is the distance of the first from the top of the figure."""
    figure = axes[0].figure
    if page.ax is not None:
        if key is not None and key.labels:
            page.ax.legend(key.handles, key.labels, borderaxespad=0.8)  # inside the frame
        return figure
    width, height = (side / CM for side in figure.get_size_inches())
    top = key.draw(figure, width) if key is not None else 0.0
    if top:
        top += GAP
    if not page.height:
        height += top + above + below
        figure.set_size_inches(width * CM, height * CM)
    figure.talus_top = top
    titles = [each.get_title("left") for each in axes]
    for _ in range(2):  # the numbers of an axis, and the lines of a title, depend on its length
        height = place(figure, axes, width, height, top + above, below)
        fix_numbers(axes)
        before = [each.get_title("left") for each in axes]
        for each, title in zip(axes, titles):
            room = each.bbox.width / figure.dpi / CM + GAP
            each.set_title(broken(figure, title, title_of(each).get_fontsize(), room), loc="left")
    if before != [each.get_title("left") for each in axes]:
        height = place(figure, axes, width, height, top + above, below)
    if top:
        figure.talus_legend.set_bbox_to_anchor((GAP / width, 1 - GAP / height), transform=figure.transFigure)
    shrink_texts(figure, axes)
    return figure


#: Mark (gid) of lines of text above a panel.
ABOVE = "above"


def title_of(axes: Axes) -> Text:
    """Returns the title of a panel."""
    return axes.set_title(axes.get_title("left"), loc="left")


def texts_above(axes: Axes) -> list[Any]:
    """Returns the title of a panel and other lines above it, which need room above but not on the sides."""
    return [text for text in (title_of(axes), *(text for text in axes.texts if text.get_gid() == ABOVE)) if text.get_text()]


def place(figure: Figure, axes: Sequence[Axes], width: float, height: float, top: float, bottom: float) -> float:
    """Moves the panels of a grid such that all are equally large and their texts have room; sizes in cm. Returns the height of
    the figure, which grows if its texts leave too little for the panels."""
    renderer = figure.canvas.get_renderer()
    spec = axes[0].get_subplotspec().get_gridspec()
    rows, columns = spec.nrows, spec.ncols
    left, right, over, under = np.zeros(columns), np.zeros(columns), np.zeros(rows), np.zeros(rows)
    for each in axes:
        r, c = each.get_subplotspec().rowspan.start, each.get_subplotspec().colspan.start
        for text in texts_above(each):
            text.set_in_layout(False)
        box, outer = each.bbox, each.get_tightbbox(renderer)
        left[c], right[c] = max(left[c], box.x0 - outer.x0), max(right[c], outer.x1 - box.x1)
        highest = max([outer.y1, *(text.get_window_extent(renderer).y1 for text in texts_above(each))])
        under[r], over[r] = max(under[r], box.y0 - outer.y0), max(over[r], highest - box.y1)
    left, right, over, under = (side / figure.dpi / CM for side in (left, right, over, under))
    inner_width = max(0.5, (width - left.sum() - right.sum() - GAP * (columns + 1)) / columns)
    inner_height = (height - top - bottom - over.sum() - under.sum() - GAP * (rows + 1)) / rows
    if inner_height < LOWEST:
        height, inner_height = height + rows * (LOWEST - inner_height), LOWEST
        figure.set_size_inches(width * CM, height * CM)
    for each in axes:
        r, c = each.get_subplotspec().rowspan.start, each.get_subplotspec().colspan.start
        x = GAP + (GAP + inner_width) * c + left[: c + 1].sum() + right[:c].sum()
        y = height - top - GAP - (GAP + inner_height) * r - over[: r + 1].sum() - under[:r].sum() - inner_height
        each.set_position((x / width, y / height, inner_width / width, inner_height / height))
    return height


def fix_numbers(axes: Sequence[Axes]) -> None:
    """Fixes the largest number of ticks of each linear axis, such that their numbers do not overlap."""
    for each in axes:
        renderer = each.figure.canvas.get_renderer()
        for axis in (each.xaxis, each.yaxis):
            if not isinstance(axis.get_major_locator(), AutoLocator):
                continue
            for ticks in range(max(1, min(axis.get_tick_space(), 8)), 0, -1):
                axis.set_major_locator(MaxNLocator(ticks, steps=[1, 2, 2.5, 5, 10]))
                if axis is each.yaxis or not has_numbers(each, "x"):
                    break
                axis.get_majorticklabels()  # puts the ticks at their places
                low, high = sorted(axis.get_view_interval())
                near = 1e-9 * (high - low)
                boxes = [tick.label1.get_window_extent(renderer) for tick in axis.get_major_ticks()
                         if low - near <= tick.get_loc() <= high + near]
                if all(one.x1 + 2 < other.x0 for one, other in zip(boxes, boxes[1:])):
                    break


def shrink_texts(figure: Figure, axes: Sequence[Axes]) -> None:
    """Makes letters of titles smaller if they are longer than their axis, and those of the lines above all panels alike."""
    renderer = figure.canvas.get_renderer()
    lines, ratio = [], 1.0
    for each in axes:
        box = each.bbox
        for text, room in ((each.xaxis.label, box.width), (each.yaxis.label, box.height)):
            extent = text.get_window_extent(renderer)
            long = extent.height if text is each.yaxis.label else extent.width
            if long > room + GAP * CM * figure.dpi:
                text.set_fontsize(max(SMALLEST, text.get_fontsize() * room / long))
        for text in texts_above(each)[bool(each.get_title("left")):]:
            lines.append(text)
            ratio = min(ratio, (box.width + GAP * CM * figure.dpi) / text.get_window_extent(renderer).width)
    for text in lines:
        text.set_fontsize(max(SMALLEST, text.get_fontsize() * ratio))


def draw_curves(axes: Axes, data: Data, name: str, *, x: Any = None, scale: float = 1, symbols: bool = True) -> None:
    """Draws the means of a column of each group over the first column, or over x(values of it); behind them the single runs
    and bands of the deviation, and bands of the error."""
    over = x or (lambda values: values)
    for k, group in enumerate(data.groups):
        if name not in group.table:
            continue
        at, mean = over(group.table.columns[0].values), scale * group.table[name]
        colour = COLOURS[k % len(COLOURS)]
        if group.runs is not None:
            if data.facts["spread"]:
                band(axes, at, mean, scale * group.table[name + "_deviation"], color=colour, alpha=0.13)
                axes.add_collection(thin_lines(group.runs, name, over, scale, colour))
            band(axes, at, mean, scale * group.table[name + "_error"], color=colour, alpha=0.35)
        every = max(1, len(at) // SYMBOLS_OF_A_CURVE)
        axes.plot(at, mean, **curve_style(k, symbols or every == 1), markevery=every)


def band(axes: Axes, at: np.ndarray, mean: np.ndarray, width: np.ndarray, **look: Any) -> None:
    axes.fill_between(at, mean - width, mean + width, linewidth=0, **look)


def points_with_errors(axes: Axes, x: np.ndarray, y: np.ndarray, *, dx: Any = None, dy: Any = None, bars: float = 0.6,
                       **look: Any) -> None:
    """Draws points with error bars along x or y: (n,), or (2, n) for two sides; NaN for none. `bars`: width of their lines."""
    axes.plot(x, y, **look)
    for error, lines in ((dx, axes.hlines), (dy, axes.vlines)):
        if error is None:
            continue
        at, value = (y, x) if error is dx else (x, y)
        low, high = value - (error[0] if np.ndim(error) == 2 else error), value + (error[1] if np.ndim(error) == 2 else error)
        known = ~np.isnan(low) & ~np.isnan(high) & (high > low)
        if known.any():
            lines(at[known], low[known], high[known], colors=look["color"], linewidth=bars)


def thin_lines(runs: Table, name: str, over: Any, scale: float, colour: str) -> LineCollection:
    blocks = runs.blocks()
    at, values = over(runs.columns[1].values), scale * runs[name]
    return LineCollection([np.column_stack([at[rows], values[rows]]) for rows in blocks], colors=colour, linewidths=0.3,
                          alpha=5 / len(blocks) if len(blocks) > 14 else 0.35)


def key_of_curves(data: Data, symbols: bool = True) -> Key:
    """Returns the entries of all groups, and those of the bands."""
    key = Key()
    for k, group in enumerate(data.groups):
        key.line(as_math(group.legend), **curve_style(k, symbols or len(group.table) < 2 * SYMBOLS_OF_A_CURVE))
    if data.facts["spread"]:
        key.line("runs", color="#999999", linewidth=0.4)
    if data.has_errors:
        key.box("± standard error", color="#000000", alpha=0.35)
    if data.facts["spread"]:
        key.box("± standard deviation", color="#000000", alpha=0.13)
    return key


def begin_at_zero(axes: Axes, values: np.ndarray) -> None:
    """Begins the vertical axis at 0, or below it if some of these values are negative and not small."""
    low, high = np.nanmin(values, initial=0), np.nanmax(np.abs(values), initial=0)
    axes.set_ylim(float(low - 0.05 * high) if low < -0.02 * high else 0)


def set_range(axes: Axes, top: float | None = None) -> None:
    """Ends the vertical axis slightly beyond its data, but not below 0 if no number is, and not above a limit that all means
    respect: 1, or `top`."""
    low, high = axes.dataLim.intervaly
    if not np.isfinite([low, high]).all():
        return
    room = 0.05 * (high - low) if high > low else 0.1 * abs(high) or 1
    bottom = 0 if 0 <= low < room else low - room
    above = (1 if high == low else 0) if -room < high <= 0 else 1 if high <= 1 < high + room else high + room
    axes.set_ylim(bottom, above if top is None else min(above, top))
