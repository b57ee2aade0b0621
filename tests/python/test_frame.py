"""Grains and contacts of a frame: the arrays of the file, periodic images, end points, and the laws that
they obey."""

import shutil

import h5py
import numpy as np
import pytest
from resealed import sealed

import talus


def moments(frame):
    """Returns M_ij = - sum r_i f_j over the contacts of a grain, with f on it and r from its centre,
    without the term of rotation."""
    contacts, force = frame.contacts, frame.contacts.force_on_b
    found = np.zeros((len(frame.position), 2, 2))
    np.add.at(found, contacts.pair[:, 0], np.einsum("ci,cj->cij", contacts.point - contacts.start, force))
    b = contacts.between_grains
    np.add.at(found, contacts.pair[b, 1], np.einsum("ci,cj->cij", contacts.point[b] - contacts.end[b], -force[b]))
    return found


def test_arrays_are_those_of_the_file(run, analysed):
    k = 11
    frame = run.frames[k]
    with h5py.File(analysed) as file:
        grains = file["particles/grains"]
        for name in ("position", "image", "angle", "velocity", "angular_velocity", "internal_moment", "gamma"):
            np.testing.assert_array_equal(getattr(frame, name), grains[name + "/value"][k], err_msg=name)
        first, last = file["contacts/offset"][k : k + 2]
        assert len(frame.contacts) == last - first > 100
        for name in ("pair", "shift", "normal", "point", "force", "status"):
            np.testing.assert_array_equal(getattr(frame.contacts, name), file["contacts"][name][first:last], name)
        assert (frame.step, frame.time) == (file["frames/step"][k], file["frames/time"][k])
        assert frame.tilt == pytest.approx(np.degrees(file["frames/tilt"][k]), abs=1e-9)
    np.testing.assert_array_equal(run["contacts/offset"][k : k + 2], [first, last])


@pytest.mark.parametrize("boundary", ["analysed", "walls"])
def test_contacts_give_the_internal_moments_of_all_free_grains(boundary, request):
    with talus.open(request.getfixturevalue(boundary)) as run:
        frame = run.frames[9]
        carried = np.abs(frame.internal_moment[frame.free]).max()
        assert np.abs(moments(frame) - frame.internal_moment)[frame.free].max() < 1e-3 * carried


def test_branches_are_as_long_as_the_radii_of_the_grains_that_touch(run):
    tilt = run.scenario["tilt"]
    h = tilt["step"] / tilt["rate"]  # s
    for frame in run.frames[::10]:
        contacts = frame.contacts
        assert (contacts.shift != 0).sum() > 3, "no contact across the edge"
        length = np.hypot(*contacts.branch.T)
        # Contacts are those at the midpoint of a step, positions those at its end.
        velocity = frame.velocity[contacts.pair[:, 1]] - frame.velocity[contacts.pair[:, 0]]
        moved = 1.01 * 0.5 * h * np.hypot(*velocity.T)
        assert (np.abs(length - frame.radius[contacts.pair].sum(axis=1)) < moved + 1e-3 * length).all()
        assert (np.hypot(*(contacts.branch / length[:, None] - contacts.normal).T) < moved / length + 1e-3).all()


def test_contacts_of_walls_and_floor_end_at_their_points(walls):
    with talus.open(walls) as run:
        contacts = run.frames[5].contacts
        at_planes = ~contacts.between_grains
        assert set(contacts.pair[at_planes, 1]) >= {len(run.id)} and (contacts.shift == 0).all()
        np.testing.assert_array_equal(contacts.end[at_planes], contacts.point[at_planes])
        lines, of_contact = contacts.lines()
        assert len(lines) == len(of_contact) == len(contacts)


