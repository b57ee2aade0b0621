"""Pictures of single beds: maps of grains, contacts as lines, the neighbourhoods of a grain, the network of forces."""

import os
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection, LineCollection
from matplotlib.figure import Figure

from talus.figures.data import Data, Wanted, frames_of, reading, rounded
from talus.figures.groups import Group
from talus.figures.means import SAME_ANGLE, series_of
from talus.figures.panels import (GAP, Key, Page, arrange, draw_curves, free_axes, has_numbers, key_of_curves, mark_panels, panels,
                                  set_range, strip)
from talus.figures.runs import AnalysedRun, quantities
from talus.figures.style import CM, LAW, MARK, curve_style, letter, new_figure, set_title
from talus.figures.tables import Column, Table, column, short_text
from talus.simulation import _extension


def failed_bed(groups: Sequence[Group]) -> tuple[Group, AnalysedRun] | None:
    """Returns the first run that has failed and has frames; periodic beds come first."""
    return next(((group, run) for group in groups for run in group.runs if run.failed and run.has_frames), None)


def bed_text(group: Group, run: AnalysedRun) -> str:
    return f"{group.label}, seed {run.seed}"


# Maps at growing tilt (paper, Figs. 10 and 13), drawn by the renderer of the program.

ITS_ANGLES = (0, 5, 10, 15)


def panel_frames(run: AnalysedRun, at: Sequence[str]) -> list[int]:
    """Returns the frames of `at`, or those nearest to the paper's angles before theta_c, and the last before theta_c."""
    if at:
        return frames_of(run, at)
    first, tilts, _ = run.rise
    reach = 0.5 * np.abs(np.diff(tilts)).max(initial=0) + SAME_ANGLE
    near = [int(np.argmin(np.abs(tilts - angle))) for angle in ITS_ANGLES if angle < run.theta_c]
    near = [first + k for k, angle in zip(near, ITS_ANGLES) if abs(tilts[k] - angle) <= reach]
    return list(dict.fromkeys([min(k, run.repose) for k in near] + [run.repose]))


def panel_data(group: Group, run: AnalysedRun, wanted: Wanted, maps: list[tuple[str, float]], what: str) -> Data:
    """Returns the data of a panel of maps, each with its threshold over Gamma_c, without the columns of its table."""
    frames = panel_frames(run, wanted.at)
    text = f"{what}; {bed_text(group, run)}. From top to bottom theta = {', '.join(rounded(run.tilts[k]) for k in frames)} deg, "
    if not wanted.at:
        text += "the last of them the frame before failure at "
    text += f"theta_c = {rounded(run.theta_c)} deg"
    beyond = [str(angle) for angle in ITS_ANGLES if angle >= run.theta_c]
    if beyond and not wanted.at:
        text += f"; the paper's {' and '.join(beyond)} deg lies beyond it and is left out"
    text += f". The bed is shown in its own frame, with the direction of gravity; hatched grains are the floor. {reading(run)}"
    table = Table("", [column("theta", "deg", "tilt of the panel", run.tilts[frames])])
    return Data(text, tables=[table], runs=[run], facts={"frames": frames, "maps": maps})


def gamma_maps(groups: Sequence[Group], wanted: Wanted) -> Data | None:
    found = failed_bed(groups)
    if found is None:
        return None
    group, run = found
    gamma_c, white = run.number("gamma_c"), _extension()._white_below
    data = panel_data(group, run, wanted, [("gamma", 1.0)], f"Stress ratio gamma of each grain: white below {rounded(white)}, black from "
                      f"2 Gamma_c = {rounded(2 * gamma_c, 3)} upwards, linear gray between")
    frames = data.facts["frames"]
    data.tables[0].columns += [
        column("gamma_mean", "1", quantities()["gamma/mean"].definition, run.series("gamma/mean")[frames]),
        column("white", "1", "share of these grains that are white", [1 - run.core.share_from(k, white) for k in frames]),
        column("black", "1", "share of them that are black", [run.core.share_from(k, 2 * gamma_c) for k in frames])]
    return data


