"""Figures of runs and ensembles, drawn with matplotlib: those of the paper and further ones (docs/figures.md).

    from talus import figures
    groups = figures.read_groups(["runs/paper", "runs/friction-0.3"])      # runs that differ only in their seed are averaged
    figures.over_tilt(groups)                                              # a matplotlib Figure
    figures.fig09(groups, width=8.6, style={"font.family": "serif"})
    figures.fig04([figures.Group("mine", figures.read_runs("a.h5"))], ax=axes)

Each figure is a function of groups of runs with the name of its files, with _ for -: `figures.force_chains`. Those of the
paper also have short names, `figures.fig09`. `figures.recipes()` lists them; help(figures.fig09) explains the arguments."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from talus.figures.groups import Group, group_runs, read_groups
from talus.figures.runs import AnalysedRun, read_runs

if TYPE_CHECKING:
    from talus.figures.catalogue import Recipe

__all__ = ["AnalysedRun", "Group", "group_runs", "main", "read_groups", "read_runs", "recipes"]


def recipes() -> "dict[str, Recipe]":
    """Returns all figures by the names of their functions."""
    from talus.figures.catalogue import CATALOGUE

    return {recipe.name.replace("-", "_"): recipe for recipe in CATALOGUE}


def main(words: Sequence[str]) -> None:
    """Carries out `talus figures`."""
    from talus.figures.command import main

    main(words)


def __getattr__(name: str) -> Any:
    if not name.startswith("_"):
        for full, recipe in recipes().items():
            if name in (full, full.partition("_")[0] if full.startswith("fig") else full):
                return recipe
    raise AttributeError(f"module 'talus.figures' has no attribute {name!r}")


def __dir__() -> list[str]:
    return [*__all__, *recipes()]