def test_lines_across_the_edge_are_there_twice_one_period_apart(run):
    contacts = run.frames[0].contacts
    lines, of_contact = contacts.lines()
    across = np.flatnonzero(contacts.shift)
    np.testing.assert_array_equal(of_contact, np.concatenate([np.arange(len(contacts)), across]))
    np.testing.assert_array_equal(lines[: len(contacts), 0], contacts.start)
    first, second = lines[across], lines[len(contacts):]
    np.testing.assert_allclose(np.abs(first - second)[:, :, 0], run.length)
    np.testing.assert_allclose(second[:, 1, 0], run.frames[0].position[contacts.pair[across, 1], 0], atol=1e-15)
    np.testing.assert_array_equal(first[:, :, 1], second[:, :, 1])


def test_forces_balance_on_free_grains(run):
    frame = run.frames[4]
    contacts = frame.contacts
    force = np.zeros_like(frame.position)
    np.add.at(force, contacts.pair[:, 1], contacts.force_on_b)
    np.add.at(force, contacts.pair[:, 0], -contacts.force_on_b)
    gravity = run.gravity * np.array([np.sin(np.radians(frame.tilt)), -np.cos(np.radians(frame.tilt))])
    weight = run.mass[:, None] * gravity
    left_over = np.abs(force + weight)[frame.free]
    assert np.median(left_over) < 1e-2 * np.abs(weight).max(), "grains are held by their contacts"


def test_moments_of_contacts_balance_on_free_grains(rolling, run):
    assert run.frames[4].contacts.moment is None
    with talus.open(rolling) as rolling_run:
        frame = rolling_run.frames[4]
        contacts = frame.contacts
        assert rolling_run.unit("contacts/moment") == "N" and contacts.moment.shape == (len(contacts),)
        torque = np.zeros(len(frame.position))
        cross = lambda lever, force: lever[:, 0] * force[:, 1] - lever[:, 1] * force[:, 0]  # noqa: E731
        grains = contacts.between_grains
        b = contacts.pair[grains, 1]
        np.add.at(torque, contacts.pair[:, 0], -cross(contacts.point - contacts.start, contacts.force_on_b))
        np.add.at(torque, b, cross(contacts.point - contacts.end, contacts.force_on_b)[grains])
        of_forces = torque.copy()
        np.add.at(torque, contacts.pair[:, 0], -contacts.moment)
        np.add.at(torque, b, contacts.moment[grains])
        free = frame.free
        assert np.median(np.abs(torque[free])) < 0.02 * np.median(np.abs(of_forces[free])), "moments hold the grains"
        pytest.importorskip("pandas", reason="pandas is not installed: python3-pandas")
        np.testing.assert_array_equal(contacts.to_pandas()["moment"], contacts.moment)
        assert "moment" not in run.frames[4].contacts.to_pandas()


def test_unwrapped_positions_do_not_jump_at_the_edge(run):
    jumps = 0
    for before, after in zip(run.frames[:-1], run.frames[1:]):
        jumps += np.count_nonzero(np.abs(after.position - before.position)[:, 0] > 0.5 * run.length)
        assert np.abs(after.unwrapped - before.unwrapped)[:, 0].max() < 0.5 * run.length
    assert jumps > 0, "no grain crossed the edge, so nothing was tested"


def test_gamma_is_the_stress_ratio_of_the_internal_moment(run):
    frame = run.frames[20]
    np.testing.assert_allclose(talus.stress_ratio(frame.internal_moment)[frame.free], frame.gamma[frame.free], rtol=1e-5)
    total = frame.internal_moment[frame.free].sum(axis=0)
    assert talus.stress_ratio(total) == pytest.approx(run.analysis["packing/stress_ratio"][20], rel=1e-6)
    assert np.isnan(talus.stress_ratio(np.zeros((2, 2)))) and np.isnan(talus.stress_ratio(-np.eye(2)))