def overloaded_maps(groups: Sequence[Group], wanted: Wanted) -> Data | None:
    found = failed_bed(groups)
    if found is None:
        return None
    group, run = found
    factors = run.values("threshold_factor").tolist()
    data = panel_data(group, run, wanted, [("overloaded", factor) for factor in factors],
                      "Overloaded grains in black, with a column for each threshold of gamma")
    for f, factor in enumerate(factors):
        for name, quantity in (("p_o", "overloaded/fraction"), ("largest_share", "clusters/largest_share"),
                               ("spans_depth", "clusters/spans_depth")):
            row = quantities()[quantity]
            data.tables[0].columns.append(column(f"{name}_{rounded(factor, 3)}", row.unit,
                                                 f"{row.definition}, threshold {rounded(factor, 3)} Gamma_c",
                                                 run.series(quantity, f)[data.facts["frames"]]))
    return data


def draw_maps(data: Data, page: Page) -> Figure:
    """Shows the picture of a panel in a figure, for a notebook; files are written by the renderer itself (write_maps)."""
    import tempfile
    from pathlib import Path

    from matplotlib.image import imread

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "panel.png"
        write_maps(data, page, [path], "")
        picture = imread(path)
    figure = new_figure(page.width, page.width * picture.shape[0] / picture.shape[1])
    axes = figure.add_axes((0, 0, 1, 1))
    axes.imshow(picture, interpolation="antialiased")
    axes.set_axis_off()
    return figure


def write_maps(data: Data, page: Page, paths: Sequence[Any], title: str) -> None:
    """Writes a panel of maps: one bed in each row, on a page no higher than wanted or than one with a caption."""
    data.runs[0].core.write_panel(data.facts["frames"], data.facts["maps"], page.width, page.height or 1.4 * page.width,
                                  [os.fsencode(path) for path in paths], title)


# Contacts as lines (force chains, critical contacts).


def to_four_decimals(values: np.ndarray) -> np.ndarray:
    return np.copysign(np.floor(np.abs(values) * 1e4 + 0.5), values) / 1e4


def contact_table(run: AnalysedRun, k: int) -> Table:
    """Returns the contacts of a frame as lines in ascending order of force. A contact across the periodic edge is cut there."""
    contacts = run.file.frames[k].contacts
    start, end, shift, force = contacts.start, contacts.end, contacts.shift, contacts.force[:, 0]
    across = np.flatnonzero(shift != 0)
    edge = np.where(shift < 0, 0.0, contacts.period)
    with np.errstate(invalid="ignore", divide="ignore"):
        y = start[:, 1] + (end[:, 1] - start[:, 1]) * (edge - start[:, 0]) / (end[:, 0] - start[:, 0])
    cut = np.column_stack([edge, y])
    lines = np.column_stack([start, np.where(shift[:, None] != 0, cut, end)])
    period = np.where(shift < 0, -contacts.period, contacts.period)
    rest = np.column_stack([edge - period, y, end[:, 0] - period, end[:, 1]])[across]
    contact = np.concatenate([np.arange(len(force)), across])
    lines = np.concatenate([lines, rest])
    order = np.lexsort((np.arange(len(contact)) >= len(force), contact))  # both parts of a contact in turn
    order = order[np.argsort(force[contact[order]], kind="stable")]
    lines, contact = to_four_decimals(lines[order]), contact[order]
    end_text = "the other end: a centre, the periodic edge, or the point of contact at a wall"
    return Table("contacts", [
        column("x1", "D", "one end, along the bed: the centre of a grain, or the periodic edge", lines[:, 0]),
        column("y1", "D", "the same, across the bed", lines[:, 1]), column("x2", "D", end_text, lines[:, 2]),
        column("y2", "D", "the same, across the bed", lines[:, 3]),
        column("force", "1", "normal force over its mean", to_four_decimals(force[contact] / force.mean())),
        column("critical", "1", "1 if friction is fully mobilised, else 0", contacts.status[contact] == 2)])


def add_contact_map(data: Data, run: AnalysedRun, k: int) -> None:
    """Adds the contacts and the free surface of a frame, and the outline of the bed."""
    x, y = run.core.surface(k)
    surface = Table("surface", [column("x", "D", "distance along the bed", to_four_decimals(x)),
                                column("y", "D", "height of the free surface", to_four_decimals(y))])
    data.tables += [contact_table(run, k), surface]
    file = run.file
    data.facts |= {"length": file.length, "bottom": 0.0 if file.free.all() else -0.5, "periodic": file.periodic,
                   "top": np.ceil(surface["y"].max()) + 0.5, "tilt": float(run.tilts[k])}


