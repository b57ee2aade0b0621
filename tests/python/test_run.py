"""Description, units, series and analysis of a run, compared with the output of `talus`."""

import math
import re

import h5py
import numpy as np
import pytest
from conftest import ROOT, json_of, run_talus

import talus


@pytest.mark.chosen
def test_facts_are_those_of_talus_info(run, analysed):
    info = json_of("info", analysed)
    assert run.complete and info["complete"]
    assert (run.seed, run.free.sum(), (~run.free).sum()) == (info["seed"], info["grains"], info["floor_grains"])
    assert len(run.frames) == info["frames"] == len(run.tilt)
    assert run.theta_c == pytest.approx(info["theta_c_deg"], abs=1e-9)
    assert run.results == info["results"]
    assert {name: run.provenance[name] for name in info["provenance"]} == info["provenance"]
    assert run["provenance/timing/tilt"] == info["timing"]["tilt"]
    assert run["checkpoint/state_hash"] == info["state_hash"]


def test_scenario_is_the_one_that_was_computed(run):
    assert run.scenario["bed"]["length"] * run.D == pytest.approx(run.length)
    assert run.scenario["bed"]["depth"] * run.D == pytest.approx(run.depth)
    assert run.scenario["tilt"]["rate"] == 4 and run.scenario["contact"]["friction"] == run.friction == 0.5
    assert "rate = 4" in run["parameters/scenario_given"]
    assert run.periodic and run.gravity == 9.81


@pytest.mark.chosen
def test_analysis_is_that_of_talus_analyze(run, analysed):
    [printed] = json_of("analyze", analysed)
    names = [name for name in printed if name in run.analysis]
    assert len(names) > 60
    for name in names:
        if name in ("key", "version"):
            continue
        expected = np.array(printed[name], dtype=float)  # null: NaN
        np.testing.assert_allclose(run.analysis[name], expected, rtol=1e-14, err_msg=name)
    assert run.analysis["clusters/label"].shape == (run.frames_of_tilt, 2, len(run.id))
    assert run.analysis["parameters/l_min"] == "3" and run.analysis["key"] == printed["key"]


def test_units_are_those_of_the_file_or_of_tables(analysed, run):
    with talus.open(analysed, units="D") as scaled:
        assert scaled.theta_c == run.theta_c == pytest.approx(math.degrees(run.results["theta_c"]), abs=1e-9) and scaled.D == run.D == 0.01
        assert (scaled.length, scaled.depth) == pytest.approx((15, 6))
        assert scaled.radius[scaled.free].mean() == pytest.approx(0.5, rel=0.02)
        np.testing.assert_allclose(scaled.frames[7].position * run.D, run.frames[7].position, rtol=1e-14)
        np.testing.assert_allclose(scaled.frames[7].contacts.branch * run.D, run.frames[7].contacts.branch, atol=1e-16)
        np.testing.assert_array_equal(scaled.frames[7].contacts.force, run.frames[7].contacts.force)
        np.testing.assert_allclose(scaled.observables["tilt"], np.degrees(run.observables["tilt"]), atol=1e-9)
        np.testing.assert_array_equal(scaled.analysis["lc/mean"], run.analysis["lc/mean"] / run.D)
        assert scaled.analysis.unit("lc/mean") == "D" and run.analysis.unit("lc/mean") == "m"
        assert scaled.unit("frames/tilt") == "deg" and run.unit("/frames/tilt") == "rad"
        assert scaled.unit("contacts/force") == run.unit("contacts/force") == "N/m"


def test_meanings_are_those_of_the_file(run):
    assert run.meaning("particles/grains/gamma/value") == "stress ratio q/p of a grain; NaN where it carries nothing"
    assert run.analysis.meaning("overloaded/fraction").startswith("p_o: overloaded grains over")
    assert run.observables.meaning("volume_strain").startswith("(V - V0)/V0")


def test_floats_are_doubles_and_scalars_are_plain(run):
    assert run.frames[0].position.dtype == np.float64 and type(run.theta_c) is float and type(run.seed) is int


@pytest.mark.chosen
def test_frames_are_chosen_as_by_talus_render(run, analysed):
    assert run.frame_at(10).tilt == pytest.approx(10)
    assert run.frame_at(10.2).tilt == pytest.approx(10)
    at_repose = run.frame_at("repose")
    assert at_repose.tilt <= run.theta_c < run.frames[at_repose.index + 1].tilt
    with pytest.raises(talus.Error, match=r"no frame at 60 deg; its \d+ frames go from 0.00 to"):
        run.frame_at(60)
    with pytest.raises(talus.Error, match="no frame at"):
        run.frame_at(run.tilt[-1] + 0.3)  # frames are 0.5 deg apart
    with talus.open(analysed, units="D") as scaled:
        assert scaled.frame_at(10).index == run.frame_at(10).index
        assert scaled.frame_at("repose").index == at_repose.index


def test_frames_after_failure_are_told_apart(walls):
    info = json_of("info", walls)
    with talus.open(walls) as run:
        assert 0 < info["frames_after_failure"] == len(run.frames) - run.frames_of_tilt
        assert run.tilt[run.frames_of_tilt - 1] == run.tilt.max()
        assert math.degrees(run.results["theta_r"]) == pytest.approx(info["theta_r_deg"])
        assert not run.periodic and set(run.steps["phase"]) == {0, 1, 3}


