"""What talus export writes of a frame, found again from the run file by the definitions of docs/export.md."""

import numpy as np

import talus

#: Factors of the thresholds of an analysis, as they end the names of fields.
THRESHOLDS = ("1", "2")


def gamma_of_neighbourhoods(run, frame, diameter=3.0):
    """Of each free grain: the stress ratio of all free grains whose centres lie within half of `diameter` (D) of its
    own. Floor grains keep theirs, and so does a grain that carries nothing."""
    x, y = frame.position[frame.free].T
    dx = x[:, None] - x
    if run.periodic:
        dx -= run.length * np.round(dx / run.length)
    near = dx**2 + (y[:, None] - y) ** 2 <= (0.5 * diameter * run["parameters/mean_diameter"]) ** 2
    sums = np.einsum("ij,jkl->ikl", near.astype(float), frame.internal_moment[frame.free])
    gamma = frame.gamma.copy()
    gamma[frame.free] = np.where(np.isnan(gamma[frame.free]), np.nan, talus.stress_ratio(sums))
    return gamma


def grains(run, k):
    """Fields of all grains by their names, (N,) or (N, components)."""
    frame, first = run.frames[k], run.frames[0]
    moment = frame.internal_moment
    ends = frame.contacts.pair[frame.contacts.pair < len(run.id)]
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
    }
    if "version" in run.storage.names("analysis"):
        for f, factor in enumerate(THRESHOLDS):
            cluster = run.analysis["clusters/label"][k, f]
            fields |= {f"overloaded_{factor}": (cluster >= 0).astype(int), f"lc_{factor}": run.analysis["lc/length"][k, f],
                       f"cluster_{factor}": cluster}
    return fields


def contacts(run, k):
    """Fields of all contacts by their names."""
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


def compare(found, expected, *, single=1e-7):
    """All fields of a frame, and no others. Whole numbers agree exactly, others to single precision."""
    assert sorted(found) == sorted(expected)
    for name, values in expected.items():
        if np.issubdtype(np.asarray(values).dtype, np.integer):
            np.testing.assert_array_equal(found[name], values, err_msg=name)
        else:
            scale = np.nanmax(np.abs(values), initial=1e-300)
            np.testing.assert_allclose(found[name], values, rtol=single, atol=1e-9 * scale, err_msg=name)
