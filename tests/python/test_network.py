"""Measures of the network of contacts against what other programs, or plain sums, find in the same frames."""

import numpy as np
import pytest


def betti_numbers(frame, thresholds):
    """Of the graph of contacts between free grains with at least these forces, by the persistence of GUDHI."""
    gudhi = pytest.importorskip("gudhi", reason="GUDHI is not installed: python3-gudhi")
    pairs, force = frame.contacts.pair, frame.contacts.force[:, 0]
    between = (pairs < np.flatnonzero(frame.free)[-1] + 1).all(axis=1)
    tree = gudhi.SimplexTree()
    for c in np.flatnonzero(between)[np.argsort(-force[between], kind="stable")]:
        tree.insert(sorted(int(i) for i in pairs[c]), filtration=-force[c])
    tree.compute_persistence(homology_coeff_field=2, persistence_dim_max=True)
    return [
        [((lives[:, 0] <= -t) & (-t < lives[:, 1])).sum() if len(lives) else 0 for t in thresholds]
        for lives in (tree.persistence_intervals_in_dimension(d) for d in (0, 1))
    ]


@pytest.mark.parametrize("k", [0, 11])
def test_components_and_loops_are_the_betti_numbers_of_gudhi(run, k):
    analysis = run.analysis
    thresholds = analysis["network/threshold"] * analysis["contacts/mean_normal_force"][k]
    components, loops = betti_numbers(run.frames[k], thresholds)
    np.testing.assert_array_equal(analysis["network/components"][k], components)
    np.testing.assert_array_equal(analysis["network/loops"][k], loops)
    assert max(components) > 3 and max(loops) > 20


def test_anisotropies_give_the_stress_ratio_of_a_bed_at_rest(run):
    resting = slice(1, 12)
    ratio = run.analysis["texture/stress_ratio"][resting]
    np.testing.assert_allclose(ratio, run.analysis["packing/stress_ratio"][resting], atol=0.05)


def test_critical_contacts_are_below_their_bound(run):
    analysis = run.analysis
    for k in (0, 11):
        contacts, free = run.frames[k].contacts, np.count_nonzero(run.frames[k].free)
        carrying = len(set(contacts.pair[contacts.pair < free]))
        bound = 2 - 3 * carrying / len(contacts)
        assert analysis["contacts/critical_bound"][k] == pytest.approx(bound, rel=1e-12)
        assert 0 <= analysis["contacts/critical_share_of_bound"][k] <= 1
