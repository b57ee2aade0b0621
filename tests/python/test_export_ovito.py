"""Output of `talus export --to xyz` and `--to lammps`: extended XYZ as ASE reads it, and the text of a
LAMMPS dump."""

import numpy as np
import pytest

import talus
from conftest import run_talus
from exported import OF_THRESHOLDS, compare, grains, joined

#: Names of fields in extended XYZ as OVITO expects them.
XYZ_NAMES = {"type": "kind", "velocity": "velo", "displacement": "disp", "coordination": "n_neighb"}
#: Names of columns in a LAMMPS dump as LAMMPS defines them.
LAMMPS_NAMES = {"image": ["ix", "iy"], "velocity": ["vx", "vy"], "angular_velocity": ["omegaz"],
                "displacement": ["displacementx", "displacementy"]}
LENGTHS = ("radius", "displacement", "lc_1", "lc_2")


def plain_names(found, names):
    """Returns fields by their own names, without the third components of vectors."""
    back = {other: name for name, other in names.items()}
    fields = {back.get(name, name): values for name, values in found.items()}
    for name in ("image", "velocity", "displacement"):
        assert not fields[name][:, 2].any()
        fields[name] = fields[name][:, :2]
    return fields


@pytest.mark.parametrize("boundary", ["analysed", "walls"])
def test_extended_xyz_is_read_by_ase(boundary, request, tmp_path):
    ase = pytest.importorskip("ase.io", reason="ASE is not installed: python3-ase")
    path, chosen = request.getfixturevalue(boundary), [0, 2, 9]
    run_talus("export", path, "--to", "xyz", "--at", "frame0,frame2,frame9", "-o", tmp_path / "made" / "frames.xyz")
    frames = ase.read(tmp_path / "made" / "frames.xyz", index=":")
    assert len(frames) == 3
    with talus.open(path) as run:
        d = run["parameters/mean_diameter"]
        for atoms, k in zip(frames, chosen):
            frame = run.frames[k]
            info = {name: atoms.info[name] for name in ("Time", "tilt", "step", "frame", "mean_diameter")}
            assert info == {"Time": frame.time, "tilt": run["frames/tilt"][k], "step": frame.step, "frame": k, "mean_diameter": d}
            assert "mean diameters" in atoms.info["units"]
            assert atoms.pbc.tolist() == [run.periodic, False, False]
            np.testing.assert_allclose(atoms.positions[:, :2], frame.position / d, rtol=1e-15)
            assert not atoms.positions[:, 2].any() and set(atoms.symbols) == {"X"}
            top, bottom = (frame.position[:, 1] + run.radius).max(), (frame.position[:, 1] - run.radius).min()
            np.testing.assert_allclose(atoms.cell.lengths(), [run.length / d, (top - min(bottom, 0)) / d, 1], rtol=1e-12)
            np.testing.assert_allclose(atoms.info["Origin"], [0, min(bottom, 0) / d, -0.5], atol=1e-12)
            found = {name: values for name, values in atoms.arrays.items() if name not in ("numbers", "positions")}
            found = plain_names(found, XYZ_NAMES)
            for name in LENGTHS:
                found[name] = found[name] * d
            expected = grains(run, k)
            compare({name: found[name] for name in expected}, expected)
            assert set(found) - set(expected) == (set() if boundary == "analysed" else OF_THRESHOLDS)
            np.testing.assert_array_equal(np.float32(found["velocity"]), np.float32(frame.velocity))


def test_beds_shorter_than_a_metre_are_no_shares_of_their_box(analysed, run, tmp_path):
    """OVITO interprets coordinates as fractions of the box if all are between 0 and 1."""
    assert run.length < 1
    run_talus("export", analysed, "--to", "xyz", "--at", "frame0", "-o", tmp_path / "frame.xyz")
    x = [float(line.split()[1]) for line in (tmp_path / "frame.xyz").read_text().splitlines()[2:]]
    assert max(x) > 5


def parse_dump(text):
    """Returns the frames of a LAMMPS dump as its manual describes it: the lines below each ITEM, by name;
    atoms as columns."""
    frames, lines = [], iter(text.splitlines())
    items, name = {}, ""
    for line in lines:
        if line.startswith("ITEM: "):
            name = line[6:]
            if name == "UNITS":
                assert items == {} and not frames, "units come first, and only once: OVITO looks for TIME after a frame"
            items[name] = []
        else:
            items[name].append(line)
        if name.startswith("ATOMS") and items.get(name) is not None and len(items[name]) == int(items["NUMBER OF ATOMS"][0]):
            columns = name.split()[1:]
            rows = np.array([[float(word) for word in row.split()] for row in items.pop(name)])
            assert rows.shape[1] == len(columns) == len(set(columns))
            frames.append((items, dict(zip(columns, rows.T))))
            items = {}
    assert not items
    return frames


@pytest.mark.parametrize("boundary", ["analysed", "walls"])
def test_lammps_dump_has_the_columns_that_ovito_knows(boundary, request, tmp_path):
    path, chosen = request.getfixturevalue(boundary), [0, 2, 9]
    run_talus("export", path, "--to", "lammps", "--at", "frame9,frame2,frame0", "-o", tmp_path / "frames.dump")
    frames = parse_dump((tmp_path / "frames.dump").read_text())
    assert len(frames) == 3
    with talus.open(path) as run:
        assert frames[0][0]["UNITS"] == ["si"]
        for (items, columns), k in zip(frames, chosen):
            frame = run.frames[k]
            assert float(items["TIME"][0]) == frame.time and int(items["TIMESTEP"][0]) == frame.step
            bounds = items["BOX BOUNDS pp ff ff" if run.periodic else "BOX BOUNDS ff ff ff"]
            low, high = np.array([line.split() for line in bounds], dtype=float).T
            np.testing.assert_allclose((low[0], high[0]), (0, run.length))
            assert low[1] <= (frame.position[:, 1] - run.radius).min() and high[1] >= (frame.position[:, 1] + run.radius).max()
            assert list(columns)[:6] == ["id", "type", "x", "y", "radius", "mass"] and "z" not in columns
            np.testing.assert_array_equal(np.float32([columns.pop("x"), columns.pop("y")]), np.float32(frame.position.T))
            expected = grains(run, k)
            found = joined(columns, expected, LAMMPS_NAMES)
            compare(found, expected)
            assert len(columns) == (0 if boundary == "analysed" else 6)
            np.testing.assert_array_equal(np.float32(found["internal_moment"]), np.float32(expected["internal_moment"]))
            np.testing.assert_array_equal(found["radius"], run.radius)
