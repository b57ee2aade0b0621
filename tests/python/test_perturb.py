"""Trials of talus.perturb: far below theta_c pushes are absorbed, close to it they cause failure; and their report."""

import math

import numpy as np
import pytest

pytest.importorskip("talus._core", reason="the extension is not built")

import talus  # noqa: E402
from talus.figures import weakest_push  # noqa: E402
from talus.figures.data import Data  # noqa: E402
from talus.perturb import (  # noqa: E402
    BISECTIONS, STRONGEST, WEAKEST, Bracket, State, Trial, bracket, follow, patch_grains, perturb, push_trial, search)

PATCH = (4.0, 1.0)


def trial(strength, end):
    return Trial(strength, 30 * strength**2, end, 0.0, 0, 0.0)


def search_of(is_avalanche):
    """Returns the trials of a search in a bed with these answers."""
    return search(lambda strength: trial(strength, "avalanche" if is_avalanche(strength) else "rest"))


@pytest.mark.parametrize("threshold", [0.06, 0.3, 0.7, 2.0, 4.9])
def test_a_search_brackets_a_threshold_within_its_factor(threshold):
    trials = search_of(lambda strength: strength >= threshold)
    found = bracket(trials)
    assert found.without < threshold <= found.with_ and found.held and found.monotone
    assert found.with_ / found.without == pytest.approx((STRONGEST / WEAKEST) ** (1 / 2**BISECTIONS))
    assert len(trials) <= 9 and max(each.strength for each in trials) <= STRONGEST


def test_a_search_ends_where_nothing_or_everything_sets_off_an_avalanche():
    assert len(never := search_of(lambda strength: False)) == 1
    assert bracket(never) == Bracket(without=STRONGEST)
    assert len(always := search_of(lambda strength: True)) == 2
    assert bracket(always) == Bracket(with_=WEAKEST)


def test_exceptions_make_a_bracket_erratic():
    assert bracket(search_of(lambda strength: strength >= 0.7)).monotone
    assert not bracket(search_of(lambda strength: strength >= 0.7 and not 0.9 < strength < 1.4)).monotone
    assert not bracket(search_of(lambda strength: strength >= 0.7 or 0.35 < strength < 0.49)).monotone


def test_an_undecided_trial_counts_as_neither():
    trials = search(lambda strength: trial(strength, "undecided" if 0.4 < strength < 0.6 else
                                           "avalanche" if strength > 0.5 else "rest"))
    assert bracket(trials) == Bracket(without=WEAKEST, with_=STRONGEST)
    assert len(trials) == 4  # strongest, weakest, undecided, and the check below


def test_a_bed_that_does_not_hold_needs_no_push():
    for end in ("avalanche", "undecided"):
        assert bracket([trial(0.0, end)]) == Bracket(held=False, with_=0.0)
    assert bracket([trial(0.0, "rest")]).held


@pytest.fixture(scope="module")
def beds():
    """Returns a small bed at 8 deg, and at the last tilt before failure at which it comes to rest by itself."""
    sim = talus.Simulation({"seed": 3, "bed": {"length": 12, "depth": 6}, "deposition": {"method": "collapse"}}, progress=False)
    sim.tilt_to(8)
    copies = [sim.copy()]
    while not sim.done:
        sim.tilt_by(0.2)
        copies.append(sim.copy())
    assert sim.theta_c > 12
    far, near = copies[0], None
    for near in reversed([each for each in copies if each.theta_c is None]):
        near.tilt_rate = 0
        if follow(near).end == "rest":
            break
    assert sim.theta_c - near.tilt < 1
    far.tilt_rate = 0
    return far, near


def test_a_patch_has_the_grains_near_the_surface_across_the_periodic_edge(beds):
    far, _ = beds
    x, y = far.grains.position[far.grains.free].T
    for centre in (0.0, 0.5 * far.length, far.length):
        apart = np.abs(x - centre)
        inside = np.minimum(apart, far.length - apart) < 2 * far.D
        found = patch_grains(far, 4, 1, centre)
        assert 1 <= len(found) < inside.sum() and inside[found].all()
        assert y[found].min() > far.surface_height(centre, 4 * far.D) - far.D
        assert set(patch_grains(far, 4, 99, centre)) == set(np.flatnonzero(inside))
    assert set(patch_grains(far, 4, 1, 0.0)) == set(patch_grains(far, 4, 1, far.length))


