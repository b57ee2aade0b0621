"""Beds that LAMMPS continues (Frame.to_lammps), and the study of both codes (docs/studies/two_codes.py)."""

import os
import shutil
import subprocess
import sys

import numpy as np
import pytest
from conftest import ROOT, run_talus

import talus

pytest.importorskip("talus._core", reason="the extension is not built")
pytest.importorskip("matplotlib", reason="matplotlib is not installed: python3-matplotlib")
from talus.lammps import Bed  # noqa: E402

sys.path.insert(0, str(ROOT / "docs/studies"))
import two_codes as study  # noqa: E402


def table(text, heading):
    """Returns the rows of a section of a data file of LAMMPS."""
    lines = text.split(heading, maxsplit=1)[1].split("\n")[2:]
    end = lines.index("") if "" in lines else len(lines)
    return np.array([line.split() for line in lines[:end]], float)


def written(frame, folder, **options):
    """Returns the bed of slope.data, and its velocities."""
    frame.to_lammps(folder, **options)
    text = (folder / "slope.data").read_text()
    bed, grains = Bed(frame), table(text, "Atoms # sphere")
    bed.r, bed.x, bed.y = grains[:, 2] / 2, grains[:, 4], grains[:, 5]
    return bed, table(text, "Velocities")[:, 1:]


@pytest.mark.parametrize("k_n", [1e4, 1e6])
def test_overlaps_and_springs_are_those_of_the_forces(run, tmp_path, k_n):
    frame = run.frames[0]
    before = Bed(frame)
    bed, velocity = written(frame, tmp_path, k_n=k_n, k_t=0.8 * k_n)
    nx, ny, overlap = bed.normals(bed.a, bed.b)
    assert overlap * k_n == pytest.approx(bed.f_n, abs=2e-3 * bed.f_n.mean())
    assert bed.normals(*bed.near())[2].max() < 1e-3 * bed.f_n.mean() / k_n, "no other grains touch"
    slip = (velocity[bed.a, :2] - velocity[bed.b, :2]) * np.stack([-ny, nx], axis=1)
    spring = slip.sum(axis=1) + bed.r[bed.a] * velocity[bed.a, 5] + bed.r[bed.b] * velocity[bed.b, 5]
    assert 0.8 * k_n * spring == pytest.approx(bed.f_t, abs=1e-6 * bed.f_n.mean())
    moved = np.abs(np.stack([bed.x - before.x % bed.L, bed.y - before.y, bed.r - before.r]))
    assert moved.max() < 10 * bed.f_n.mean() / k_n + 1e-4
    assert (moved[:2, ~frame.free] < 1e-12).all(), "the floor stays"


def test_positions_alone_are_those_of_the_frame(run, tmp_path):
    frame = run.frames[0]
    before, (bed, velocity) = Bed(frame), written(frame, tmp_path, forces=False)
    assert bed.y == pytest.approx(before.y, abs=1e-15) and bed.r == pytest.approx(before.r, abs=1e-15) and not velocity.any()
    assert "variable grow index 10" in (tmp_path / "in.slope").read_text()


def test_files_have_the_same_units_for_every_run(run, tmp_path):
    with talus.open(run.path, units="D") as other:
        run.frames[3].to_lammps(tmp_path / "SI")
        other.frames[3].to_lammps(tmp_path / "D")
    for name in ("slope.data", "in.slope"):
        assert (tmp_path / "SI" / name).read_text() == (tmp_path / "D" / name).read_text()


def test_the_slope_has_the_friction_of_the_tilt(folder, tmp_path):
    run_talus("run", folder / "bed.toml", "--set", "deposition.friction=0.2", "--set", "tilt.end_angle=0.5", "-o", tmp_path / "bed.h5")
    with talus.open(tmp_path / "bed.h5") as run:
        assert run.frames[0].friction == 0.2, "of its forces"
        run.frames[0].to_lammps(tmp_path / "slope")
        assert f"variable mu equal {run.friction:.8g} " in (tmp_path / "slope/in.slope").read_text().replace("\n", " ")