def test_a_closed_run_is_opened_again(analysed):
    with talus.open(analysed) as run:
        pass
    assert run.frames[1].gamma.shape == run.id.shape


def test_series_as_a_table(run):
    pytest.importorskip("pandas", reason="pandas is not installed: python3-pandas")
    table = run.observables.to_pandas()
    assert set(table.columns) == set(run.observables) and len(table) == len(run.observables["tilt"])
    np.testing.assert_array_equal(table["volume_strain"], run.observables["volume_strain"])


def test_analysis_as_a_table_has_what_the_page_gives_by_frame(run):
    pytest.importorskip("pandas", reason="pandas is not installed: python3-pandas")
    table = run.analysis.to_pandas()
    page = (ROOT / "docs/analysis.md").read_text()
    shapes = dict(re.findall(r"^\| `/analysis/(\S+)` \| \S+ ([^|,]*?)(?:,[^|]*)? \|", page, re.MULTILINE))
    expected = {"tilt"} | {name for name, shape in shapes.items() if shape in ("T", "T F", "T 2", "T 3", "T F 2")}
    expected -= {name for name, shape in shapes.items() if shape == "T F 2"}
    assert len(expected) == 71 and {name.split("[")[0] for name in table.columns} == expected
    np.testing.assert_array_equal(table["overloaded/fraction[1]"], run.analysis["overloaded/fraction"][:, 1])
    assert len(table) == run.frames_of_tilt


def test_version_is_that_of_the_program():
    project = (ROOT / "CMakeLists.txt").read_text()
    assert f"project(talus VERSION {talus.__version__} " in project


def test_a_tilt_that_goes_up_and_down(folder, tmp_path):
    path = tmp_path / "cycles.h5"
    run_talus("run", folder / "bed.toml", "-q", "-o", path, "--set", "tilt.end_angle=repose", "--set",
              "tilt.program=to 2, to -2, hold 0.1, to 1")
    run_talus("analyze", path)
    with talus.open(path) as run:
        assert run.has_program
        assert run.frames_of_tilt == len(run.frames) == len(run.analysis["packing/volume"])
        tilts = run.tilt
        assert tilts.min() == pytest.approx(-2) and tilts[-1] == pytest.approx(1)
        assert run.frame_at(1).index == np.flatnonzero(np.isclose(tilts, 1))[0]
        assert run.frame_at(-2).index == np.argmin(tilts)
        assert run.scenario["tilt"]["program"] == ["to 2", "to -2", "hold 0.1", "to 1"]
        with pytest.raises(talus.Error):
            run.frame_at(3)


def test_the_last_rise_of_tilts():
    from talus.run import last_rise

    assert last_rise(np.array([0.0, 1, 2])) == (0, 3)
    assert last_rise(np.array([0.0, 2, 0, 0, 1, 1, 0])) == (2, 6)
    assert last_rise(np.array([0.0, -2, -1, 1, 2])) == (2, 5)
    assert last_rise(np.array([3.0, 2, 1])) == (0, 3)


def held(sim):
    sim.tilt_to(3)
    sim.tilt_rate = 0
    sim.run(0.1)


def turned(sim):
    sim.tilt_to(4)
    sim.tilt_to(-2)
    sim.tilt_to(1)


@pytest.mark.parametrize("ends", [False, True], ids=["left", "complete"])
@pytest.mark.parametrize("drive", [held, turned])
def test_all_tables_have_all_frames_of_a_run_that_commands_hold_or_turn(tmp_path, drive, ends):
    pytest.importorskip("talus._core", reason="the extension is not built: pybind11-dev, python3-dev")
    path = tmp_path / "driven.h5"
    sim = talus.Simulation({"bed": {"length": 10, "depth": 4}, "deposition": {"rest_velocity": 0.1},
                            "tilt": {"rate": 40, "step": 0.1, "end_angle": 5}, "output": {"frame_every": 0.5, "observable_every": 0.5}})
    sim.record(path)
    drive(sim)
    if ends:
        sim.tilt_rate = 40
        sim.run()
    del sim
    files = [path] if ends else sorted((tmp_path / "driven.h5.run").glob("segment*"))
    steps = np.concatenate([h5py.File(file)["frames/step"][()] for file in files])
    count = len(steps)
    assert count > 10 and np.any(np.diff(np.concatenate([h5py.File(file)["frames/tilt"][()] for file in files])) <= 0)
    info = json_of("info", path)
    assert (info["frames"], info["frames_after_failure"]) == (count, 0)
    with talus.open(path) as run:
        assert len(run.frames) == run.frames_of_tilt == count and run.complete == ends
        np.testing.assert_array_equal(run.step, steps)
    assert len(json_of("analyze", path)[0]["packing/volume"]) == count
    run_talus("export", path, "--to", "csv", "-o", tmp_path / "csv")
    assert len((tmp_path / "csv/frames.csv").read_text().splitlines()) == 1 + count
    run_talus("render", path, "--map", "pressure", "--every", "0.001", "--size", "200", "-o", tmp_path / "maps")
    names = sorted(file.name for file in (tmp_path / "maps").glob("*.png"))
    assert len(names) == count and not any("flow" in name or "-00.00" in name for name in names)
    if ends:
        with talus.open(path) as run:
            assert len(run.analysis["packing/volume"]) == count