def frame_text(group: Group, run: AnalysedRun, k: int, last: bool) -> str:
    return (f"{bed_text(group, run)}, at theta = {rounded(run.tilts[k])} deg, {'the last frame before failure at ' if last else ''}"
            f"theta_c = {rounded(run.theta_c)} deg")


def bed_size(data: Data, width: float, highest: float) -> tuple[float, float]:
    """Returns width and height (cm) of the map of a bed; a deep bed is drawn narrower."""
    margin = 0.01 * data.facts["length"]
    ratio = (data.facts["top"] - data.facts["bottom"] + margin) / (data.facts["length"] + 2 * margin)
    height = min(ratio * width, highest)
    return height / ratio, height


def draw_bed(axes: Axes, data: Data) -> None:
    """Draws the outline of the bed, dotted at periodic edges, and its free surface."""
    length, bottom, top = data.facts["length"], data.facts["bottom"], data.facts["top"]
    surface = next(table for table in data.tables if table.name == "surface")
    for x in (0, length):
        axes.plot([x, x], [bottom, top], **(LAW if data.facts["periodic"] else {"color": "#000000", "linewidth": 1}))
    axes.plot([0, length], [bottom, bottom], color="#000000", linewidth=0.5)
    axes.plot(surface["x"], surface["y"], color="#000000", linewidth=0.4)
    axes.set_xlim(-0.01 * length, 1.01 * length)
    axes.set_ylim(bottom - 0.01 * length, top)
    axes.set_axis_off()


def line_collection(table: Table, rows: np.ndarray, **look: Any) -> LineCollection:
    ends = np.stack([np.column_stack([table["x1"], table["y1"]]), np.column_stack([table["x2"], table["y2"]])], axis=1)
    return LineCollection(ends[rows], capstyle="round", **look)


def force_chains(groups: Sequence[Group], wanted: Wanted) -> Data | None:
    found = failed_bed(groups)
    if found is None:
        return None
    group, run = found
    k = frames_of(run, wanted.at)[0] if wanted.at else run.repose
    data = Data("Normal forces as lines between the centres of grains, their width proportional to the force, in ten classes of half the "
                "mean force, the last of them open; black: above the mean (strong network), gray: up to it (weak); "
                f"{frame_text(group, run, k, not wanted.at)}. Contacts across the periodic edge are cut there. The thin line is the free "
                "surface.", runs=[run], title="Force chains" if wanted.at else "")
    add_contact_map(data, run, k)
    return data


def draw_force_chains(data: Data, page: Page) -> Figure:
    """Draws the widest line about a third of a grain wide, so that chains stay separate."""
    two_lines = page.width < 13
    legend = 2.0 if two_lines else 1.2
    width, height = bed_size(data, page.width, page.height - legend if page.height > 4 else 1.2 * page.width)
    figure = new_figure(page.width, max(height + legend, page.height))
    axes = free_axes(figure, 0.5 * (page.width - width), legend, width, height)
    draw_bed(axes, data)
    table = data.tables[0]
    diameter = width / (1.02 * data.facts["length"])  # cm
    widest = min(0.36 * diameter, 0.2) / 2.54 * 72  # points
    classes = np.clip(np.ceil(2 * table["force"]), 1, 10).astype(int)
    looks = [{"colors": "#999999" if c <= 2 else "#000000", "linewidths": 0.1 * c * widest} for c in range(1, 11)]
    for c, look in enumerate(looks, 1):
        axes.add_collection(line_collection(table, classes == c, **look))
    below = strip(figure, 0, legend)
    bed_left = 0.5 * (page.width - diameter * data.facts["length"])
    scale_bar(below, bed_left, legend - 0.5 if two_lines else 0.6, data)
    samples = (1, 2, 4, 6, 8, 10)
    x = page.width - GAP - 1.15 * len(samples)
    below.text(x - 0.15, 0.55, "$f$ / ⟨$f$⟩", ha="right", va="center")
    for k, c in enumerate(samples):
        at = x + 1.15 * k
        below.add_collection(LineCollection([[(at + 0.1, 0.72), (at + 0.9, 0.72)]], **looks[c - 1]))
        below.text(at + 0.5, 0.3, f"{'> 4.5' if c == 10 else f'≤ {0.5 * c:g}'}", ha="center", va="center", fontsize=7)
    return figure


