"""Catalogue of the figures of runs, in the order of the paper, followed by further figures."""

import difflib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import talus.figures.angles as angles
import talus.figures.beds as beds
import talus.figures.courses as courses
import talus.figures.distributions as distributions
import talus.figures.parameter as parameter
import talus.figures.tilt as tilt
import talus.figures.walls as walls
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from talus.errors import MissingName, WrongValue
from talus.figures.data import Data, Wanted
from talus.figures.groups import Group
from talus.figures.panels import Page
from talus.figures.style import ONE_COLUMN, TWO_COLUMNS, styled


@dataclass(frozen=True)
class Recipe:
    """How a figure is made: `recipe(groups)` draws it."""

    name: str  #: also that of its files
    title: str
    needs: str  #: required runs, for messages: "a run that has failed"
    data: Callable[[Sequence[Group], Wanted], Data | None]  #: None: no group is of the required kind
    draw: Callable[[Data, Page], Figure]
    width: float = ONE_COLUMN  #: cm
    shows_frames: bool = False  #: single frames, which can be chosen
    dpi: int = 300
    write: Callable[[Data, Page, Sequence[Any], str], None] | None = None  #: writes files other than as `draw` shows them

    def __call__(self, groups: Sequence[Group], *, width: float = 0, height: float = 0, at: Sequence[str] = (), paper: bool = False,
                 spread: bool = False, style: Any = None, ax: Axes | None = None) -> Figure:
        """Draws the figure of groups of runs.

        width, height: cm; by default those of a journal's columns. at: frames instead of those of the paper, as in --at.
        paper: the paper's values also for other beds. spread: deviations and single runs also of more than two groups.
        style: a style sheet of matplotlib, its name or a dict. ax: axes to draw into, if the figure has one panel.
        Raises WrongValue if no group is of the required kind."""
        data = self.data(groups, Wanted(at, paper, spread))
        if data is None:
            raise WrongValue(f"{self.name} needs {self.needs}")
        with styled(style):
            return self.draw(data, Page(width or self.width, height, ax))


FAILED = "a run that has failed"
#: Data that an ensemble.h5 lacks: distributions are in run files, and frames in those that were kept with them.
DISTRIBUTIONS, FRAMES = f"the distributions of {FAILED}", f"the frames of {FAILED}"
THRESHOLD = "a periodic bed that has failed, or has a threshold by --set gamma_c"
#: Means of the quantities of frames, over the tilt or over the angle left to failure.
OVER = ("Quantities of the packing, of its overloaded grains and of their clusters over {}; at the first threshold if they depend on one.")

