"""Prints the content of the first variant in ensemble.h5, and checks the consistency of its parts."""

import sys

import h5py
import numpy as np

with h5py.File(sys.argv[1]) as file:
    variant = file["variants/0"]
    members = len(variant["seed"])
    assert variant["state_hash"].shape == (members,) and variant["state_hash"].dtype == np.uint64
    assert b"[bed]" in np.bytes_(variant.attrs["scenario"])
    grid = variant["over_tilt/theta"]
    assert grid.attrs["unit"] in (b"deg", "deg")
    analysis = variant["analysis"]
    ends = np.cumsum(analysis["frames"][:])[:-1]
    tilts = np.split(np.degrees(analysis["tilt"][:]), ends)
    values = np.split(analysis["contacts/coordination_number"][:], ends)
    table = np.array([np.interp(grid[:], tilt, z, right=np.nan) for tilt, z in zip(tilts, values)])
    assert table.shape == (members, len(grid))
    z = variant["over_tilt/contacts/coordination_number/summary"]
    columns = [name.decode() for name in z.attrs["columns"]]
    summary = dict(zip(columns, z[:].T))
    assert np.allclose(summary["mean"], np.nanmean(table, axis=0), rtol=1e-12)
    assert np.allclose(summary["median"], np.nanmedian(table, axis=0), rtol=1e-12)
    assert np.allclose(summary["deviation"], np.nanstd(table, axis=0, ddof=1), rtol=1e-8)
    student = np.array([np.nan, np.nan, 12.706, 4.303, 3.182])[summary["n"].astype(int)]  # at 95 %, for n values
    for side, end in (-1, "low"), (1, "high"):
        assert np.allclose(summary[end], summary["mean"] + side * student * summary["error"], equal_nan=True)
    print(*variant["seed"][:], *grid[:])
