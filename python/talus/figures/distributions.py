"""Distributions over grains and contacts in single frames, as means over the runs: of stress ratios, forces, directions."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from talus.figures.data import Data, ShownFrames, Wanted, reading, rounded, runs_text, shown_frames, shows_paper
from talus.figures.groups import Group
from talus.figures.means import mean_rows
from talus.figures.panels import Key, Page, arrange, band, has_numbers, mark_panels, panels, points_with_errors
from talus.figures.runs import AnalysedRun
from talus.figures.style import AXIS, COLOURS, LAW, MARK, as_math, curve_style, letter, logarithmic, set_title
from talus.figures.tables import Column, Table, column
from talus.simulation import _extension

# A panel for each periodic bed.


def headings(data: Data, axes: Sequence[Axes]) -> None:
    for k, (each, group) in enumerate(zip(axes, data.groups)):
        each.set_title(f"{letter(k)} {as_math(group.legend)}" if len(axes) > 1 else as_math(group.legend), loc="left")


def gamma_density(groups: Sequence[Group], wanted: Wanted) -> Data | None:
    data = Data("Probability density of the stress ratio gamma = q/p of the grains that carry something, periodic beds; vertical lines: "
                "Gamma_c = sin(theta_c), the threshold printed in the paper, and 2 Gamma_c, each the mean over the runs. Means over the "
                "runs of a bed, at angles that at least half of them reach; bands: standard error of the mean, if there are several runs.")
    chosen = [(group, runs) for group in groups
              if (runs := group.select(lambda run: run.periodic and run.thresholds and run.has_distributions))]
    if not chosen:
        return None
    data.caption += " " + reading(chosen[0][1][0])
    for (group, runs), shown in zip(chosen, shown_frames([runs for _, runs in chosen], wanted.at, ("0", "10", "15"))):
        edges = runs[0].values("gamma/edge")
        columns = [column("gamma", "1", "middle of the bin", 0.5 * (edges[1:] + edges[:-1]))]
        for frames in shown:
            columns += density_columns(frames, len(runs), len(edges) - 1)
        added = data.add_group(group, runs, columns)
        added.facts["gamma_c"] = float(np.mean([run.number("gamma_c") for run in runs]))
    shown = with_values(shown, data, "density_")
    data.caption += f" Shown {', '.join(frames.text for frames in shown)}."
    return data


def with_values(shown: Sequence[ShownFrames], data: Data, before: str) -> list[ShownFrames]:
    """Returns the frames for which a group has a number in the column of this beginning, and notes them for the drawing."""
    found = [frames for frames in shown if any(not np.isnan(group.table[before + frames.name]).all() for group in data.groups)]
    data.facts["shown"] = [(frames.name, frames.label) for frames in found]
    return found


def density_columns(frames: ShownFrames, runs: int, bins: int) -> list[Column]:
    name = "density_" + frames.name
    meaning = f"probability density of gamma {frames.text}, {runs_text(len(frames.runs))}"
    if 2 * len(frames.runs) >= runs:
        return frames.mean("gamma/density", name, "1", meaning)
    return [column(name, "1", meaning, np.full(bins, np.nan)), column(name + "_error", "1", meaning, np.full(bins, np.nan))]


def draw_gamma_density(data: Data, page: Page) -> Figure:
    axes = panels(page, len(data.groups), row=0.66 * page.width if page.narrow else 5.5, wide=2, narrow=1)
    key = Key()
    for k, (_, label) in enumerate(data.facts["shown"]):
        key.line(label, **curve_style(k))
    key.line("Γ$_c$ and 2 Γ$_c$", **LAW)
    for each, group in zip(axes, data.groups):
        table = group.table
        for k, (name, _) in enumerate(data.facts["shown"]):
            if group.count > 1:
                band(each, table["gamma"], table["density_" + name], table[f"density_{name}_error"], color=COLOURS[k % len(COLOURS)], alpha=0.3)
            each.plot(table["gamma"], table["density_" + name], **curve_style(k), markevery=3)
        for threshold, name in ((group.facts["gamma_c"], "Γ$_c$"), (2 * group.facts["gamma_c"], "2 Γ$_c$")):
            if threshold <= 1:
                each.axvline(threshold, **LAW)
        each.set_xlim(0, 1)
        each.set_ylim(0)
        set_title(each, "x", "$γ$")
        set_title(each, "y", "$P(γ)$")
    headings(data, axes)
    return arrange(axes, key, page=page)


#: Diameters of neighbourhoods, D; 0: the single grain.
SCALES = np.array([0, 1.5, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 18, 20])


def overloaded_over_scale(groups: Sequence[Group], wanted: Wanted) -> Data | None:
    data = Data("Fraction p_o of the grains whose neighbourhood of diameter l has a stress ratio gamma_l of at least Gamma_c = "
                "sin(theta_c), over l, among the grains that carry something: the single grain at l = 0, with its first neighbours from "
                "about 2 D; periodic beds.")
    chosen = [(group, runs) for group in groups if (runs := group.select(lambda run: run.periodic and run.failed and run.has_frames))]
    if not chosen:
        return None
    data.facts["paper"] = shows_paper([group for group, _ in chosen], wanted)
    for (group, runs), shown in zip(chosen, shown_frames([runs for _, runs in chosen], wanted.at, ("0", "15", "repose"))):
        scales = SCALES[SCALES <= runs[0].core.length_cut()]
        columns = [column("l", "D", "diameter of the neighbourhood; 0: the single grain", scales)]
        for frames in shown:
            columns += share_columns(frames, len(runs), scales)
        data.add_group(group, runs, columns)
    shown = with_values(shown, data, "p_o_")
    data.caption += " Dashed line: the paper's p_o at theta_c, 0.60." if data.facts["paper"] else ""
    data.caption += (" Means over the failed runs of a bed, at angles that at least half of them reach; error bars are standard errors "
                     f"over the runs, none for a single run. Shown {', '.join(frames.text for frames in shown)}.")
    return data


def share_columns(frames: ShownFrames, runs: int, scales: np.ndarray) -> list[Column]:
    """Returns the mean over the runs of p_o at each scale, and its error; NaN if fewer than half of the runs remain."""
    mean = error = np.full(len(scales), np.nan)
    if 2 * len(frames.runs) >= runs:
        mean, error = mean_rows([run.core.overloaded_over_scale(k, scales.tolist()) for run, k in zip(frames.runs, frames.frames)])
    name = "p_o_" + frames.name
    return [column(name, "1", f"share of the grains that carry something with gamma_l >= Gamma_c {frames.text}, "
                   f"{runs_text(len(frames.runs))}", mean), column(name + "_error", "1", "its standard error over the runs", error)]


def draw_overloaded_over_scale(data: Data, page: Page) -> Figure:
    axes = panels(page, len(data.groups), row=0.66 * page.width if page.narrow else 5.5, wide=2, narrow=1)
    key = Key()
    for k, (_, label) in enumerate(data.facts["shown"]):
        key.line(label, **curve_style(k))
    if data.facts["paper"]:
        key.line("paper, $p_o$ at $θ_c$", **MARK)
    for each, group in zip(axes, data.groups):
        for k, (name, _) in enumerate(data.facts["shown"]):
            plot_with_errors(each, group.table["l"], group.table, "p_o_" + name, k)
        if data.facts["paper"]:
            each.axhline(0.6, **MARK)
        each.set_xlim(0, 1.03 * group.table["l"].max())
        each.set_ylim(0, 1)
        set_title(each, "x", "$ℓ$", "D")
        set_title(each, "y", "$p_o$")
    headings(data, axes)
    return arrange(axes, key, page=page)


# States of one bed: usually the start of the tilt, and just before failure.


@dataclass(frozen=True)
class States:
    """Data of a figure of distributions in some frames of the first bed that has failed."""

    caption: str  #: with {states}, "<frames> of <runs>"
    axis: tuple[str, str, str]  #: name, unit and meaning of the horizontal axis
    edges: str  #: quantity with the edges of its bins, or with the distances
    columns: tuple[tuple[str, str, str, str], ...]  #: name, unit, meaning and quantity

    def __call__(self, groups: Sequence[Group], wanted: Wanted) -> Data | None:
        chosen = [(group, runs) for group in groups if (runs := group.select(lambda run: run.failed and run.has_distributions))]
        if not chosen:
            return None
        group, runs = chosen[0]
        states = shown_frames([runs], wanted.at, ("frame0", "repose"))[0]
        edges = runs[0].values(self.edges)
        name, unit, meaning = self.axis
        if self.edges.endswith("edge"):
            columns = [column(name + "_from", unit, "lower edge of a bin of " + meaning, edges[:-1]),
                       column(name + "_to", unit, "its upper edge", edges[1:])]
        else:
            columns = [column(name, unit, meaning, edges)]
        for name, unit, meaning, quantity in self.columns:
            for state in states:
                columns += state.mean(quantity, f"{name}_{state.name}", unit, f"{meaning} {state.text}")
        data = Data(self.caption.format(states=states_text(group, runs, states)), tables=[Table("", columns)], runs=list(runs))
        data.facts = {"states": [(state.name, f"$θ$ = {rounded(state.tilt)}°") for state in states]}
        return data


def states_text(group: Group, runs: Sequence[AnalysedRun], states: Sequence[ShownFrames]) -> str:
    several = len(runs) > 1
    texts = [f"{state.text} (theta = {rounded(state.tilt)} deg{' in the mean' if several else ''})" for state in states]
    return f"{', '.join(texts)}: {'mean of ' if several else ''}{runs_text(len(runs))} of {group.label}"


ERRORS = ", with standard errors over the runs as bars if there are several"
contact_directions = States(
    "Probability density of the direction of contact normals, relative to the bed, {states}. Filled: each contact counted once; "
    "outlined: weighted with its normal force; thin circle: uniform, 1/pi per rad. A normal and its opposite are one direction; 0, 60 "
    "and 120 deg are marked.", ("direction", "deg", "the direction to the bed"), "contacts/direction_edge",
    (("density", "1/rad", "probability density of the direction", "contacts/direction_density"),
     ("by_force", "1/rad", "the same, contacts weighted with f_n,", "contacts/direction_density_by_force")))
force_distribution = States(
    "Probability density of the normal force f over its mean <f>, {states}" + ERRORS + "; (a) semilogarithmic, (b) double logarithmic.",
    ("force", "1", "the normal force over its mean"), "contacts/force_edge", (("density", "1", "probability density of f over <f>", "contacts/force_density"),))
correlations = States(
    "Correlation of the normal forces, of the stress ratio gamma of grains and of their mean stress, over distance, {states}" + ERRORS +
    ". Forces and mean stresses are divided by the mean of their layer of 2 D.",
    ("r", "D", "distance between two contact points, or two centres"), "correlation/distance",
    (("force", "1", "correlation of normal forces", "correlation/normal_force"), ("gamma", "1", "correlation of gamma", "correlation/gamma"),
     ("stress", "1", "correlation of the mean stress of grains", "correlation/mean_stress")))
weak_contacts = States(
    "Fabric of the weak contacts (normal force up to its mean) along the strong ones, 2 <cos 2 (direction - d)>, d the direction in "
    "which the strong contacts concentrate, over their mobilised friction, {states}" + ERRORS + ". Below 0 they lie across the force "
    "chains. Weak contacts right of the dashed line count as coherent.", ("mobilised", "1", "the mobilised friction"),
    "contacts/mobilisation_edge", (("fabric", "1", "fabric of weak contacts along the strong ones", "texture/weak_fabric_by_friction"),))


def key_of_states(data: Data) -> Key:
    key = Key()
    for k, (_, label) in enumerate(data.facts["states"]):
        key.line(label, **curve_style(k))
    return key


def plot_with_errors(axes: Axes, at: np.ndarray, table: Table, name: str, k: int) -> None:
    points_with_errors(axes, at, table[name], dy=table[name + "_error"], **curve_style(k))


def draw_contact_directions(data: Data, page: Page) -> Figure:
    """Draws a rose for each state. A normal and its opposite are the same direction, so each density is drawn twice."""
    table, states = data.tables[0], data.facts["states"]
    axes = panels(page, len(states), row=8 if page.narrow else 8.2, wide=2, narrow=1, projection="polar")
    edges = np.radians([*table["direction_from"], table["direction_to"][-1]])
    edges = np.concatenate([edges, edges[1:] + np.pi])
    largest = max(np.nanmax(table[f"{name}_{state}"]) for name in ("density", "by_force") for state, _ in states)
    for k, (each, (state, label)) in enumerate(zip(axes, states)):
        plain, by_force = (np.tile(table[f"{name}_{state}"], 2) for name in ("density", "by_force"))
        each.bar(edges[:-1], plain, np.diff(edges), align="edge", color="#bbbbbb", linewidth=0)
        each.plot(np.repeat(edges, 2)[1:-1], np.repeat(by_force, 2), color="#000000", linewidth=1)
        each.plot(np.linspace(0, 2 * np.pi, 200), np.full(200, 1 / np.pi), color="#000000", linewidth=0.4)
        each.set_ylim(0, 1.05 * largest)
        each.set_yticks([])
        each.set_xticks(np.radians([0, 60, 120, 180, 240, 300]), ["0°", "60°", "120°"] * 2)
        each.tick_params(axis="x", pad=0)
        each.grid(True, axis="x", **MARK)
        each.spines["polar"].set_visible(False)
        each.set_title(f"{letter(k)} {label}" if len(axes) > 1 else label, loc="left")
    key = Key()
    key.box("contacts", color="#bbbbbb")
    key.line("weighted by force", color="#000000", linewidth=1)
    key.line("all directions alike", color="#000000", linewidth=0.4)
    return arrange(axes, key, page=page)


def draw_force_distribution(data: Data, page: Page) -> Figure:
    table = data.tables[0]
    axes = panels(page, 2, row=5.5 if page.narrow else 6.5, wide=2, narrow=1, share_y=not page.narrow)
    at = np.sqrt(table["force_from"] * table["force_to"])
    for each, x in zip(axes, ((0, 10), (1e-3, 20))):
        for k, (name, _) in enumerate(data.facts["states"]):
            density = np.where(table["density_" + name] > 0, table["density_" + name], np.nan)
            error = table[f"density_{name}_error"]
            points_with_errors(each, at, density, dy=np.array([np.minimum(error, 0.999 * density), error]), **curve_style(k))
        each.set_xlim(x)
        each.set_ylim(1e-4, 10)
        logarithmic(each.yaxis)
        if x[0] > 0:
            logarithmic(each.xaxis)
        set_title(each, "x", "$f$ / ⟨$f$⟩")
        if has_numbers(each, "y"):
            set_title(each, "y", "$P(f$ / ⟨$f$⟩$)$")
    mark_panels(axes)
    return arrange(axes, key_of_states(data), page=page)


def draw_correlations(data: Data, page: Page) -> Figure:
    table, states = data.tables[0], data.facts["states"]
    axes = panels(page, len(states), row=5 if page.narrow else 6.2, wide=2, narrow=1, share_x=True, share_y=True)
    key = Key()
    for k, (name, label) in enumerate((("force", "normal forces"), ("gamma", "$γ$ of grains"), ("stress", "mean stress of grains"))):
        key.line(label, **curve_style(k))
        for each, (state, _) in zip(axes, states):
            plot_with_errors(each, table["r"], table, f"{name}_{state}", k)
    top = max(0.05, min(0.6, 1.1 * np.nanmax([each.dataLim.y1 for each in axes])))
    for k, (each, (_, label)) in enumerate(zip(axes, states)):
        each.axhline(0, **AXIS)
        each.set_xlim(0)
        each.set_ylim(1.1 * min(0, np.nanmin([one.dataLim.y0 for one in axes])) - 0.02 * top, top)
        each.set_title(f"{letter(k)} {label}" if len(axes) > 1 else label, loc="left")
        if has_numbers(each, "x"):
            set_title(each, "x", "$r$", "D")
        if has_numbers(each, "y"):
            set_title(each, "y", "correlation")
    return arrange(axes, key, page=page)


def draw_weak_contacts(data: Data, page: Page) -> Figure:
    table = data.tables[0]
    axes = panels(page, 1, row=0.7 * page.width)
    for k, (state, _) in enumerate(data.facts["states"]):
        plot_with_errors(axes[0], 0.5 * (table["mobilised_from"] + table["mobilised_to"]), table, "fabric_" + state, k)
    axes[0].axhline(0, **AXIS)
    axes[0].axvline(_extension()._coherent_mobilisation, **MARK)
    axes[0].set_xlim(0, 1)
    axes[0].set_ylim(-1.2, 1.2)
    set_title(axes[0], "x", r"mobilised friction $|f_t|$ / ($μ f_n$)")
    set_title(axes[0], "y", "fabric along strong contacts")
    key = key_of_states(data)
    key.line("coherent: from here on", **MARK)
    return arrange(axes, key, page=page)