CATALOGUE = (
    Recipe("fig04-shear-stress", "Normalised shear stress against tan(theta) (paper, Fig. 4)", "a run",
           tilt.shear_stress, tilt.draw_shear_stress),
    Recipe("fig05-stress-ratio", "Stress ratio of the packing against sin(theta) (paper, Fig. 5)", "a run",
           tilt.stress_ratio, tilt.draw_stress_ratio),
    Recipe("fig06-wall-stress", "Stress sigma_xx along a bed between walls (paper, Fig. 6)",
           "the file of a bed between walls that has failed", walls.wall_stress, walls.draw_wall_stress, shows_frames=True),
    Recipe("fig07-wall-ratio", "Shear stress at failure over the length between walls (paper, Fig. 7)",
           "a bed between walls that has failed, with rows in the last 0.5 deg before", walls.wall_ratio, walls.draw_wall_ratio),
    Recipe("fig08-stress-ratio-density", "Distribution of the stress ratio of grains (paper, Fig. 8)", "the distributions of " + THRESHOLD,
           distributions.gamma_density, distributions.draw_gamma_density, shows_frames=True),
    Recipe("fig09-overloaded-fraction", "Overloaded fraction over tilt (paper, Fig. 9)", THRESHOLD,
           tilt.overloaded_fraction, tilt.draw_overloaded_fraction, TWO_COLUMNS),
    Recipe("fig10-stress-ratio-maps", "Maps of the stress ratio of each grain (paper, Fig. 10)", FRAMES,
           beds.gamma_maps, beds.draw_maps, TWO_COLUMNS, True, 400, beds.write_maps),
    Recipe("fig11-neighbourhoods", "Growing neighbourhoods of an overloaded grain (paper, Fig. 11)",
           "the frames of a run that has failed, with overloaded grains in the middle of its bed",
           beds.neighbourhoods, beds.draw_neighbourhoods, TWO_COLUMNS, True),
    Recipe("fig12-coarse-graining-length", "Coarse-graining length of overloaded grains over tilt (paper, Fig. 12)", THRESHOLD,
           tilt.coarse_graining_length, tilt.draw_coarse_graining_length, TWO_COLUMNS),
    Recipe("fig13-overloaded-maps", "Maps of the overloaded grains (paper, Fig. 13)", FRAMES,
           beds.overloaded_maps, beds.draw_maps, TWO_COLUMNS, True, 400, beds.write_maps),
    Recipe("fig14-volume-strain", "Volume strain over tilt, and theta_d by each estimator (paper, Fig. 14)", "a periodic bed",
           tilt.volume_strain, tilt.draw_volume_strain),
    Recipe("overloaded-over-scale", "Overloaded fraction over the size of neighbourhoods", "the frames of a periodic bed that has failed",
           distributions.overloaded_over_scale, distributions.draw_overloaded_over_scale, shows_frames=True),
    Recipe("contact-directions", "Directions of contact normals", DISTRIBUTIONS,
           distributions.contact_directions, distributions.draw_contact_directions, TWO_COLUMNS, True),
    Recipe("force-chains", "Force chains just before failure", FRAMES,
           beds.force_chains, beds.draw_force_chains, TWO_COLUMNS, True),
    Recipe("force-distribution", "Distribution of the normal forces", DISTRIBUTIONS,
           distributions.force_distribution, distributions.draw_force_distribution, TWO_COLUMNS, True),
    Recipe("critical-contacts", "Contacts with fully mobilised friction", FAILED,
           beds.critical_contacts, beds.draw_critical_contacts, TWO_COLUMNS),
    Recipe("correlations", "Correlation of forces and stresses over distance", DISTRIBUTIONS,
           distributions.correlations, distributions.draw_correlations, TWO_COLUMNS, True),
    Recipe("dynamic-angle", "Angle at rest against theta_c and theta_d", "a run with tilt.after_failure whose flow has stopped",
           courses.dynamic_angle, courses.draw_dynamic_angle, TWO_COLUMNS),
    Recipe("cycles", "Cycles of the tilt, and what accumulates over them", "the file of a run whose tilt falls at least once before failure",
           courses.cycles, courses.draw_cycles, TWO_COLUMNS),
    Recipe("angle-distributions", "Distribution of theta_c, theta_d and theta_r over the runs",
           "at least two runs of an ensemble that have such an angle",
           angles.angle_distributions, angles.draw_angle_distributions, TWO_COLUMNS),
    Recipe("angle-correlations", "Correlation of theta_c, theta_d and theta_r over the runs",
           "at least two runs of an ensemble that have two such angles",
           angles.angle_correlations, angles.draw_angle_correlations, TWO_COLUMNS),
    Recipe("over-tilt", "Quantities of the analysis over tilt", "a run",
           tilt.Quantities(OVER.format(tilt.TEXTS["theta"])), tilt.draw_quantities, TWO_COLUMNS),
    Recipe("before-failure", "Quantities of the analysis over the angle left to failure", FAILED,
           tilt.Quantities(OVER.format(tilt.TEXTS["angle_left"]), "angle_left"), tilt.draw_quantities, TWO_COLUMNS),
    Recipe("precursors", "What precedes failure in the contacts", FAILED,
           tilt.Quantities("Share of the contacts whose friction is fully mobilised (critical contacts), this share over the largest that "
                           "equilibrium allows, and the mean number of contacts in their clusters; anisotropy of the contacts; redundant "
                           "constraints and largest cluster of the network as a frictional rigid structure: over theta_c - theta, the "
                           "angle left to failure.", "angle_left", tilt.PRECURSORS), tilt.draw_quantities, TWO_COLUMNS),
    Recipe("weak-contacts", "Directions of weak contacts over their mobilised friction", DISTRIBUTIONS,
           distributions.weak_contacts, distributions.draw_weak_contacts, shows_frames=True),
    Recipe("persistence", "Persistence of the force network", FRAMES, beds.persistence, beds.draw_persistence, TWO_COLUMNS),
    Recipe("events", "Rearrangements on the way to failure", "the file of a run with rearrangements (talus events)",
           courses.events, courses.draw_events, TWO_COLUMNS),
    Recipe("difference-over-tilt", "Difference of two groups of runs over tilt", "exactly two groups of runs",
           tilt.Differences("theta"), tilt.draw_differences, TWO_COLUMNS),
    Recipe("difference-before-failure", "Difference of two groups of runs over the angle left to failure",
           "exactly two groups of runs that have failed", tilt.Differences("angle_left"), tilt.draw_differences, TWO_COLUMNS),
    Recipe("over-parameter", "Results over the varied parameters", "runs of at least two values of one or two keys of the scenario",
           parameter.over_parameter, parameter.draw_over_parameter, TWO_COLUMNS),
)


def short_name(name: str) -> str:
    """Returns "fig09" for "fig09-overloaded-fraction"; other names have no short form."""
    return name.partition("-")[0] if name.startswith("fig") else name


def find(word: str) -> Recipe:
    """Returns a figure by its name or its number: "fig09-overloaded-fraction", "fig09", "fig9", "09", "9". Raises MissingName
    with a suggestion if there is none."""
    number = word.removeprefix("fig")
    name = f"fig{int(number):02}" if number.isascii() and number.isdigit() and len(number) <= 2 else word
    for recipe in CATALOGUE:
        if name in (recipe.name, short_name(recipe.name)):
            return recipe
    names = dict.fromkeys(name for recipe in CATALOGUE for name in (recipe.name, short_name(recipe.name)))
    near = difflib.get_close_matches(word, names, 1, 0.5)
    raise MissingName(f"--only {word}: no such figure; " + (f"did you mean {near[0]!r}?" if near else "docs/figures.md lists them"))