def test_time_steps_are_short_for_stiff_tangential_springs(run, tmp_path):
    steps = {}
    for k_t in (5e4, 1e5, 1e7):
        run.frames[0].to_lammps(tmp_path, k_n=1e5, k_t=k_t, forces=False, overwrite=True)
        [line] = [line for line in (tmp_path / "in.slope").read_text().split("\n") if line.startswith("variable n equal")]
        steps[k_t] = float(line.split("/")[2].split(")")[0])
    assert steps[5e4] == steps[1e5] == pytest.approx(10 * steps[1e7], rel=1e-6)


def test_surface_layer_is_3_D_below_the_free_surface(run, tmp_path):
    frame = run.frames[0]
    frame.to_lammps(tmp_path, forces=False)
    x, y, r = *frame.position[frame.free].T, frame.radius[frame.free]
    middle = (np.arange(20000) + 0.5) / 20000 * run.length
    away = np.abs(middle - x[:, None])
    away = np.minimum(away, run.length - away)
    height = np.where(away < r[:, None], y[:, None] + np.sqrt(np.maximum(r[:, None]**2 - away**2, 0)), 0).max(axis=0)
    [line] = [line for line in (tmp_path / "in.slope").read_text().split("\n") if line.startswith("region layer block INF INF")]
    assert float(line.split()[5]) == pytest.approx(height.mean() / run.D - 3, abs=1e-4)


@pytest.mark.parametrize("name, shown", [("a\nshell echo HI.h5", r"a\x0ashell echo HI.h5"), ('a""".h5', "a'''.h5"), ("é&.h5", "é&.h5"),
                                         (os.fsdecode(b"caf\xe9\r.h5"), r"caf\xe9\x0d.h5")])
def test_names_of_runs_are_no_commands(copied, tmp_path, name, shown):
    with talus.open(copied.rename(tmp_path / name)) as run:
        run.frames[0].to_lammps(tmp_path / "slope")
    title = f"Frame 0 of {shown}, at 0 deg"
    lines = (tmp_path / "slope/in.slope").read_text(encoding="utf-8").split("\n")
    assert lines[0] == f"# {title}" and lines[1].startswith("# Units: ")
    assert (tmp_path / "slope/slope.data").read_text(encoding="utf-8").startswith(f"{title}\n\n")


def test_existing_files_are_kept_unless_they_are_to_be_replaced(run, tmp_path):
    (tmp_path / "in.slope").write_text("edited")
    with pytest.raises(OSError, match="in.slope: exists already; replace a file with overwrite=True") as error:
        run.frames[0].to_lammps(tmp_path)
    assert error.value.exit_code == 73
    assert [each.name for each in tmp_path.iterdir()] == ["in.slope"] and (tmp_path / "in.slope").read_text() == "edited"
    run.frames[0].to_lammps(tmp_path, overwrite=True)
    assert (tmp_path / "in.slope").read_text().startswith("# Frame 0")


@pytest.mark.parametrize("place, reason, code", [
    ("file", "file: cannot create the folder: Not a directory", 73), ("file/slope", "file: cannot create the folder: Not a directory", 73),
    ("/proc/slope", "/proc/slope: cannot create the folder", 73), ("taken", "in.slope is a folder", 73),
    ("link", "in.slope is read by this command", 64), ("part", "part: slope.data and in.slope cannot be written: Is a directory", 74)])
def test_folders_that_cannot_be_written_are_refused(run, tmp_path, place, reason, code):
    (tmp_path / "file").touch()
    (tmp_path / "taken/in.slope").mkdir(parents=True)
    (tmp_path / "part/slope.data.talus.part").mkdir(parents=True)
    (tmp_path / "link").mkdir()
    (tmp_path / "link/in.slope").symlink_to(run.path)
    with pytest.raises(talus.Error, match=reason) as error:
        run.frames[0].to_lammps(tmp_path / place, overwrite=True)
    assert error.value.exit_code == code and isinstance(error.value, ValueError if code == 64 else OSError)


