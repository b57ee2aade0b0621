"""Output of `talus export --to paraview`, read by VTK."""

import xml.etree.ElementTree

import numpy as np
import pytest

import talus
from conftest import run_talus
from exported import compare, contacts, grains

vtk = pytest.importorskip("vtkmodules.vtkIOXML", reason="VTK is not installed: python3-vtk9")
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkCommonCore import vtkDataArray  # noqa: E402

#: Number of components in two dimensions, for fields that have three.
PLANE = {1: [0], 3: [0, 1], 9: [0, 1, 3, 4]}


def read(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    assert reader.GetErrorCode() == 0
    return reader.GetOutput()


def arrays(data):
    """Returns arrays of points or cells by name, with their units; components out of the plane are zero."""
    found, units = {}, {}
    for i in range(data.GetNumberOfArrays()):
        array = data.GetArray(i)
        values = vtk_to_numpy(array).reshape(array.GetNumberOfTuples(), -1)
        plane = PLANE[values.shape[1]]
        assert not np.delete(values, plane, axis=1).any()
        found[array.GetName()] = values[:, plane].squeeze(axis=1) if len(plane) == 1 else values[:, plane]
        units[array.GetName()] = array.GetInformation().Get(vtkDataArray.UNITS_LABEL())
    return found, units


def entries(pvd):
    """Returns times and files of a .pvd."""
    found = xml.etree.ElementTree.parse(pvd).getroot().findall("Collection/DataSet")
    return [(float(entry.get("timestep")), pvd.parent / entry.get("file")) for entry in found]


@pytest.fixture(scope="module")
def written(analysed, tmp_path_factory):
    folder = tmp_path_factory.mktemp("paraview") / "made" / "here"
    run_talus("export", analysed, "--to", "paraview", "--at", "frame0,frame3-frame5,frame11", "-o", folder)
    return folder


@pytest.mark.parametrize("what", ["grains", "contacts"])
def test_pvd_lists_frames_over_time(written, run, what):
    listed = entries(written / f"{what}.pvd")
    assert [time for time, _ in listed] == [run.frames[k].time for k in (0, 3, 4, 5, 11)]
    assert [file.name for _, file in listed] == [f"{what}_{k:04}.vtp" for k in (0, 3, 4, 5, 11)]
    assert len(list((written / "frames").iterdir())) == 10
    for (time, file), k in zip(listed, (0, 3, 4, 5, 11)):
        field = read(file).GetFieldData()
        values = {name: field.GetArray(name).GetValue(0) for name in ("TimeValue", "tilt", "frame", "step")}
        frame = run.frames[k]
        assert values == {"TimeValue": frame.time, "tilt": run["frames/tilt"][k], "frame": k, "step": frame.step}
        assert field.GetArray("tilt").GetInformation().Get(vtkDataArray.UNITS_LABEL()) == "rad"


@pytest.mark.parametrize("k", [0, 4, 11])
def test_grains_are_points_with_all_their_fields(written, run, k):
    data = read(written / f"frames/grains_{k:04}.vtp")
    points = vtk_to_numpy(data.GetPoints().GetData())
    np.testing.assert_array_equal(points[:, :2], run.frames[k].position)
    assert not points[:, 2].any() and data.GetNumberOfVerts() == len(points) == data.GetNumberOfCells()
    found, units = arrays(data.GetPointData())
    compare(found, grains(run, k))
    for name in ("velocity", "internal_moment", "gamma", "angle"):
        stored = getattr(run.frames[k], name)
        np.testing.assert_array_equal(found[name].reshape(stored.shape), stored, name)
    assert units["radius"] == units["lc_1"] == "m" and units["internal_moment"] == "J/m" and units["gamma"] == "1"


@pytest.mark.parametrize("k", [0, 11])
def test_contacts_are_lines_to_the_image_of_the_neighbour(written, run, k):
    data, stored = read(written / f"frames/contacts_{k:04}.vtp"), run.frames[k].contacts
    found, units = arrays(data.GetCellData())
    compare(found, contacts(run, k))
    np.testing.assert_array_equal(found["normal_force"], stored.force[:, 0])
    assert units["normal_force"] == "N/m"
    points = vtk_to_numpy(data.GetPoints().GetData()).reshape(-1, 2, 3)
    assert data.GetNumberOfLines() == len(stored) == len(points)
    np.testing.assert_array_equal(points[:, 0, :2], stored.start)
    np.testing.assert_array_equal(points[:, 1, :2], stored.end)
    assert (stored.shift != 0).sum() > 3, "no contact across the edge"
    cells = vtk_to_numpy(data.GetLines().GetConnectivityArray()).reshape(-1, 2)
    np.testing.assert_array_equal(cells, np.arange(2 * len(stored)).reshape(-1, 2))
    at_ends, _ = arrays(data.GetPointData())
    np.testing.assert_array_equal(at_ends["normal_force"], np.repeat(found["normal_force"], 2))


def test_planes_and_frames_of_a_flow(walls, tmp_path):
    with talus.open(walls) as run:
        k = len(run.frames) - 1
        assert k >= run.frames_of_tilt
        run_talus("export", walls, "--to", "paraview", "--at", "0", "--flow", "-o", tmp_path)
        assert len(entries(tmp_path / "grains.pvd")) == 1 + len(run.frames) - run.frames_of_tilt
        data, stored = read(tmp_path / f"frames/contacts_{k:04}.vtp"), run.frames[k].contacts
        assert not stored.between_grains.all()
        points = vtk_to_numpy(data.GetPoints().GetData()).reshape(-1, 2, 3)
        np.testing.assert_array_equal(points[:, 1, :2], stored.end)
        found, _ = arrays(read(tmp_path / f"frames/grains_{k:04}.vtp").GetPointData())
        without = {name: values for name, values in found.items() if name.split("_")[0] not in ("overloaded", "lc", "cluster")}
        compare(without, grains(run, k))
        assert len(found) == len(without) + 6


def test_runs_under_way_have_no_threshold_unless_one_is_given(stopped, tmp_path):
    said = run_talus("export", stopped, "--to", "paraview", "--at", "frame0", "-o", tmp_path / "without")
    assert "left out" in said and "--set gamma_c" in said
    said = run_talus("export", f"{stopped}.run", "--to", "paraview", "--at", "frame0", "--set", "gamma_c=0.3",
                     "--set", "threshold_factors=1.5", "--set", "l_min=0", "-o", tmp_path / "given")
    assert "left out" not in said
    names = {}
    for folder in ("without", "given"):
        names[folder], _ = arrays(read(tmp_path / folder / "frames/grains_0000.vtp").GetPointData())
    assert set(names["given"]) - set(names["without"]) == {"overloaded_1_5", "lc_1_5", "cluster_1_5"}
    given = names["given"]
    np.testing.assert_array_equal(given["gamma"], np.float32(given["gamma_neighbourhood"]))
    free = given["type"] == 1
    np.testing.assert_array_equal(given["overloaded_1_5"][free], given["gamma"][free] >= 0.45)


def test_fields_on_a_grid_sum_up_to_the_packings_own_values(run, analysed, tmp_path):
    """The sums over all points, times the area per point, are the totals of the packing: mass, momentum,
    and internal moments without the contribution of rotations."""
    folder = tmp_path / "fields"
    run_talus("export", analysed, "--to", "vti", "--at", "frame0,frame11", "--set", "length=4", "-o", folder)
    listed = entries(folder / "fields.pvd")
    assert [time for time, _ in listed] == [run.frames[k].time for k in (0, 11)]
    for (_, file), k in zip(listed, (0, 11)):
        reader = vtk.vtkXMLImageDataReader()
        reader.SetFileName(str(file))
        reader.Update()
        assert reader.GetErrorCode() == 0
        grid = reader.GetOutput()
        values, units = arrays(grid.GetPointData())
        area = grid.GetSpacing()[0] * grid.GetSpacing()[1]
        frame = run.frames[k]
        free = frame.free
        mass = run.mass[free]
        rotation = 0.5 * (0.5 * mass * run.radius[free] ** 2) * frame.angular_velocity[free] ** 2
        moment = frame.internal_moment[free].sum(axis=0) + rotation.sum() * np.eye(2)
        assert values["density"].sum() * area == pytest.approx(mass.sum(), rel=2e-3)
        momentum = (mass[:, None] * frame.velocity[free]).sum(axis=0)
        speed = (mass * np.linalg.norm(frame.velocity[free], axis=1)).sum()
        assert values["momentum"].sum(axis=0) * area == pytest.approx(momentum, abs=2e-3 * speed)
        stress = values["contact_stress"].sum(axis=0).reshape(2, 2) * area
        assert stress == pytest.approx(moment, abs=2e-3 * np.trace(moment))
        assert units["density"] == "kg/m^3" and units["stress"] == "Pa" and units["shear_rate"] == "1/s"
        inside = values["solid_fraction"].max()
        assert 0.7 < inside < 0.95