def scale_bar(axes: Axes, x: float, y: float, data: Data) -> None:
    """Draws a scale bar, the direction of gravity and the tilt from (x, y), in cm."""
    length = data.facts["length"]
    bar = next(bar for limit, bar in ((12, 1), (25, 2), (40, 5), (300, 10), (1000, 50), (np.inf, 100)) if length < limit)
    width = axes.get_xlim()[1]
    cm = (width - 2 * x) / length * bar
    axes.plot([x, x, x, x + cm, x + cm, x + cm], [y - 0.05, y + 0.05, y, y, y - 0.05, y + 0.05], color="#000000", linewidth=0.5)
    end = x + cm + 0.15
    axes.text(end, y, f"{bar} $D$", va="center")
    tilt, x = np.radians(data.facts["tilt"]), end + 1.2
    axes.annotate("", (x + 0.22 * np.sin(tilt), y - 0.22 * np.cos(tilt)), (x - 0.22 * np.sin(tilt), y + 0.22 * np.cos(tilt)),
                  arrowprops={"arrowstyle": "-|>", "linewidth": 0.5, "color": "#000000", "shrinkA": 0, "shrinkB": 0, "mutation_scale": 5})
    axes.text(x + 0.25, y, r"$\mathbf{g}$", va="center", fontsize=7)
    axes.text(x + 0.8, y, f"$θ$ = {rounded(data.facts['tilt'])}°", va="center")


def critical_contacts(groups: Sequence[Group], wanted: Wanted) -> Data | None:
    if not any(run.failed for group in groups for run in group.runs):
        return None
    data = Data("Critical contacts, whose friction is fully mobilised.")
    columns = [series_of("share", "contacts/critical_share"), series_of("largest", "contacts/critical_largest"),
               series_of("correlation_length", "contacts/critical_correlation_length")]
    for group in groups:
        data.add_curves(group, group.runs, columns)
    found = failed_bed(groups)
    letters = "abc"
    if found is not None:
        group, run = found
        data.caption += f" (a) Black: critical contacts, gray: the others; {frame_text(group, run, run.repose, True)}."
        add_contact_map(data, run, run.repose)
        if run.path not in [each.path for each in data.runs]:
            data.runs.append(run)
        letters = "bcd"
    data.facts["has_map"] = found is not None
    data.caption += (f" ({letters[0]}) Their share of the contacts, ({letters[1]}) contacts in their largest cluster, joined if they share "
                     f"a free grain, ({letters[2]}) correlation length of their clusters, over the tilt theta, up to theta_c.")
    data.describe_means(wanted)
    return data


def draw_critical_contacts(data: Data, page: Page) -> Figure:
    axes = panels(page, 3, row=3.8 if page.narrow else 4.8, wide=3, narrow=1, share_x=True)
    key = key_of_curves(data, symbols=False)
    above = 0.0
    if data.facts["has_map"]:
        width, height = bed_size(data, page.width, page.width)
        above = height + 0.6
        key.line("critical contacts", color="#000000", linewidth=1)
        key.line("other contacts", color="#bbbbbb", linewidth=0.6)
    largest = max(group.table["theta"].max(initial=0) for group in data.groups) or 1.0
    for k, (each, name, title) in enumerate(zip(axes, ("share", "largest", "correlation_length"), (
            "Critical share of the contacts", "Contacts in the largest cluster", "Correlation length"))):
        draw_curves(each, data, name, symbols=False)
        each.set_xlim(0, 1.04 * largest)
        set_range(each)
        each.set_ylim(0)
        set_title(each, "y", title, "D" if k == 2 else "1", heading=letter(k + data.facts["has_map"]))
        if has_numbers(each, "x"):
            set_title(each, "x", "$θ$", "deg")
    figure = arrange(axes, key, page=page, above=above)
    if data.facts["has_map"]:
        top = figure.get_size_inches()[1] / CM - figure.talus_top
        picture = free_axes(figure, 0.5 * (page.width - width), top - height, width, height)
        draw_bed(picture, data)
        table = next(table for table in data.tables if table.name == "contacts")
        for kind, look in ((0, {"colors": "#bbbbbb", "linewidths": 0.3}), (1, {"colors": "#000000", "linewidths": 1})):
            picture.add_collection(line_collection(table, table["critical"] == kind, **look))
        below = strip(figure, top - above, 0.5)
        below.text(0.35, 0.3, f"(a) $θ$ = {rounded(data.facts['tilt'])}°", va="center")
    return figure


