"""A grain just below the end of the period stays below it for every reader: in the file and in every
export."""

import csv
import json
import re

import numpy as np
import pytest

import talus
from conftest import run_talus

BED = """
[bed]
length = {length}
depth = 1
floor = "smooth"
[tilt]
end_angle = 0.001
[deposition]
method = "file"
file = "{table}"
"""


# 0.2 m and 0.5 m are the next float or above it, 0.7 m is below it: "0.7" is the shortest text of that float.
@pytest.fixture(scope="module", params=[20, 50, 70])
def near_end(request, tmp_path_factory):
    """Returns the path of a run with the first grain just below L, and L in D."""
    folder, length = tmp_path_factory.mktemp("period"), request.param
    (folder / "bed.csv").write_text(f"{length - 1e-8!r},0.5,0.5\n3,0.5,0.5\n")
    (folder / "bed.toml").write_text(BED.format(length=length, table=folder / "bed.csv"))
    run_talus("run", folder / "bed.toml", "-o", folder / "run.h5")
    return folder / "run.h5", length


def exported(path, kind, output):
    run_talus("export", path, "--to", kind, "--at", "frame0", "-o", output)
    return output


def xyz(path, folder):
    lines = exported(path, "xyz", folder / "bed.xyz").read_text().splitlines()
    return float(lines[2].split()[1]), float(re.search(r'Lattice="(\S+)', lines[1])[1])


def lammps(path, folder):
    lines = exported(path, "lammps", folder / "bed.dump").read_text().splitlines()
    bounds = lines[next(i for i, line in enumerate(lines) if "BOX BOUNDS" in line) + 1]
    atoms = next(i for i, line in enumerate(lines) if "ITEM: ATOMS" in line)
    return float(lines[atoms + 1].split()[lines[atoms].split().index("x") - 2]), float(bounds.split()[1])


def csv_table(path, folder):
    with open(exported(path, "csv", folder / "csv") / "grains.csv") as file:
        return float(next(csv.DictReader(file))["x (m)"]), None


def paraview(path, folder):
    vtk = pytest.importorskip("vtkmodules.vtkIOXML", reason="VTK is not installed: python3-vtk9")
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(next(exported(path, "paraview", folder / "vtk").glob("**/grains*.vtp"))))
    reader.Update()
    return reader.GetOutput().GetPoint(0)[0], None


@pytest.mark.parametrize("read", [xyz, lammps, csv_table, paraview])
def test_export_has_places_below_the_period(read, near_end, tmp_path):
    path, length = near_end
    x, end = read(path, tmp_path)
    assert 0 < x < (end or 0.01 * length)


def test_file_has_places_below_the_period(near_end):
    path, length = near_end
    for units in ("SI", "D"):
        with talus.open(path, units=units) as run:
            x = run.frames[0].position[0, 0]
            assert 0 < x < run.length and x < np.float32(run.length)
    h5py = pytest.importorskip("h5py")
    with h5py.File(path) as file:
        assert file["particles/grains/position/value"][0, 0, 0] < np.float32(file["particles/grains/box/edges"][0])


@pytest.fixture(scope="module")
def rolling_disk(tmp_path_factory):
    """Returns a run of one disk that rolls down a smooth floor at 5 deg, several periods between two frames."""
    folder = tmp_path_factory.mktemp("disk")
    (folder / "one.csv").write_text("x,y,radius\n5,0.5,0.5\n")
    (folder / "disk.toml").write_text(BED.format(length=10, table="one.csv").replace("0.001", "5"))
    run_talus("run", "disk.toml", "-o", "disk.h5", folder=folder)
    run_talus("analyze", "disk.h5", folder=folder)
    return folder / "disk.h5"


def test_a_disk_that_rolls_round_the_bed_releases_the_work_of_gravity(rolling_disk):
    with talus.open(rolling_disk) as run:
        disk = [frame.unwrapped[0] for frame in run.frames]
        steps = np.diff(disk, axis=0)
        assert np.abs(steps[:, 0]).max() > 2 * run.length, "nothing was tested"
        tilts = np.radians(run.tilt)
        tilt = 0.5 * (tilts[1:] + tilts[:-1])
        work = run.mass[0] * run.gravity * (np.sin(tilt) * steps[:, 0] - np.cos(tilt) * steps[:, 1])
        energy = run.analysis["events/energy"]
        begin = np.searchsorted(tilts, run.analysis["events/frame_tilt"][-1, 0])
        assert energy[-1] == pytest.approx(work[begin:].sum(), rel=1e-4)
        assert energy[-1] > 0.2, "J/m"
        assert run.analysis["events/grains"][-1] == 1
        moved = np.hypot(*(np.array(disk) - disk[0]).T) / run.D
    for distance in (5, 20, 50, 200):
        (found,) = json.loads(run_talus("events", rolling_disk, "--displacement", distance, "--json"))
        assert [grain["frame"] for grain in found["grains"]] == [np.argmax(moved >= distance)]
