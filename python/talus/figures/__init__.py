"""Figures of runs and ensembles, drawn with matplotlib: those of the paper and further ones (docs/figures.md).

    from talus import figures
    groups = figures.read_groups(["runs/paper", "runs/friction-0.3"])
"""

from talus.figures.groups import Group, group_runs, read_groups
from talus.figures.runs import AnalysedRun, read_runs

__all__ = ["AnalysedRun", "Group", "group_runs", "read_groups", "read_runs"]