# Growing neighbourhoods of one overloaded grain (paper, Fig. 11).

ITS_TILT = 10.0  # deg


def typical_grain(run: AnalysedRun, k: int) -> int | None:
    """Returns the grain of frame k whose l_c are closest to their means, with the smallest sum over the thresholds of
    |l_c / mean - 1|. Candidates are the free grains that are overloaded at each threshold, in the middle half of the height
    of the bed, and between walls also of its length. None without candidates."""
    file = run.file
    position = file.frames[k].position[file.free]
    lengths = run.values("lc/length")[k].reshape(run.thresholds, -1)[:, : len(position)]
    distance = np.abs(lengths / run.values("lc/mean")[k][:, None] - 1).sum(axis=0)
    inside = in_middle_half(position[:, 1], position[:, 1].max(initial=0))
    if not run.periodic:
        inside &= in_middle_half(position[:, 0], file.length)
    distance[~inside | np.isnan(distance)] = np.inf
    grain = int(np.argmin(distance))
    return grain if np.isfinite(distance[grain]) else None


def in_middle_half(values: np.ndarray, end: float) -> np.ndarray:
    return (values >= 0.25 * end) & (values <= 0.75 * end)


def neighbourhoods(groups: Sequence[Group], wanted: Wanted) -> Data | None:
    found = failed_bed(groups)
    if found is None:
        return None
    group, run = found
    tilt = run.tilts[frames_of(run, wanted.at)[0]] if wanted.at else ITS_TILT
    nearest = np.argsort(np.abs(run.tilts[: run.repose + 1] - tilt), kind="stable")
    k, grain = next(((int(k), grain) for k in nearest if (grain := typical_grain(run, int(k))) is not None), (0, -1))
    if grain < 0:
        return None
    lengths = run.values("lc/length")[k].reshape(run.thresholds, -1)[:, grain]
    shown = min(max(8.0, 2 * np.ceil(lengths.max())), run.number("lc/cut"))
    l, gamma_l = run.core.neighbourhood(k, grain, shown)
    data = Data(
        f"(a) Grain {grain} of {bed_text(group, run)} at theta = {rounded(run.tilts[k])} deg, outlined, and the surrounding grains in the "
        f"gray of their gamma, white below {rounded(_extension()._white_below)} and black from 2 Gamma_c upwards. A neighbourhood of "
        "diameter l contains all grains whose centres lie within the circle: thin circles every 2 D, thick ones at l_c. (b) Stress ratio "
        "gamma_l of the neighbourhood over l; l_c is the smallest l, starting from that of gamma, at which gamma_l is at most the "
        "threshold. Of the grains in the middle half of the bed that are overloaded at each threshold, this one has the l_c nearest to "
        f"their means. {reading(run)}", runs=[run])
    grains = grains_around(run, k, grain, 0.5 * shown + 0.5)
    data.tables = [
        Table("", [column("l", "D", "diameter of the neighbourhood", l),
                   column("gamma_l", "1", "stress ratio of the summed internal moments of its grains", gamma_l)]),
        grains,
        Table("l_c", [column("factor", "1", "threshold over Gamma_c", run.values("threshold_factor")),
                      column("threshold", "1", "threshold", run.values("threshold")),
                      column("l_c", "D", "smallest l with gamma_l <= threshold", lengths)])]
    data.facts = {"shown": float(shown), "gamma_c": run.number("gamma_c"), "radius": float(run.file.radius[grain])}
    return data