def test_tables_of_grains_and_contacts(run):
    pytest.importorskip("pandas", reason="pandas is not installed: python3-pandas")
    frame = run.frames[3]
    grains, contacts = frame.to_pandas(), frame.contacts.to_pandas()
    assert len(grains) == len(run.id) and grains.index.name == "id"
    np.testing.assert_array_equal(grains[["x", "y"]], frame.position)
    np.testing.assert_array_equal(grains[["M_xx", "M_xy", "M_yx", "M_yy"]], frame.internal_moment.reshape(-1, 4))
    np.testing.assert_array_equal(contacts[["f_n", "f_t"]], frame.contacts.force)
    np.testing.assert_array_equal(contacts[["branch_x", "branch_y"]], frame.contacts.branch)
    np.testing.assert_array_equal(contacts[["n_x", "n_y"]], frame.contacts.normal)


def test_network_has_all_contacts(run, walls):
    networkx = pytest.importorskip("networkx", reason="networkx is not installed: python3-networkx")
    frame = run.frames[3]
    network = frame.to_networkx()
    assert network.number_of_nodes() == len(run.id) and network.number_of_edges() == len(frame.contacts)
    a, b, first = next(iter(network.edges(data=True)))
    assert (a, b) == tuple(frame.contacts.pair[0]) and first["f_n"] == frame.contacts.force[0, 0]
    kinds = networkx.get_node_attributes(network, "kind")
    assert [kinds[i] == "free" for i in run.id] == run.free.tolist()
    # z as in the analysis, from the degrees of the nodes.
    degrees = [degree for node, degree in network.degree() if kinds[node] == "free" and degree > 0]
    assert np.mean(degrees) == pytest.approx(run.analysis["contacts/coordination_number"][3], rel=1e-12)
    sliding = [slides for _, _, slides in network.edges(data="sliding")]
    assert np.mean(sliding) == pytest.approx(run.analysis["contacts/critical_share"][3], rel=1e-12)
    with talus.open(walls) as other:
        planes = [n for n, kind in other.frames[2].to_networkx().nodes(data="kind") if kind == "plane"]
        assert min(planes) == len(other.id)


def test_contacts_that_carry_no_force_are_left_out(analysed, tmp_path):
    """As in files of earlier revisions, in which a contact that has opened keeps a remainder of its force."""
    copied, k = tmp_path / "old.h5", 11
    shutil.copy(analysed, copied)
    with talus.open(analysed) as run:
        pair, weight = run.frames[k].contacts.pair, run.mass[run.free].mean() * run.gravity
        degree = np.bincount(pair[pair < len(run.id)], minlength=len(run.id))
    grain = int(np.argmax(np.where(run.free, degree, 0)))
    open_ones = (pair == grain).any(axis=1)

    def let_go(file):
        rows = file["contacts/offset"][k] + np.flatnonzero(open_ones)
        for row, force in zip(rows, np.resize([0, 1e-30, 0.99e-9 * weight], len(rows))):
            file["contacts/force"][row] = force, 0.5 * force
            file["contacts/status"][row] = 2

    with talus.open(sealed(copied, let_go)) as old:
        frame = old.frames[k]
        np.testing.assert_array_equal(frame.contacts.pair, pair[~open_ones])
        left = np.bincount(frame.contacts.pair[frame.contacts.pair < len(old.id)], minlength=len(old.id))
        np.testing.assert_array_equal(frame.grains["coordination"], left)
        np.testing.assert_array_equal(frame.grains["sliding"][grain], 0)
        of_free = left[frame.free]
        assert frame["contacts/coordination_number"] == pytest.approx(of_free.sum() / (of_free > 0).sum())
        assert frame["contacts/critical_share"] == pytest.approx((frame.contacts.status == 2).mean())
        assert len(frame.contacts["mobilisation"]) == len(frame.contacts)
        assert np.isnan(frame.gamma[grain]) and np.isnan(talus.stress_ratio(frame.internal_moment)[grain])
        assert np.isnan(frame.grains["pressure"]).sum() == 0 and frame.grains["pressure"][grain] <= 0
