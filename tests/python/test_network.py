"""Measures of the contact network, compared with other programs or plain sums for the same frames."""

import numpy as np
import pytest


def persistence(frame):
    """Returns lifetimes of components and loops of the graph of contacts between free grains while the
    force threshold decreases, by GUDHI: pairs of the forces at birth and at death, 0 if it does not die."""
    gudhi = pytest.importorskip("gudhi", reason="GUDHI is not installed: python3-gudhi")
    pairs, force = frame.contacts.pair, frame.contacts.force[:, 0]
    between = (pairs < np.flatnonzero(frame.free)[-1] + 1).all(axis=1)
    tree = gudhi.SimplexTree()
    for c in np.flatnonzero(between)[np.argsort(-force[between], kind="stable")]:
        tree.insert(sorted(int(i) for i in pairs[c]), filtration=-force[c])
    tree.compute_persistence(homology_coeff_field=2, persistence_dim_max=True)
    return [
        np.where(np.isinf(lives), 0.0, -lives).reshape(-1, 2)
        for lives in (tree.persistence_intervals_in_dimension(d) for d in (0, 1))
    ]


def sliced_distance(one, other, directions=16):
    """Returns the distance of two diagrams as a plain sum over directions."""
    angles = np.pi * (np.arange(directions) / directions - 0.5)
    lines = np.stack([np.cos(angles), np.sin(angles)])

    def projections(points, of_other):
        on_diagonal = np.repeat(of_other.mean(axis=1)[:, None], 2, axis=1)
        return np.sort(np.concatenate([points, on_diagonal]) @ lines, axis=0)

    return np.abs(projections(one, other) - projections(other, one)).sum() / directions


@pytest.mark.parametrize("k", [0, 11])
def test_components_and_loops_are_the_betti_numbers_of_gudhi(run, k):
    analysis = run.analysis
    thresholds = analysis["network/threshold"] * analysis["contacts/mean_normal_force"][k]
    components, loops = [
        [((lives[:, 0] >= t) & ((t > lives[:, 1]) | (lives[:, 1] == 0.0))).sum() for t in thresholds]
        for lives in persistence(run.frames[k])
    ]
    np.testing.assert_array_equal(analysis["network/components"][k], components)
    np.testing.assert_array_equal(analysis["network/loops"][k], loops)
    assert max(components) > 3 and max(loops) > 20


def test_persistence_and_its_change_are_those_of_gudhi(run):
    analysis, free = run.analysis, np.count_nonzero(run.frames[0].free)
    before, after = (
        [lives / analysis["contacts/mean_normal_force"][k] for lives in persistence(run.frames[k])] for k in (10, 11)
    )
    for name, lives in zip(("component", "loop"), after):
        total = (lives[:, 0] - lives[:, 1]).sum() / free
        assert analysis[f"network/{name}_persistence"][11] == pytest.approx(total, rel=1e-10)
    expected = [sliced_distance(one, other) / free for one, other in zip(before, after)]
    assert analysis["network/change"][11] == pytest.approx(expected, rel=1e-10)
    assert np.isnan(analysis["network/change"][0]).all()


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
