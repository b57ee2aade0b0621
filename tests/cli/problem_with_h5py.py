"""Reads and modifies problem files like an independent program, with h5py and numpy.

Usage:
  problem_with_h5py.py check SOLVED.h5 ETA        checks that the solution obeys the law
  problem_with_h5py.py change P.h5 OTHER.h5 HOW   writes a modified copy
"""
import shutil
import sys

import h5py
import numpy as np


def dense(group):
    """Returns W of a local problem in compressed rows as a dense matrix."""
    p, i, x = (group[name][:] for name in "pix")
    rows = group["m"][0]
    assert group["nz"][0] == -2 and group["n"][0] == rows and group["nzmax"][0] == len(x) == p[-1]
    w = np.zeros((rows, rows))
    np.add.at(w, (np.repeat(np.arange(rows), np.diff(p)), i), x)
    return w


def from_bodies(talus, contacts):
    """Returns W = H^T M^-1 H and q = H^T v_free + c from the definitions."""
    body = {name: talus["bodies/" + name][:] for name in talus["bodies"]}
    contact = {name: talus["contacts/" + name][:] for name in talus["contacts"]}
    h = np.zeros((2 * contacts, 3 * len(body["vx"])))
    for c in range(contacts):
        n = np.array([contact["nx"][c], contact["ny"][c]])
        t = np.array([-n[1], n[0]])
        assert abs(n @ n - 1.0) < 1e-14
        for b, sign in [(contact["a"][c], -1.0), (contact["b"][c], 1.0)]:
            h[2 * c, 3 * b : 3 * b + 2] += sign * n
            h[2 * c + 1, 3 * b : 3 * b + 2] += sign * t
            h[2 * c + 1, 3 * b + 2] -= body["lever"][b]
    inverse = np.stack([body["inverse_mass"], body["inverse_mass"], body["inverse_inertia"]], axis=1).ravel()
    velocity = np.stack([body["vx"], body["vy"], body["omega"]], axis=1).ravel()
    constant = np.stack([contact["cn"], contact["ct"]], axis=1).ravel()
    return (h * inverse) @ h.T, h @ velocity + constant


def check_law(w, q, mu, r, u, eta):
    assert np.allclose(u, w @ r + q, rtol=0, atol=1e-10 * np.abs(q).max())
    rn, rt, un, ut = r[::2], r[1::2], u[::2], u[1::2]
    assert np.all(rn >= 0.0) and np.all(np.abs(rt) <= mu * rn * (1 + 1e-6) + 1e-12 * rn.max())
    diagonal = np.diag(w)
    after_n = np.maximum(0.0, rn - un / diagonal[::2])
    after_t = np.clip(rt - ut / diagonal[1::2], -mu * after_n, mu * after_n)
    change = np.hypot(np.linalg.norm(after_n - rn), np.linalg.norm(after_t - rt))
    assert change <= 1.001 * eta * np.linalg.norm(r), (change / np.linalg.norm(r), eta)
    # Residual of complementarity and Coulomb's law relative to the effect of free fall.
    small = 300 * eta * np.linalg.norm(r) * np.linalg.norm(q)
    assert abs(rn @ un) < small and un.min() > -1e3 * eta * np.abs(q).max()
    assert abs(np.sum(mu * rn * np.abs(ut) + rt * ut)) < small, "sliding is opposed by full friction"


def check(path, eta):
    with h5py.File(path, "r") as file:
        local = file["fclib_local"]
        assert local["spacedim"][0] == 2 and file["guesses/number_of_guesses"][0] == 1
        w, q, mu = dense(local["W"]), local["vectors/q"][:], local["vectors/mu"][:]
        assert np.allclose(w, w.T, rtol=0, atol=1e-12 * w.max()) and len(q) == 2 * len(mu)
        if "talus" in file:
            w_bodies, q_bodies = from_bodies(file["talus"], len(mu))
            assert np.allclose(w, w_bodies, rtol=0, atol=1e-12 * w.max())
            assert np.allclose(q, q_bodies, rtol=0, atol=1e-12 * np.abs(q).max())
        assert h5py.h5g.get_objinfo(file["fclib_local/W/x"].id).mtime == 0, "equal problems have equal bytes"
        guess = file["guesses/1"]
        assert np.allclose(guess["u"][:], w @ guess["r"][:] + q, rtol=0, atol=1e-10 * np.abs(q).max())
        check_law(w, q, mu, file["solution/r"][:], file["solution/u"][:], eta)


def replace(file, path, values):
    del file[path]
    file[path] = values


def to_form(file, form):
    """Writes an asymmetric W as compressed rows, compressed columns, or triplets from the last to the
    first."""
    w = dense(file["fclib_local/W"])
    w -= 0.1 * np.triu(w, 2)
    row, column = np.nonzero(w)
    if form == "columns":
        column, row = np.nonzero(w.T)
    value, zero_to_rows = w[row, column], np.arange(len(w) + 1)
    stored = {
        "rows": (-2, np.searchsorted(row, zero_to_rows), column, value),
        "columns": (-1, np.searchsorted(column, zero_to_rows).astype(np.int64), row.astype(np.int64), value),
        "triplets": (len(value), column[::-1], row[::-1], value[::-1].reshape(-1, 1)),
    }
    nz, p, i, x = stored[form]
    for name, values in [("nz", [nz]), ("nzmax", [len(value)]), ("p", p), ("i", i), ("x", x)]:
        replace(file, "fclib_local/W/" + name, values)


def change(source, target, how):
    shutil.copyfile(source, target)
    with h5py.File(target, "r+") as file:
        if how in ("rows", "columns", "triplets"):
            to_form(file, how)
        if how in ("rows", "columns", "triplets", "plain"):
            del file["talus"]
        elif how == "older":
            del file["talus/run"]
        elif how == "space":
            replace(file, "fclib_local/spacedim", [3])
        elif how == "no-problem":
            del file["fclib_local"]
        elif how == "constraints":
            file["fclib_local/R/m"] = [1]
        elif how == "text":
            replace(file, "fclib_local/vectors/mu", b"rough")
        elif how == "order":
            file["fclib_local/W/p"][2] = 1 << 20


if sys.argv[1] == "check":
    check(sys.argv[2], float(sys.argv[3]))
else:
    change(*sys.argv[2:5])