def test_a_bed_far_from_failure_absorbs_a_push_and_rests_again(beds):
    far, _ = beds
    answer = push_trial(far, PATCH, 0.3)
    assert answer.end == "rest" and answer.moved == 0 and 0 < answer.displacement < 0.1
    pushed = patch_grains(far, *PATCH, 0.5 * far.length)
    disk = 2500 * math.pi / 4 * far.D**2
    assert answer.energy == pytest.approx(0.5 * 0.3**2 * far.grains.mass[pushed].sum() / disk, rel=0.02)
    assert push_trial(far, PATCH, 0.3) == answer


def test_a_bed_next_to_failure_fails_by_a_strong_push(beds):
    _, near = beds
    answer = push_trial(near, PATCH, 3.0)
    assert answer.end == "avalanche" and answer.moved > near.grains.free_count / 4 and answer.displacement >= 5


def test_the_threshold_falls_on_the_way_to_failure(beds):
    far, near = (bracket(perturb(bed, PATCH)) for bed in beds)
    assert far.held and near.held and far.without > 2 * near.with_


#: A state that needs a push of 0.7 to 1.575 sqrt(g D), with the middle 1.05.
PUSHED = [trial(0.0, "rest"), trial(5.0, "avalanche"), trial(0.7, "rest"), trial(1.575, "avalanche")]
NOT_AT_REST = [trial(0.0, "avalanche")]
NEVER = [trial(0.0, "rest"), trial(5.0, "rest")]


def test_the_report_gives_the_median_of_even_and_odd_numbers_of_thresholds():
    def row(*trials):
        return weakest_push.range_rows([(0.3, bracket(each)) for each in trials])

    assert row(PUSHED, NOT_AT_REST) == [["0 - 0.5", "2", "1", "0", "0", "< 0.05", "0.55", "1.05"]]
    assert row(PUSHED, NEVER, NOT_AT_REST) == [["0 - 0.5", "3", "1", "1", "0", "< 0.05", "1.05", "> 5"]]


class MadeUpRun:
    """What a report reads of a run that failed at 20 deg."""

    def __init__(self, seed):
        self.seed, self.theta_c = seed, 20.0


@pytest.mark.parametrize("seeds", [2, 12])
def test_the_figure_shows_brackets_and_states_with_one_end(seeds):
    style = pytest.importorskip("talus.figures.style", reason="matplotlib is not installed")
    from talus.figures.panels import Page

    easy = [trial(0.0, "rest"), trial(5.0, "avalanche"), trial(0.05, "avalanche")]
    states = [State(12.0, NEVER), State(15.0, PUSHED), State(19.0, easy), State(19.5, NOT_AT_REST)]
    table = weakest_push.table_of_states([MadeUpRun(seed) for seed in range(seeds)], [states] * seeds)
    data = Data(tables=[table], facts={"estimates": {"$l_c$": 4.0, "dilation": math.nan}})
    with style.styled():
        figure = weakest_push.draw(data, Page(style.TWO_COLUMNS))
    panel = figure.axes[0]
    texts = [text.get_text() for text in figure.talus_legend.get_texts()]
    assert texts[:-3] == (["seed 0", "seed 1"] if seeds == 2 else ["12 beds"])
    assert texts[-3:] == ["no avalanche", "weakest push suffices", "$θ_d$ ($l_c$)"]
    shown = {line.get_marker(): line.get_xydata().tolist() for line in panel.lines if len(line.get_xydata())}
    assert shown["^"] == [[8.0, 5.0]] and shown["v"] == [[1.0, 0.05]]
    bars = panel.collections[0].get_segments()
    assert len(bars) == 1 and bars[0].tolist() == [[5.0, 0.7], [5.0, 1.575]]
