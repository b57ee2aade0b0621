"""Results of groups of runs over the keys of the scenario in which they differ, as those of an ensemble with --vary."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from talus.ensemble import mean_of
from talus.figures.data import Data, Wanted, runs_text
from talus.figures.groups import SYMBOLS, UNITS, Group, essence, value_text
from talus.figures.panels import Key, Page, arrange, has_numbers, panels, points_with_errors
from talus.figures.runs import AnalysedRun, quantities
from talus.figures.style import as_math, curve_style, letter, set_title
from talus.figures.tables import Table, column, literal


@dataclass(frozen=True)
class Result:
    """A number of each run."""

    name: str
    unit: str
    title: str
    meaning: str
    value: Callable[[AnalysedRun], float]


def at_failure(quantity: str, title: str) -> Result:
    """Returns a quantity of frames just before failure, at the first threshold if it depends on one."""
    row = quantities()[quantity]
    return Result(f"{quantity}@theta_c", row.unit, f"{title} at $θ_c$", row.definition + ", in the last frame before failure",
                  lambda run: float(run.series(quantity)[run.repose]) if run.failed else np.nan)


def at_start(quantity: str, title: str) -> Result:
    row = quantities()[quantity]
    return Result(f"{quantity}@0", row.unit, f"{title} at the start", row.definition + ", in the first frame",
                  lambda run: float(run.series(quantity)[0]))


def results() -> list[Result]:
    return [
        Result("theta_c", "deg", "$θ_c$", "angle of repose", lambda run: run.theta_c),
        Result("theta_d/lc_jump", "deg", "$θ_d$ ($ℓ_c$)", "theta_d by the jump of the largest l_c", lambda run: run.number("theta_d/lc_jump")),
        Result("theta_d/dilation", "deg", "$θ_d$ (dilation)", "theta_d by the onset of dilation, free surface",
               lambda run: run.number("theta_d/dilation")),
        Result("theta_r", "deg", "$θ_r$", "angle at rest after failure", lambda run: run.theta_r),
        at_start("packing/solid_fraction", "Solid fraction"), at_start("contacts/coordination_number", "$z$"),
        at_failure("packing/stress_ratio", "Γ"), at_failure("overloaded/fraction", "$p_o$"), at_failure("lc/max", "Largest $ℓ_c$"),
        at_failure("contacts/critical_share", "$ν$"), at_failure("texture/contacts", "$a_c$")]


def varied_keys(groups: Sequence[Group]) -> list[str]:
    """Returns the keys of the scenario in which groups differ, that with the most values first."""
    keys = [essence(group.runs[0].scenario) for group in groups]
    names = dict.fromkeys(name for each in keys for name in each)
    values = {name: {value_text(each.get(name, "none")) for each in keys} for name in names}
    return sorted((name for name in names if len(values[name]) > 1), key=lambda name: -len(values[name]))


def is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def over_parameter(groups: Sequence[Group], wanted: Wanted) -> Data | None:
    """Returns the results over the first varied key, for each value of the second; None unless one or two keys vary."""
    groups = [group for group in groups if not group.departures]
    keys = varied_keys(groups)
    if not 1 <= len(keys) <= 2:
        return None
    places = [[essence(group.runs[0].scenario).get(key, "none") for key in keys] for group in groups]
    if len({value_text(place) for place in places}) < len(places):
        return None  # groups that differ in other ways
    columns = []
    for k, key in enumerate(keys):
        values = [place[k] for place in places]
        if all(map(is_number, values)):
            columns.append(column(key, "1", "value of the key", values))
        else:
            names = list(dict.fromkeys(map(value_text, values)))
            meaning = "value of the key: " + "; ".join(f"{n} {name}" for n, name in enumerate(names, 1))
            columns.append(column(key, "1", meaning, [names.index(value_text(value)) + 1 for value in values]))
    order = np.lexsort([each.values for each in columns])
    groups = [groups[k] for k in order]
    for each in columns:
        each.values = each.values[order]
    columns.append(column("n", "1", "number of runs", [len(group.runs) for group in groups]))
    shown = []
    for result in results():
        means = [mean_of([result.value(run) for run in group.runs]) for group in groups]
        if not any(mean.count for mean in means):
            continue
        columns += [column(result.name, result.unit, result.meaning, [mean.mean for mean in means]),
                    column(result.name + "_error", result.unit, "its standard error over the runs", [mean.error for mean in means])]
        shown.append((result.name, result.title, result.unit))
    data = Data(f"Results of runs over {' and '.join(keys)}: means over the runs of each group, and their standard errors as bars, none for "
                "a single run.", tables=[Table("", columns)], runs=[run for group in groups for run in group.runs])
    data.facts = {"keys": keys, "shown": shown, "texts": [list(dict.fromkeys(value_text(place[k]) for place in [places[m] for m in order]))
                                                          for k in range(len(keys))],
                  "numeric": [all(is_number(place[k]) for place in places) for k in range(len(keys))]}
    return data


def draw_over_parameter(data: Data, page: Page) -> Figure:
    table, keys, shown = data.tables[0], data.facts["keys"], data.facts["shown"]
    at = table[keys[0]]
    series = table[keys[1]] if len(keys) > 1 else np.zeros(len(at))
    axes = panels(page, len(shown), row=3.4 if page.narrow else 4, share_x=True)
    key = Key()
    for s, value in enumerate(np.unique(series)):
        rows = series == value
        for each, (name, _, _) in zip(axes, shown):
            points_with_errors(each, at[rows], table[name][rows], dy=table[name + "_error"][rows], **curve_style(s))
        if len(keys) > 1:
            text = data.facts["texts"][1][int(value) - 1] if not data.facts["numeric"][1] else f"{value:g}"
            runs = runs_text(int(table["n"][rows].sum()))
            key.line(as_math(f"{SYMBOLS.get(keys[1], keys[1])} = {literal(text)}{UNITS.get(keys[1], '')} ({runs})"), **curve_style(s))
    unit = UNITS.get(keys[0], "").strip()
    for k, (each, (_, title, unit_of)) in enumerate(zip(axes, shown)):
        set_title(each, "y", title, unit_of, heading=letter(k) if len(shown) > 1 else "")
        if not data.facts["numeric"][0]:
            each.set_xticks(range(1, len(data.facts["texts"][0]) + 1), map(literal, data.facts["texts"][0]))
        each.margins(x=0.06)
        if has_numbers(each, "x"):
            each.set_xlabel(as_math(SYMBOLS.get(keys[0], keys[0])) + (f" (${unit}$)" if unit == "D" else f" ({unit})" if unit else ""))
    return arrange(axes, key, page=page)