def grains_around(run: AnalysedRun, k: int, centre: int, distance: float) -> Table:
    """Returns the free grains with centres within a distance (D) of that of a grain, in a periodic bed the nearest images."""
    file = run.file
    position, gamma = file.frames[k].position, run.core.gamma(k)
    from_centre = position - position[centre]
    if run.periodic:
        from_centre[:, 0] -= np.round(from_centre[:, 0] / file.length) * file.length
    near = np.flatnonzero(file.free & (np.hypot(*from_centre.T) <= distance))
    return Table("grains", [column("x", "D", "centre, from the overloaded grain, along the bed", from_centre[near, 0]),
                            column("y", "D", "the same, across the bed", from_centre[near, 1]),
                            column("radius", "D", "radius", file.radius[near]),
                            column("gamma", "1", "stress ratio; NaN if a grain carries nothing", np.asarray(gamma)[near])])


def draw_neighbourhoods(data: Data, page: Page) -> Figure:
    curve, grains, lengths = data.tables
    shown, gamma_c, white = data.facts["shown"], data.facts["gamma_c"], _extension()._white_below
    dashes = ("-", (0, (4, 2)), (0, (1.5, 1.5)), (0, (5, 1.5, 1.5, 1.5)))
    axes = panels(page, 2, row=page.width - 1 if page.narrow else 8, wide=2, narrow=1)
    picture, plot = axes
    half = 0.5 * shown + 1.2
    tone = 1 - np.clip((grains["gamma"] - white) / (2 * gamma_c - white), 0, 1)
    tone = np.where(np.isnan(tone), 1, tone)
    diameters = 2 * grains["radius"]
    picture.add_collection(EllipseCollection(diameters, diameters, np.zeros(len(tone)), units="xy", offsets=np.column_stack([
        grains["x"], grains["y"]]), offset_transform=picture.transData, facecolors=[(t, t, t) for t in tone], edgecolors="#606060",
        linewidths=0.25))
    for radius in np.arange(1, int(shown / 2) + 1):
        ring(picture, radius, 0.5, "-")
    for k, length in enumerate(lengths["l_c"]):
        if 0.5 * length <= half:
            ring(picture, 0.5 * length, 1.3, dashes[k % 4])
    ring(picture, data.facts["radius"], 1.3, "-")
    picture.set_xlim(-half, half)
    picture.set_ylim(-half, half)
    picture.set_aspect("equal")
    picture.set_axis_off()
    gray_scale(picture, white, gamma_c)
    key = Key()
    plot.step(curve["l"], curve["gamma_l"], where="post", color="#000000")
    named = -1.0
    for k, (factor, threshold, length) in enumerate(zip(lengths["factor"], lengths["threshold"], lengths["l_c"])):
        name = f"{'' if factor == 1 else short_text(factor) + ' '}Γ$_c$"
        key.line(f"$ℓ_c$ = {length:.2f} $D$ at {name}", color="#000000", linestyle=dashes[k % 4])
        if threshold <= 1.05:
            plot.axhline(threshold, **MARK)
            if abs(threshold - named) > 0.08:
                named = threshold
                plot.annotate(name, (1, threshold), (3, 0), xycoords=("axes fraction", "data"), textcoords="offset points", va="center",
                              fontsize=7)
        plot.plot([length, length], [0, min(threshold, 1.05)], color="#000000", linestyle=dashes[k % 4])
    key.line("thresholds", **MARK)
    plot.set_xlim(0, shown)
    plot.set_ylim(0, 1.05)
    set_title(plot, "x", "$ℓ$", "D")
    set_title(plot, "y", "$γ_ℓ$")
    mark_panels(axes)
    return arrange(axes, key, page=page)


def ring(axes: Axes, radius: float, width: float, dash: Any) -> None:
    """Draws a circle about the origin that is visible on dark and on light grains."""
    from matplotlib.patches import Circle

    axes.add_patch(Circle((0, 0), radius, fill=False, edgecolor="white", linewidth=2 * width + 0.3))
    axes.add_patch(Circle((0, 0), radius, fill=False, edgecolor="black", linewidth=width, linestyle=dash))


