"""Look of the figures: sizes, fonts, colours, titles of axes, and files with the same bytes for the same data."""

import io
import math
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from talus.optional import need

need("matplotlib", "talus.figures")

import matplotlib  # noqa: E402
import matplotlib.style  # noqa: E402
from matplotlib.axes import Axes  # noqa: E402
from matplotlib.backends.backend_agg import FigureCanvasAgg  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter, NullLocator  # noqa: E402

CM = 1 / 2.54  # inches
#: Widths of one and of two columns of a journal, cm.
ONE_COLUMN, TWO_COLUMNS = 8.6, 17.8
#: Up to this width, cm, panels are arranged as in one column.
NARROW = 12

#: Settings of matplotlib; those of a style sheet take precedence.
SETTINGS = {
    "font.family": "sans-serif", "font.sans-serif": ["DejaVu Sans"], "font.size": 8, "mathtext.fontset": "dejavusans",
    "axes.labelsize": 8, "axes.titlesize": 7, "axes.titlelocation": "left", "axes.titlepad": 3, "axes.labelpad": 2,
    "axes.titley": 1.0,  # otherwise matplotlib searches for their places, which are these
    "xtick.labelsize": 7, "ytick.labelsize": 7, "legend.fontsize": 7, "legend.frameon": False, "legend.handlelength": 2.6,
    "legend.borderpad": 0, "legend.borderaxespad": 0, "legend.labelspacing": 0.35, "legend.columnspacing": 1.6,
    "axes.linewidth": 0.5, "xtick.major.width": 0.5, "ytick.major.width": 0.5, "xtick.minor.width": 0.4,
    "ytick.minor.width": 0.4, "xtick.major.size": 2.5, "ytick.major.size": 2.5, "xtick.minor.size": 1.3,
    "ytick.minor.size": 1.3, "xtick.direction": "in", "ytick.direction": "in", "xtick.top": True, "ytick.right": True,
    "lines.linewidth": 1, "lines.markersize": 3.2, "lines.markeredgewidth": 0.8, "hatch.linewidth": 0.4,
    "axes.formatter.useoffset": False, "axes.formatter.limits": (-99, 99), "text.hinting": "none", "figure.dpi": 150,
    "pdf.fonttype": 42, "svg.fonttype": "none", "svg.hashsalt": "talus",
}

#: Curves of groups, distinguished in gray by dash and symbol; open symbols are those with a white face.
COLOURS = ("#000000", "#1f4e79", "#b03a2e", "#3d8b7d", "#7a5c99", "#b8860b", "#707070", "#5d9cc9")
DASHES: tuple[Any, ...] = ("-", (0, (5, 2)), (0, (1.5, 1.5)), (0, (6, 1.5, 1.5, 1.5)), (0, (3, 1.5)),
                           (0, (6, 1.5, 1.5, 1.5, 1.5, 1.5)), (0, (1, 2)), (0, (9, 2)))
SYMBOLS = ("o", "s", "^", "D", "o", "s", "^", "v")
OPEN = (False, True, False, True, True, False, True, False)
#: Lines that are not measured: thresholds and laws, theta_c and other marks, and axes.
LAW = {"color": "#555555", "linestyle": (0, (1, 1.7)), "linewidth": 1.0}
MARK = {"color": "#999999", "linestyle": (0, (4, 2.5)), "linewidth": 0.8}
AXIS = {"color": "#bbbbbb", "linestyle": "-", "linewidth": 0.5}
#: Crosses of the paper's values.
CROSS = {"color": "#000000", "linestyle": "none", "marker": "x", "markersize": 4.5, "markeredgewidth": 1.0}


