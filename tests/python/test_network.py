"""Measures of the contact network, compared with other programs or plain sums for the same frames."""

import h5py
import numpy as np
import pytest
from conftest import run_talus

import talus


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


#: A bed in whose state a contact with a gap keeps 1e-46 of the weight of a grain from the first frame to the last.
REMAINS = "[bed]\nlength = 10\ndepth = 8\n[tilt]\nend_angle = 3\n"


def constraints(frame):
    """Returns the rows of a matrix from motions of the free grains, three each, to relative velocities at their contacts,
    the tangential ones only of contacts that stick."""
    contacts, free, rows = frame.contacts, np.append(frame.free, np.zeros(3, bool)), []
    for c, pair in enumerate(contacts.pair):
        along = [(contacts.normal[c], 0)] + [(contacts.tangent[c], -1)] * int(contacts.status[c] == 1)
        for direction, turn in along:
            row = np.zeros(3 * len(free))
            for body, sign in zip(pair, (-1, 1)):
                if free[body]:
                    row[3 * body : 3 * body + 3] = *(sign * direction), turn * frame.radius[body] / frame.run.D
            rows.append(row)
    return np.array(rows)


def loaded(pair, free):
    """Returns the number of contacts of each free grain."""
    return np.bincount(pair[pair < len(free)], minlength=len(free))[free]


def test_contacts_that_have_opened_do_not_count(tmp_path):
    (tmp_path / "bed.toml").write_text(REMAINS)
    run_talus("run", "bed.toml", "-o", "o.h5", folder=tmp_path)
    run_talus("analyze", "o.h5", "--set", "gamma_c=0.3", folder=tmp_path)
    with h5py.File(tmp_path / "o.h5") as file, talus.open(tmp_path / "o.h5") as run:
        least = 1e-9 * run.mass[run.free].mean() * run.gravity
        remaining = file["checkpoint/contact_force"][:, 0]
        assert ((remaining > 0) & (remaining < least)).any(), "nothing was tested"
        assert file["contacts/force"][:, 0].min() > least
        rows = run.observables
        for k, frame in enumerate(run.frames):
            degree = loaded(frame.contacts.pair, run.free)
            z, nu = degree.sum() / (degree > 0).sum(), (frame.contacts.status == 2).mean()
            row = np.flatnonzero(rows["step"] == frame.step)[0]
            for found in (rows["coordination_number"][row], run.analysis["contacts/coordination_number"][k]):
                assert found == pytest.approx(z, rel=1e-12)
            for found in (rows["critical_fraction"][row], run.analysis["contacts/critical_share"][k]):
                assert found == pytest.approx(nu, rel=1e-12)
        for k in (0, len(run.frames) - 1):
            matrix = constraints(run.frames[k])
            redundant = len(matrix) - np.linalg.matrix_rank(matrix, tol=1e-6)
            grains = (loaded(run.frames[k].contacts.pair, run.free) > 0).sum()
            assert run.analysis["rigid/redundant"][k] == pytest.approx(redundant / grains)


def test_contacts_of_a_simulation_that_have_opened_have_no_force(tmp_path):
    pytest.importorskip("talus._core", reason="the extension is not built: pybind11-dev, python3-dev")
    (tmp_path / "bed.toml").write_text(REMAINS)
    sim = talus.Simulation(tmp_path / "bed.toml")
    sim.deposit()
    sim.tilt_to(0.5)
    carries = sim.contacts.force[:, 0] > 0
    assert sim.contacts.force[carries, 0].min() > 1e-9 * sim.grains.mass.mean() * 9.81
    assert len(sim.contacts["mobilisation"]) == carries.sum() < len(sim.contacts)
    free = np.arange(len(sim.grains)) < sim.grains.free_count
    degree = loaded(sim.contacts.pair[carries], free)
    np.testing.assert_array_equal(sim.grains["coordination"][free], degree)
    assert sim["coordination_number"] == sim["contacts/coordination_number"] == degree.sum() / (degree > 0).sum()
    sliding = sim.contacts["mobilisation"] > 1 - 1e-6
    assert sim["critical_fraction"] == sim["contacts/critical_share"] == pytest.approx(sliding.mean())
