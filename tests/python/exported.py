"""Output of talus export for a frame, recomputed from the run file by the definitions of docs/export.md."""

import numpy as np

import talus

#: Factors of the thresholds of an analysis, at the end of the names of fields.
THRESHOLDS = ("1", "2")
#: Names of the fields that depend on a threshold.
OF_THRESHOLDS = {f"{what}_{f}" for what in ("overloaded", "lc", "cluster") for f in THRESHOLDS}
COMPONENTS = {1: [""], 2: ["_x", "_y"], 4: ["_xx", "_xy", "_yx", "_yy"]}


def gamma_of_neighbourhoods(run, frame, diameter=3.0):
    """Returns for each free grain the stress ratio of all free grains whose centres lie within half of
    `diameter` (D) of its centre. Floor grains, and grains that carry nothing, keep their own."""
    x, y = frame.position[frame.free].T
    dx = x[:, None] - x
    if run.periodic:
        dx -= run.length * np.round(dx / run.length)
    near = dx**2 + (y[:, None] - y) ** 2 <= (0.5 * diameter * run["parameters/mean_diameter"]) ** 2
    sums = np.einsum("ij,jkl->ikl", near.astype(float), frame.internal_moment[frame.free])
    gamma = frame.gamma.copy()
    gamma[frame.free] = np.where(np.isnan(gamma[frame.free]), np.nan, talus.stress_ratio(sums))
    return gamma


def mobilised_friction(run, frame):
    """Returns for each free grain the mean of |f_t| / (mu f_n) over its contacts, with the mu of side
    walls at these."""
    found, count = frame.contacts, len(run.id)
    f_n, f_t = np.abs(found.force).T
    wall = (found.pair[:, 1] >= count) & (np.abs(found.normal[:, 0]) > 0.5)
    share = np.minimum(f_t / (np.where(wall, run.scenario["contact"]["wall_friction"], run["parameters/friction"]) * f_n), 1)
    sums, contacts = np.zeros(count), np.zeros(count)
    for body in found.pair.T:
        np.add.at(sums, body[body < count], share[body < count])
        np.add.at(contacts, body[body < count], 1)
    return np.where(frame.free & (contacts > 0), sums / np.maximum(contacts, 1), np.nan)


def solid_fractions(run, frame):
    """Returns for each free grain its area divided by that of its cell in the radical diagram of all
    disks, which is cut out of a box by one half-plane after the other; NaN if a corner of the cell is
    farther from the disk than a power of 0.75 D^2."""
    d = run["parameters/mean_diameter"]
    fractions = np.full(len(run.id), np.nan)
    for i in np.flatnonzero(frame.free):
        r = run.radius[i]
        away = frame.position - frame.position[i]
        if run.periodic:
            away[:, 0] -= run.length * np.round(away[:, 0] / run.length)
        distance = np.hypot(*away.T)
        near = np.flatnonzero((distance > 0) & (distance < 6 * d))
        cuts = [(away[j] / distance[j], (distance[j] ** 2 + r**2 - run.radius[j] ** 2) / (2 * distance[j])) for j in near]
        if not run.periodic:
            x = frame.position[i, 0]
            cuts += [(np.array([-1.0, 0.0]), x), (np.array([1.0, 0.0]), run.length - x)]
        if frame.free.all():  # the floor is a plane
            cuts.append((np.array([0.0, -1.0]), frame.position[i, 1]))
        cell = 3 * d * np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
        for normal, height in cuts:
            beyond = cell @ normal - height
            kept = []
            for a, b, from_, to in zip(beyond, np.roll(beyond, -1), cell, np.roll(cell, -1, axis=0)):
                kept += [from_] if a <= 0 else []
                kept += [from_ + (to - from_) * (a / (a - b))] if a * b < 0 else []
            cell = np.array(kept)
        if (np.hypot(*cell.T) ** 2 - r**2).max() <= 0.75 * d**2 * (1 + 1e-9):
            x, y = cell.T
            fractions[i] = np.pi * r**2 / (0.5 * (x * np.roll(y, -1) - y * np.roll(x, -1)).sum())
    return fractions


def grains(run, k):
    """Returns the fields of all grains by name, (N,) or (N, components)."""
    frame, first = run.frames[k], run.frames[0]
    moment = frame.internal_moment
    ends = frame.contacts.pair[frame.contacts.pair < len(run.id)]
    sliding = frame.contacts.pair[frame.contacts.status == 2]
    fields = {
        "id": run.id,
        "type": np.where(frame.free, 1, 2),
        "radius": run.radius,
        "mass": run.mass,
        "image": frame.image,
        "velocity": frame.velocity,
        "angle": frame.angle,
        "angular_velocity": frame.angular_velocity,
        "displacement": frame.unwrapped - first.unwrapped,
        "internal_moment": moment.reshape(-1, 4),
        "pressure": (moment[:, 0, 0] + moment[:, 1, 1]) / (np.pi * run.radius**2),
        "gamma": frame.gamma,
        "gamma_neighbourhood": gamma_of_neighbourhoods(run, frame),
        "coordination": np.bincount(ends, minlength=len(run.id)),
        "sliding": np.bincount(sliding[sliding < len(run.id)], minlength=len(run.id)),
        "speed": np.hypot(*frame.velocity.T),
        "mobilised_friction": mobilised_friction(run, frame),
        "solid_fraction": solid_fractions(run, frame),
    }
    if "version" in run.storage.names("analysis"):
        for f, factor in enumerate(THRESHOLDS):
            cluster = run.analysis["clusters/label"][k, f]
            fields |= {f"overloaded_{factor}": (cluster >= 0).astype(int), f"lc_{factor}": run.analysis["lc/length"][k, f],
                       f"cluster_{factor}": cluster}
    return fields


def contacts(run, k):
    """Returns the fields of all contacts by name."""
    found = run.frames[k].contacts
    f_n, f_t = found.force.T
    return {
        "a": found.pair[:, 0],
        "b": found.pair[:, 1],
        "shift": found.shift,
        "point": found.point,
        "normal": found.normal,
        "normal_force": f_n,
        "tangential_force": f_t,
        "mobilisation": np.abs(f_t) / (run["parameters/friction"] * f_n),
        "status": found.status,
        "strong": (f_n > f_n.mean()).astype(int),
    }


def joined(columns, expected, own=()):
    """Assembles the fields in `expected` from the columns of their components, and removes these columns. `own` are the
    names of columns that do not follow from those of their field and component."""
    found = {}
    for name, values in expected.items():
        width = 1 if np.ndim(values) == 1 else np.shape(values)[1]
        names = own[name] if name in own else [name + component for component in COMPONENTS[width]]
        found[name] = np.stack([np.asarray(columns.pop(of)) for of in names], axis=1).reshape(np.shape(values))
    return found


def compare(found, expected, *, single=1e-7):
    """Compares all fields of a frame, and expects no others. Whole numbers agree exactly, others to single
    precision."""
    assert sorted(found) == sorted(expected)
    for name, values in expected.items():
        if np.issubdtype(np.asarray(values).dtype, np.integer):
            np.testing.assert_array_equal(found[name], values, err_msg=name)
        else:
            scale = np.nanmax(np.abs(values), initial=1e-300)
            np.testing.assert_allclose(found[name], values, rtol=single, atol=1e-9 * scale, err_msg=name)