def curve_style(k: int, symbols: bool = True) -> dict[str, Any]:
    """Returns the keywords of `Axes.plot` for curve k, counted from 0; those of 64 curves differ."""
    colour, form = COLOURS[k % len(COLOURS)], (k + 3 * (k // len(COLOURS))) % len(DASHES)
    look: dict[str, Any] = {"color": colour, "linestyle": DASHES[form]}
    if symbols:
        look |= {"marker": SYMBOLS[form], "markerfacecolor": "white" if OPEN[form] else colour}
    return look


@contextmanager
def styled(style: Any = None) -> Iterator[None]:
    """Uses the settings of the figures, and those of a style sheet: a name, path or dict, or a list of them, as
    `matplotlib.style.use` takes it."""
    with matplotlib.rc_context(), np.errstate(invalid="ignore"):
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(SETTINGS)
        if style is not None:
            matplotlib.style.use(style)
            matplotlib.rcParams.update({"figure.autolayout": False, "figure.constrained_layout.use": False})  # arrange() does it
        yield


def new_figure(width: float, height: float) -> Figure:
    """Returns an empty figure of a size in cm."""
    figure = Figure(figsize=(width * CM, height * CM))
    FigureCanvasAgg(figure)
    return figure


def letter(k: int) -> str:
    """Returns the letter of panel k, counted from 0: "(a)", ..., "(z)", "(aa)", ..."""
    letters = "abcdefghijklmnopqrstuvwxyz"
    return f"({letters[k // 26 - 1] if k >= 26 else ''}{letters[k % 26]})"


#: What follows a symbol below the line; other words with _ are names.
SYMBOL = re.compile(r"(?<![\w.$])([A-Za-zα-ωΓℓ])_(o|c|d|r|t|w|T|N|V|y|max)(?![\w.])|(?<![\w.$])([α-ω])(?![\w.])")
WORDS = {"ΔV/V": "$ΔV/V$", "Δy/y": "$Δy/y$", "Q/P": "$Q/P$", "z, ": "$z$, "}


def as_math(text: str) -> str:
    """Returns a text with its symbols set as in formulas, "ν_max" or "p_o", unless it has formulas already."""
    if "$" in text.replace(r"\$", ""):
        return text
    for word, formula in WORDS.items():
        text = text.replace(word, formula)
    return SYMBOL.sub(lambda found: f"${found[3]}$" if found[3] else rf"${found[1]}_{{\mathrm{{{found[2]}}}}}$"
                      if len(found[2]) > 1 else f"${found[1]}_{found[2]}$", text)


def with_unit(title: str, unit: str = "1", power: int = 0) -> str:
    """Returns the title of an axis, "title (unit)"; a power of ten precedes the unit, "(10^-4 %)"."""
    ten = f"$10^{{{power}}}$" if power else ""
    unit = {"deg": "°", "1": "", "D": "$D$"}.get(unit, unit)
    inside = " ".join(part for part in (ten, unit) if part)
    return f"{title} ({inside})" if inside else title


def common_power(low: float, high: float) -> int:
    """Returns the common power of ten of the numbers of an axis; 0 between 0.01 and 99999."""
    largest = max(abs(low), abs(high))
    power = math.floor(math.log10(largest) + 1e-9) if 0 < largest < math.inf else 0
    return power if power >= 5 or power <= -3 else 0


def set_title(axes: Axes, which: str, title: str, unit: str = "1", heading: str | None = None) -> None:
    """Sets the title of the axis "x" or "y" with its unit, once its range is known: numbers that are small or large are
    divided by a power of ten, which the title states. `heading`: the title is above the panel, after this letter."""
    axis = axes.xaxis if which == "x" else axes.yaxis
    power = common_power(*sorted(axis.get_view_interval())) if axis.get_scale() == "linear" else 0
    if power:
        axis.set_major_formatter(FuncFormatter(PowerFormat(power)))
    text = with_unit(title, unit, power)
    if heading is None:
        axis.set_label_text(text)
    else:
        axes.set_title(f"{heading} {text}", loc="left")


class PowerFormat:
    """Format of the numbers of an axis divided by a power of ten."""

    def __init__(self, power: int) -> None:
        self.scale = 10.0**power

    def __call__(self, value: float, place: int | None = None) -> str:
        return f"{round(value / self.scale, 6) + 0.0:g}".replace("-", "−")


def logarithmic(axis: Any) -> None:
    """Makes the axis logarithmic: numbers at powers of ten or, if these are few, also between them."""
    (axis.axes.set_xscale if axis.axis_name == "x" else axis.axes.set_yscale)("log")
    low, high = sorted(axis.get_view_interval())
    decades = math.log10(high / low) if low > 0 else 1
    axis.set_major_locator(LogLocator(subs=(1, 2, 5) if decades < 1 else (1, 3) if decades < 2 else (1,), numticks=7))
    axis.set_minor_locator(LogLocator(subs=range(2, 10), numticks=99) if decades < 5 else NullLocator())
    axis.set_major_formatter(FuncFormatter(logarithmic_number))
    axis.set_minor_formatter(NullFormatter())


def logarithmic_number(value: float, place: int | None = None) -> str:
    power = math.floor(math.log10(value) + 1e-9)
    times = round(value / 10.0**power)
    if power in (0, 1) or times > 1 and -3 < power < 4:
        return f"{value:g}"
    return f"${'' if times == 1 else f'{times}·'}10^{{{power}}}$"


def write(figure: Figure, paths: Sequence[Path], title: str, dpi: int = 300, style: Any = None) -> None:
    """Writes a figure to files of the formats that they name. The same figure gives the same bytes. Raises OSError."""
    from talus.simulation import _extension

    software = _extension().version_text
    metadata: dict[str, dict[str, Any]] = {
        ".pdf": {"Title": title, "Creator": software, "CreationDate": None, "ModDate": None},
        ".svg": {"Title": title, "Creator": software, "Date": None},
        ".png": {"Title": title, "Software": software},
    }
    with styled(style):
        for path in paths:
            drawn = io.BytesIO()  # on a full disk savefig can fail with an error of another kind
            figure.savefig(drawn, format=path.suffix[1:], dpi=dpi, metadata=metadata[path.suffix], facecolor="white")
            path.write_bytes(drawn.getvalue())