@pytest.mark.parametrize("setting, what", [("bed.boundary=walls", "side walls"), ("bed.floor=smooth", "a smooth floor"),
                                           ("contact.rolling_friction=0.05", "rolling friction")])
def test_beds_that_lammps_cannot_continue_are_refused(folder, tmp_path, setting, what):
    path = tmp_path / "bed.h5"
    run_talus("run", folder / "bed.toml", "--set", setting, "--set", "tilt.end_angle=0.5", "-o", path)
    with talus.open(path) as run, pytest.raises(ValueError, match=f"without rolling friction; this bed has {what}"):
        run.frames[0].to_lammps(tmp_path / "slope")
    assert not (tmp_path / "slope").exists()


@pytest.mark.parametrize("options", [{"k_n": 0}, {"k_n": "stiff"}, {"k_t": float("inf")}, {"forces": 2}, {"overwrite": 1}, {"folder": 1.5}])
def test_wrong_arguments_are_refused(run, tmp_path, options):
    with pytest.raises(talus.Error, match="expected"):
        run.frames[0].to_lammps(**{"folder": tmp_path / "slope"} | options)


def test_contacts_that_are_too_soft_are_refused(run, tmp_path):
    with pytest.raises(ValueError, match="k_n=10: found no positions .* use k_n=100, or forces=False"):
        run.frames[0].to_lammps(tmp_path / "slope", k_n=10)
    assert not (tmp_path / "slope").exists()


@pytest.mark.skipif(shutil.which("lmp") is None, reason="LAMMPS is not installed: apt-get install lammps")
@pytest.mark.parametrize("tilt, rolling_friction", [(0, None), (8, None), (8, 1e-15), (8, 0.05)])
def test_lammps_continues_a_bed_with_its_forces(run, tmp_path, monkeypatch, tilt, rolling_friction):
    run.frame_at(tilt).to_lammps(tmp_path, k_n=1e5)
    if rolling_friction is not None:
        monkeypatch.setattr(study, "ROLLING_FRICTION", rolling_friction)
        script = tmp_path / "in.slope"
        script.write_text(study.with_rolling(script.read_text()))
    words = ["-var", "end", f"{tilt + 0.05}", "-var", "relax", "5"]
    subprocess.run(["lmp", "-in", "in.slope", "-screen", "none", *words], cwd=tmp_path, check=True)
    own, found = study.of_talus(run.path)[0][tilt], study.of_lammps(tmp_path)[0][0]
    own_f_n, f_n = study.common_forces(own, found)
    assert len(f_n) == len(own.f_n), "no contact is lost"
    assert np.corrcoef(own_f_n, f_n)[0, 1] > 0.9999
    assert np.abs(f_n - own_f_n).max() < 0.05 * own_f_n.mean()
    energy = np.loadtxt(tmp_path / "slope.series")[0, 4]
    assert energy < 1e-9, "the bed rests"
    values, own_values = (study.measured(state, state, 0.3) for state in (found, own))
    assert {name: values[name] for name in ("Gamma", "a_t", "mobilised")} == pytest.approx(
        {name: own_values[name] for name in ("Gamma", "a_t", "mobilised")}, abs=2e-3)


def test_the_study_measures_what_talus_measures(run):
    states, flow = study.of_talus(run.path)
    for tilt in (0, 10):
        frame = run.frame_at(tilt)
        frame.analyse_with(gamma_c=0.2)
        values = study.measured(states[tilt], states[0], 0.2)
        names = {"Gamma": "packing/stress_ratio", "phi": "packing/solid_fraction", "z": "contacts/coordination_number",
                 "p_o": "overloaded/fraction", "a_c": "texture/contacts", "a_n": "texture/normal_forces", "a_t": "texture/tangential_forces"}
        assert {name: values[name] for name in names} == pytest.approx({name: frame[own] for name, own in names.items()}, abs=1e-4)
    assert study.theta_c(*flow) == pytest.approx(run.theta_c, abs=0.05)