def gray_scale(axes: Axes, white: float, gamma_c: float) -> None:
    """Draws the gray scale of gamma below a picture: white below `white`, black from 2 Gamma_c."""
    scale = axes.inset_axes((0.22, -0.06, 0.56, 0.035))
    scale.imshow(np.linspace(1, 0, 256)[None, :], cmap="gray", vmin=0, vmax=1, aspect="auto", extent=(white, 2 * gamma_c, 0, 1))
    scale.set_xticks([white, gamma_c, 2 * gamma_c], [f"{white:.2f}", "Γ$_c$", f"2 Γ$_c$ = {2 * gamma_c:.2f}"])
    scale.set_yticks([])
    scale.tick_params(top=False, direction="out", pad=1)
    scale.set_ylabel("$γ$", rotation=0, va="center", ha="right")


# Topology of the network of forces.


def persistence(groups: Sequence[Group], wanted: Wanted) -> Data | None:
    found = failed_bed(groups)
    if found is None:
        return None
    group, run = found
    first, tilts, _ = run.rise
    rise = slice(first, first + len(tilts))
    data = Data(f"The network of the contacts of {bed_text(group, run)} whose normal force is at least a threshold, as the threshold falls, "
                "in units of the mean force. (a) Its components, dots, of the first frame and of the last before theta_c: each is born at "
                "the largest force in it, and dies when it meets an older one. (b) Sum of birth - death of the components and of the "
                "loops, per grain; loops last down to 0. (c) Distance of the diagrams of each frame from those of the preceding frame, per "
                "grain; the dashed line is theta_c.", runs=[run])
    change = run.values("network/change")[rise]
    data.tables = [Table("", [
        column("theta", "deg", "magnitude of the tilt", tilts),
        column("components", "1", "total persistence of components, per grain", run.series("network/component_persistence")[rise]),
        column("loops", "1", "total persistence of loops, per grain", run.series("network/loop_persistence")[rise]),
        column("components_change", "1", "distance of component diagrams from the preceding frame", change[:, 0]),
        column("loops_change", "1", "distance of loop diagrams from the preceding frame", change[:, 1])])]
    for state, k in (("start", 0), ("repose", run.repose)):
        birth, death = run.core.force_components(k)
        data.tables.append(Table(state, [column("birth", "1", "largest normal force in a component, over the mean", birth),
                                         column("death", "1", "force at which it meets an older one, or 0", death)]))
        data.facts[state] = abs(float(run.tilts[k]))
    data.facts["theta_c"] = run.theta_c
    return data


def draw_persistence(data: Data, page: Page) -> Figure:
    axes = panels(page, 3, row=4.6 if page.narrow else 5.6, wide=3, narrow=1)
    curves, key = data.tables[0], Key()
    looks = ({"color": "#808080", "marker": "o", "markerfacecolor": "white"}, {"color": "#000000", "marker": "o"})
    for table, look in zip(data.tables[1:], looks):
        look = look | {"linestyle": "none", "markersize": 1.8, "markeredgewidth": 0.5}
        axes[0].plot(table["birth"], table["death"], **look)
        key.line(f"$θ$ = {rounded(data.facts[table.name])}° (a)", **look)
    highest = max(axes[0].dataLim.x1, axes[0].dataLim.y1, 1e-9)
    axes[0].plot([0, highest], [0, highest], **MARK)
    for k, name in enumerate(("components", "loops")):
        look = curve_style(k) | {"markersize": 2}
        key.line(f"{name} (b, c)", **look)
        for each, column_name in zip(axes[1:], (name, name + "_change")):
            each.plot(curves["theta"], curves[column_name], **look)
    key.line("death at birth (a); $θ_c$ (b, c)", **MARK)
    titles = (("birth, $f$ / ⟨$f$⟩", "death, $f$ / ⟨$f$⟩"), ("$θ$", "total persistence per grain"), ("$θ$", "change from frame to frame"))
    for k, (each, (x, y)) in enumerate(zip(axes, titles)):
        if k > 0:
            each.axvline(data.facts["theta_c"], **MARK)
        each.set_xlim(0, 1.1 * data.facts["theta_c"] if k else None)
        each.set_ylim(0)
        set_title(each, "x", x, "deg" if k else "1")
        set_title(each, "y", y)
    mark_panels(axes)
    return arrange(axes, key, page=page)
