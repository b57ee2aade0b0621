"""Courses of single runs: cycles of the tilt, rearrangements, and the flow after failure until it comes to rest."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from talus.figures.angles import key_of_groups, place_lines
from talus.figures.data import Data, Wanted, runs_text
from talus.figures.groups import Group
from talus.figures.means import Series, mean_rows, series_of
from talus.figures.panels import Page, arrange, free_axes, has_numbers, mark_panels, panels, points_with_errors, set_range, shrink_texts
from talus.figures.runs import AnalysedRun, quantities
from talus.figures.style import (AXIS, CM, COLOURS, MARK, SYMBOLS, as_math, curve_style, letter, logarithmic, set_title)
from talus.figures.tables import Column, Table, column, short_text
from talus.simulation import _extension

# Cycles.


@dataclass
class TiltCycle:
    """A cycle of a history of the tilt, from one place where the tilt begins to rise to the next."""

    first: int  #: first index, the last index of the preceding cycle
    last: int
    top: int  #: last index with the highest tilt of the cycle
    is_closed: bool  #: whether the tilt has fallen after the top


def cycles_of(tilts: np.ndarray) -> list[TiltCycle]:
    """Returns the cycles of tilts in the order of time. A tilt that only falls or is held is one cycle."""
    cycles: list[TiltCycle] = []
    first = top = 0
    fallen = False
    for k in range(1, len(tilts)):
        if tilts[k] > tilts[k - 1] and fallen:
            cycles.append(TiltCycle(first, k - 1, top, True))
            first = top = k - 1
            fallen = False
        fallen = fallen or bool(tilts[k] < tilts[k - 1])
        if tilts[k] >= tilts[top]:
            top = k
    return [*cycles, TiltCycle(first, len(tilts) - 1, top, fallen)] if len(tilts) else cycles


def cycles_of_run(run: AnalysedRun) -> list[TiltCycle]:
    """Returns the cycles of the entire tilt, or up to the last frame before failure."""
    return cycles_of(run.tilts[: run.repose + 1] if run.failed else run.tilts)


def columns_of_cycles(run: AnalysedRun) -> list[Series]:
    amplitude = quantities()["contacts/fabric_amplitude"]
    return [series_of("volume_strain", "packing/volume_strain"), series_of("coordination", "contacts/coordination_number"),
            series_of("critical", "contacts/critical_share"),
            Series("anisotropy", "1", amplitude.definition, lambda each: each.values("contacts/fabric_amplitude")[:, 0]),
            series_of("overloaded", "overloaded/fraction") if run.thresholds else series_of("stress_ratio", "packing/stress_ratio")]


def cycles(groups: Sequence[Group], wanted: Wanted) -> Data | None:
    """Returns the cycles of the first group whose tilt falls at least once before failure."""
    for group in groups:
        runs = group.select(lambda run: run.has_file and any(cycle.is_closed for cycle in cycles_of_run(run)))
        if runs:
            break
    else:
        return None
    first = runs[0]
    text = (f"A bed whose tilt goes up and down: {group.label}, seed {first.seed}. (a) Tilt over time. Over the tilt, with a different "
            "colour for each cycle: (b) volume strain since the start of the tilt, (c) coordination number z, (d) share of the contacts "
            f"with fully mobilised friction nu, (e) {'overloaded fraction p_o' if first.thresholds else 'stress ratio of the packing Gamma'}, "
            "(f) amplitude of the anisotropy of the contacts. ")
    if first.failed:
        text += "The last cycle ends before failure. "
    text += ("(g, h, i) Accumulation over cycles: volume strain, z and nu at the end of each completed cycle (filled; 0: before the first) "
             f"and at its highest tilt (open), for {runs_text(len(runs))}{', mean and standard error.' if len(runs) > 1 else '.'}")
    return Data(text, tables=[loops(first), ends_of_cycles(runs)], runs=list(runs))


def loops(run: AnalysedRun) -> Table:
    """Returns a row for each frame with the number of its cycle; the last frame of a cycle is the first of the next."""
    cycles = cycles_of_run(run)
    frames = np.concatenate([np.arange(cycle.first, cycle.last + 1) for cycle in cycles])
    number = np.concatenate([np.full(cycle.last - cycle.first + 1, c) for c, cycle in enumerate(cycles, 1)])
    times = run.file.time
    return Table("", [column("cycle", "1", "number of the cycle, from 1", number),
                      column("time", "s", "time since the tilt began", times[frames] - times[0]),
                      column("theta", "deg", "tilt", run.tilts[frames]),
                      *(column(each.name, each.unit, each.meaning, each.values(run)[frames]) for each in columns_of_cycles(run))],
                 in_blocks=True)


def ends_of_cycles(runs: Sequence[AnalysedRun]) -> Table:
    """Returns a row for each cycle completed by all runs, and row 0 for the bed before the first: means over the runs at the
    end and at the top of the cycle, with their standard errors."""
    closed = [[cycle for cycle in cycles_of_run(run) if cycle.is_closed] for run in runs]
    count = min(map(len, closed))
    columns = [column("cycle", "1", "number of the cycle; 0: the bed before the first", np.arange(count + 1)),
               column("n", "1", "number of runs in the row", np.full(count + 1, len(runs)))]
    for each in columns_of_cycles(runs[0]):
        for place, meaning in (("end", "at the end of the cycle"), ("top", "at its highest tilt")):
            rows = []
            for run, of_run in zip(runs, closed):
                values = each.values(run)
                frames = [cycle.last if place == "end" else cycle.top for cycle in of_run[:count]]
                rows.append([values[0] if place == "end" else np.nan, *values[frames]])
            mean, error = mean_rows(rows)
            columns += [column(f"{each.name}_{place}", each.unit, f"{meaning}: {each.meaning}", mean),
                        column(f"{each.name}_{place}_error", each.unit, "its standard error over the runs", error)]
    return Table("ends", columns)


CYCLE_COLOURS = LinearSegmentedColormap.from_list("cycles", ("#a8cbe6", "#3b7ab0", "#0b2545"))


def draw_cycles(data: Data, page: Page) -> Figure:
    loop, ends = data.tables
    last = "overloaded" if "overloaded" in loop else "stress_ratio"
    titles = {"theta": ("$θ$", "deg"), "volume_strain": ("Volume strain", "%"), "coordination": ("Coordination number $z$", "1"),
              "critical": ("Critical contacts $ν$", "1"), "overloaded": ("Overloaded fraction $p_o$", "1"),
              "stress_ratio": ("Stress ratio Γ", "1"), "anisotropy": ("Anisotropy of the contacts", "1")}
    names = ("theta", "volume_strain", "coordination", "critical", last, "anisotropy", "volume_strain", "coordination", "critical")
    count = int(loop["cycle"][-1])
    axes = panels(page, 9, row=3.6 if page.narrow else 4.2)
    colours = ScalarMappable(Normalize(1, max(count, 2)), CYCLE_COLOURS)
    for k, (each, name) in enumerate(zip(axes, names)):
        factor = 100 if name == "volume_strain" else 1
        if k < 6:
            at, values = loop["time" if k == 0 else "theta"], factor * loop[name]
            blocks = loop.blocks()
            each.add_collection(LineCollection([np.column_stack([at[rows], values[rows]]) for rows in blocks],
                                               colors=colours.to_rgba([loop["cycle"][rows[0]] for rows in blocks]), linewidths=0.7))
            each.autoscale_view()
        else:
            for place, shift, look in (("end", 0.0, END), ("top", 0.15, TOP)):
                points_with_errors(each, ends["cycle"] + shift, factor * ends[f"{name}_{place}"],
                                   dy=factor * ends[f"{name}_{place}_error"], bars=0.5, **look)
            each.set_xlim(-0.5, ends["cycle"][-1] + 0.65)
            each.xaxis.set_major_locator(MaxNLocator(integer=True, nbins=6))
        set_range(each)
        set_title(each, "y", *titles[name], heading=letter(k))
        set_title(each, "x", "time since the tilt began" if k == 0 else "$θ$" if k < 6 else "cycle", "s" if k == 0 else "deg" if k < 6 else "1")
    key = key_of_groups(data)
    key.line("end of the cycle (g, h, i)", **END)
    key.line("highest tilt (g, h, i)", **TOP)
    figure = arrange(axes, key, page=page, above=1.0 if count > 1 else 0)
    if count > 1:
        width = min(6, 0.5 * page.width)
        scale = free_axes(figure, 0.5 * (page.width - width), figure.get_size_inches()[1] / CM - figure.talus_top - 0.45, width, 0.2)
        bar = figure.colorbar(colours, cax=scale, orientation="horizontal", ticks=MaxNLocator(integer=True, nbins=8))
        bar.ax.tick_params(length=0, pad=1.5)
        bar.ax.text(-0.03, 0.5, "cycle", transform=bar.ax.transAxes, ha="right", va="center", fontsize=7)
    return figure


END = {"color": COLOURS[1], "marker": "o", "markersize": 2.5, "linewidth": 0.6}
TOP = {"color": COLOURS[2], "marker": "o", "markersize": 2.8, "markerfacecolor": "white", "linestyle": (0, (4, 2)), "linewidth": 0.6}

# Rearrangements.


def event_columns(runs: Sequence[AnalysedRun]) -> list[Column]:
    """Returns the rearrangements of all runs, run by run."""
    rows = []
    for run in runs:
        if not run.values("events/kind").size:
            continue
        diameter, gravity = run.core.diameter, run.core.gravity
        energy = run.core.mean_mass * gravity * diameter
        chosen = run.values("events/kind") == 0  # EventKind::rearrangement
        rows.append(np.array([
            np.abs(run.values("events/begin")), np.full(len(chosen), float(run.seed)), run.values("events/energy") / energy,
            run.values("events/waiting"), run.values("events/duration") / np.sqrt(diameter / gravity), run.values("events/grains"),
            run.values("events/depth"), 1e6 * run.values("events/volume_strain"),
            1e6 * run.values("events/centre_of_mass_strain")])[:, chosen])
    names = (("theta", "deg", "magnitude of the tilt at which the rearrangement begins"), ("seed", "1", "seed of its run"),
             ("energy", "m g D", "energy released"), ("waiting", "deg", "tilt since the end of the preceding event"),
             ("duration", "sqrt(D/g)", "duration"), ("grains", "1", "grains moved"),
             ("depth", "D", "depth above which 95 % of their displacement lies"), ("volume_strain", "1e-6", "change of the volume strain"),
             ("centre_of_mass_strain", "1e-6", "change of the strain of the centre of mass"))
    values = np.concatenate(rows, axis=1) if rows else np.zeros((len(names), 0))
    return [column(*name, each) for name, each in zip(names, values)]


def share_table(name: str, values: Column, laws: Sequence[tuple[str, str, float, Callable[[np.ndarray], np.ndarray]]]) -> Table:
    """Returns the share of values that are at least as large as each value, and the same by laws (name, meaning, minimum,
    share from the minimum upwards), scaled to the share of the values at their minimum; NaN below it."""
    ascending = np.sort(values.values[values.values > 0])
    count = len(ascending)
    share = 1 - np.arange(count) / count if count else np.array([np.nan])
    ascending = ascending if count else np.array([np.nan])
    columns = [column(values.name, values.unit, values.meaning, ascending),
               column("share", "1", "share of values that are at least as large", share)]
    for law, meaning, minimum, share_from in laws:
        below = np.searchsorted(ascending, minimum)
        with np.errstate(invalid="ignore"):
            by_law = np.where(ascending >= minimum, (1 - below / max(count, 1)) * share_from(ascending), np.nan)
        columns.append(column(law, "1", meaning, by_law))
    return Table(name, columns)


def events(groups: Sequence[Group], wanted: Wanted) -> Data | None:
    data = Data("Rearrangements of the bed before failure, bursts of motion between two quiet periods, for all runs of a group together: "
                "(a) share that released at least a given energy, in m g D; lines: maximum-likelihood power law, density ~ E^-α, from the "
                "energy with the smallest Kolmogorov-Smirnov distance. (b) share with at least a given waiting angle, the tilt since the "
                "end of the preceding event; solid lines: power law, dotted: exponential law beyond the shortest. (c) energy over the tilt "
                "at which each begins. (d) change of the height of the centre of mass over its height at the start, in 1e-6: above 0 the bed "
                "dilates, below it compacts; the axis is linear near 0 and logarithmic beyond.")
    core = _extension()
    for group in groups:
        runs = group.select(lambda run: run.has_file)
        columns = event_columns(runs)
        if not len(columns[0].values):
            continue
        added = data.add_group(group, runs, columns)
        energy, waiting = columns[2], columns[3]
        size, wait = core._power_law(energy.values.tolist()), core._power_law(waiting.values.tolist())
        shortest = float(np.nanmin(waiting.values)) if not np.isnan(waiting.values).all() else np.nan
        mean, mean_error, waits = core._exponential_law(waiting.values.tolist(), shortest)
        power = "the same from the maximum-likelihood power law; NaN below its minimum"
        exponential = "the same from the maximum-likelihood exponential law"
        added.facts["sizes"] = share_table("sizes-" + added.table.name, energy, [power_law("power_law", power, size)])
        added.facts["waits"] = share_table("waits-" + added.table.name, waiting, [
            power_law("power_law", power, wait),
            ("exponential_law", exponential, np.nan if np.isnan(mean) else shortest, lambda x: np.exp((shortest - x) / mean))])
        data.tables += [added.facts["sizes"], added.facts["waits"]]
        count = len(energy.values)
        added.facts["size_law"] = (f"too few for a law: {count}" if np.isnan(size[0])
                                   else f"$α$ = {core._plus_minus(size[0], size[1])} ({size[3]} of {count})")
        added.facts["wait_law"] = (f"too few for a law: {waits}" if np.isnan(wait[0]) or np.isnan(mean)
                                   else f"$α$ = {core._plus_minus(wait[0], wait[1])}, mean {core._plus_minus(mean, mean_error)}°")
    return data if data.groups else None


def power_law(name: str, meaning: str, law: tuple[float, float, float, int]) -> tuple[str, str, float, Callable[[np.ndarray], np.ndarray]]:
    exponent, _, minimum, _ = law
    return name, meaning, np.nan if np.isnan(exponent) else minimum, lambda x: (x / minimum) ** (1 - exponent)


def draw_events(data: Data, page: Page) -> Figure:
    groups = data.groups
    axes = panels(page, 4, row=(4.8 if page.narrow else 5.3), wide=2, narrow=1)
    points = {"linestyle": "none", "markersize": 2.2, "markeredgewidth": 0.5}
    for k, group in enumerate(groups):
        look, colour = curve_style(k) | points, COLOURS[k % len(COLOURS)]
        sizes, waits, table = group.facts["sizes"], group.facts["waits"], group.table
        axes[0].plot(sizes["energy"], sizes["share"], **look)
        axes[0].plot(sizes["energy"], sizes["power_law"], color=colour, linewidth=0.8)
        axes[1].plot(waits["waiting"], waits["share"], **look)
        axes[1].plot(waits["waiting"], waits["power_law"], color=colour, linewidth=0.8)
        axes[1].plot(waits["waiting"], waits["exponential_law"], color=colour, linewidth=0.6, linestyle=(0, (2, 2)))
        axes[2].plot(table["theta"], np.where(table["energy"] > 0, table["energy"], np.nan), **look)
        axes[3].plot(table["theta"], table["centre_of_mass_strain"], **look)
    for each, law in ((axes[0], "size_law"), (axes[1], "wait_law")):
        each.set_ylim(0.7 / max(len(group.table) for group in groups), 1.5)
        each.set_xlim(positive_range(each.dataLim.intervalx, each.dataLim.minposx))
        logarithmic(each.xaxis)
        logarithmic(each.yaxis)
        place_lines(each, [group.facts[law] for group in groups], "(a) " if each is axes[0] else "(b) ")
    axes[2].set_ylim(positive_range(axes[2].dataLim.intervaly, axes[2].dataLim.minposy))
    logarithmic(axes[2].yaxis)
    symmetric(axes[3])
    end = 1.03 * max(max(group.table["theta"]) for group in groups)
    for each in axes[2:]:
        each.set_xlim(0, end or 1.0)
        set_title(each, "x", "$θ$", "deg")
    set_title(axes[0], "x", "energy released $E$ / ($mgD$)")
    set_title(axes[1], "x", "waiting angle", "deg")
    for each, title in zip(axes, ("share with $E$ or more", "share with as long or longer", "$E$ / ($mgD$)", "$Δy/y$ ($10^{-6}$)")):
        set_title(each, "y", title)
    for k in (2, 3):
        axes[k].set_title(letter(k), loc="left")
    key = key_of_groups(data, True)
    key.line("power law (a, b)", color="#000000", linewidth=0.8)
    key.line("exponential law (b)", color="#000000", linewidth=0.6, linestyle=(0, (2, 2)))
    return arrange(axes, key, page=page)


def positive_range(interval: np.ndarray, least: float) -> tuple[float, float]:
    """Returns the range of a logarithmic axis with room for all positive values."""
    low, high = least, interval[1]
    if not (np.isfinite(low) and high > 0):
        low = high = 1.0
    room = (high / low) ** 0.05 if high > low else 4.0
    return float(low / room), float(high * room)


def symmetric(axes: Axes) -> None:
    """Makes the axis of the changes of height linear within about 1e-6 and logarithmic beyond, with numbers at powers of ten."""
    largest = 2 * max(1.0, np.abs(axes.dataLim.intervaly).max() if np.isfinite(axes.dataLim.intervaly).all() else 1.0)
    axes.axhline(0, **AXIS)
    axes.set_yscale("function", functions=(lambda y: np.arcsinh(0.5 * y), lambda y: 2 * np.sinh(y)))
    powers = np.arange(np.floor(np.log10(largest)), -0.5, -max(1, np.ceil(np.log10(largest) / 3)))
    powers = [power for power in powers if np.arcsinh(0.5 * 10**power) > 0.18 * np.arcsinh(0.5 * largest)]  # far enough from 0
    axes.set_yticks([0, *(sign * 10.0**power for sign in (1, -1) for power in powers)],
                    ["0", *(f"{sign}$10^{{{int(power)}}}$" if power else f"{sign}1" for sign in ("", "−") for power in powers)])
    axes.set_ylim(-largest, largest)
    for y, word in ((0.93, "dilates"), (0.03, "compacts")):
        axes.text(0.03, y, word, transform=axes.transAxes, fontsize=6.5, color="#707070", va="bottom" if y < 0.5 else "top")


# The dynamic angle of repose.

SECONDS_BEFORE_FAILURE = 2.0


def dynamic_angle(groups: Sequence[Group], wanted: Wanted) -> Data | None:
    data = Data()
    shown: tuple[Group, AnalysedRun] | None = None
    for group in groups:
        runs = group.select(lambda run: not np.isnan(run.theta_r))
        if not runs:
            continue
        data.add_group(group, runs, rest_columns(runs))
        data.facts.setdefault("factors", [short_text(factor) for factor in runs[0].values("threshold_factor")])
        shown = shown or next(((group, run) for run in runs if run.has_file), None)
    if not data.groups:
        return None
    data.caption = (
        f"Angle at rest theta_r, the dynamic angle of repose, of {runs_text(len(data.runs))}, (a) over the angle of repose theta_c and "
        "(b, c, d) over theta_d by each of its estimators; the line is theta_r = theta. (b) and (c): jump of l_c max and percolation of the "
        "overloaded grains, filled for the first threshold, open for the last; bars extend to the preceding frame. (d): onset of "
        "dilation, filled from the volume, open from the centre of mass; bars are the range in which the strain equals its minimum "
        "within the noise.")
    if shown is not None:
        group, run = shown
        data.caption += f" (e) Tilt and velocity of the surface layer over the time since failure: {group.label}, seed {run.seed}."
        data.facts["trace"] = flow_trace(run)
        data.tables.append(data.facts["trace"])
    return data


def rest_columns(runs: Sequence[AnalysedRun]) -> list[Column]:
    """Returns theta_r, theta_c and theta_d by each estimator with its range: an angle that is determined from two frames lies
    between them, and has no range if there is no earlier frame."""
    columns = [column("seed", "1", "seed of the run", [run.seed for run in runs]),
               column("theta_r", "deg", "angle at rest", [run.theta_r for run in runs]),
               column("theta_c", "deg", "angle of repose", [run.theta_c for run in runs])]

    def add(name: str, meaning: str, tilt: list[float], low: list[float], high: list[float]) -> None:
        columns.extend([column(name, "deg", "theta_d by " + meaning, tilt), column(name + "_low", "deg", "lower end of its range", low),
                        column(name + "_high", "deg", "upper end of its range", high)])

    for f, factor in enumerate(map(short_text, runs[0].values("threshold_factor"))):
        for name, meaning in (("lc_jump", "the jump of l_c max"), ("percolation", "percolation of the overloaded grains")):
            tilt = np.array([run.number("theta_d/" + name, f) for run in runs])
            spacing = np.nan_to_num([run.number(f"theta_d/{name}_error", f) for run in runs])
            add(f"{name}_{factor}", f"{meaning}, threshold {factor} Gamma_c", tilt, tilt - spacing, tilt)
    for s, (name, meaning) in enumerate((("volume", "volume"), ("centre", "centre of mass"))):
        add("dilation_" + name, "the onset of dilation, " + meaning,
            *([run.number("theta_d/dilation" + end, s) for run in runs] for end in ("", "_low", "_high")))
    return columns


def flow_trace(run: AnalysedRun) -> Table:
    """Returns the history of a run from shortly before failure: tilt, and mean velocity of the surface layer between two rows
    of observables."""
    file = run.file
    rows = file.observables
    time, moved = rows["time"], rows["surface_displacement"] * file.D
    failure = time[rows["step"] <= file._last_tilt_step][-1]
    interval = np.diff(time)
    shown = np.flatnonzero((time[1:] >= failure - SECONDS_BEFORE_FAILURE) & (interval > 0))
    velocity = np.diff(moved)[shown] / interval[shown] / np.sqrt(file.gravity * file.D)
    return Table("trace", [column("time", "s", "time since failure", time[1:][shown] - failure),
                           column("theta", "deg", "tilt", rows["tilt"][1:][shown]),
                           column("velocity", "sqrt(g D)", "mean velocity of the surface layer since the preceding row", velocity)])


def draw_dynamic_angle(data: Data, page: Page) -> Figure:
    trace = data.facts.get("trace")
    axes = panels(page, 4, row=4.2, wide=4, narrow=2, share_y=True)
    first, last = data.facts["factors"][0], data.facts["factors"][-1]
    pairs = (("theta_c",), (f"lc_jump_{first}", f"lc_jump_{last}"), (f"percolation_{first}", f"percolation_{last}"),
             ("dilation_volume", "dilation_centre"))
    rests = np.concatenate([group.table["theta_r"] for group in data.groups])
    low, high = np.floor(rests.min()) - 1, np.ceil(rests.max()) + 1
    end = max(24.0, *(np.ceil(group.table["theta_c"].max()) + 1 for group in data.groups))
    for k, (each, names, title) in enumerate(zip(axes, pairs, ("$θ_c$", "$θ_d$ ($ℓ_c$ max)", "$θ_d$ (percolation)", "$θ_d$ (dilation)"))):
        each.plot([low, high], [low, high], **MARK)
        for g, group in enumerate(data.groups):
            table, colour = group.table, COLOURS[g % len(COLOURS)]
            for name, face, size in zip(names, (colour, "white"), (2.4, 3.0)):
                ends = None if k == 0 else np.array([table[name] - table[name + "_low"], table[name + "_high"] - table[name]])
                points_with_errors(each, table[name], table["theta_r"], dx=ends, bars=0.5, linestyle="none", marker=SYMBOLS[g % len(SYMBOLS)],
                                   color=colour, markerfacecolor=face, markersize=size, markeredgewidth=0.6)
        each.set_xlim(0, end)
        each.set_ylim(low, high)
        set_title(each, "x", title, "deg")
        if has_numbers(each, "y"):
            set_title(each, "y", "$θ_r$", "deg")
    mark_panels(axes)
    key = key_of_groups(data, True, linestyle="none")
    key.line("$θ_r$ = abscissa", **MARK)
    if trace is not None:
        key.line("$θ$ (e)", color="#000000")
        key.line("surface velocity (e)", color=COLOURS[1], linewidth=0.6)
    figure = arrange(axes, key, page=page, below=4.4 if trace is not None else 0)
    if trace is not None:
        draw_trace(free_axes(figure, 1.3, 1.0, page.width - 2.8, 2.9), trace)
    return figure


def draw_trace(axes: Axes, trace: Table) -> None:
    velocity = axes.twinx()
    velocity.plot(trace["time"], trace["velocity"], color=COLOURS[1], linewidth=0.6)
    axes.plot(trace["time"], trace["theta"], color="#000000")
    axes.tick_params(right=False)
    velocity.tick_params(labelcolor=COLOURS[1])
    velocity.set_ylim(0, 1.1 * max(np.nanmax(trace["velocity"]), 1e-12))
    axes.margins(x=0.02)
    set_title(axes, "x", "time since failure", "s")
    set_title(axes, "y", "$θ$", "deg")
    set_title(velocity, "y", "surface velocity / $(gD)^{1/2}$")
    velocity.yaxis.label.set_color(COLOURS[1])
    axes.set_title(letter(4), loc="left")
    shrink_texts(axes.figure, [axes, velocity])
