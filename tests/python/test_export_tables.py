"""Output of `talus export --to csv` and `--to observables`, read by pandas."""

import csv

import numpy as np
import pytest

import talus
from conftest import run_talus
from exported import OF_THRESHOLDS, compare, contacts, grains, joined


@pytest.fixture(scope="module")
def pandas():
    return pytest.importorskip("pandas", reason="pandas is not installed: python3-pandas")


@pytest.mark.parametrize("boundary", ["analysed", "walls"])
def test_tables_have_a_row_for_each_frame_grain_and_contact(pandas, boundary, request, tmp_path):
    path, chosen = request.getfixturevalue(boundary), [0, 9]
    run_talus("export", path, "--to", "csv", "--at", "frame0,frame9", "-o", tmp_path / "made" / "tables")
    read = {name: pandas.read_csv(tmp_path / "made" / "tables" / f"{name}.csv", float_precision="round_trip")
            for name in ("frames", "grains", "contacts")}
    assert {"radius (m)", "internal_moment_xy (J/m)", "gamma"} < set(read["grains"])
    with talus.open(path) as run:
        assert read["frames"].values.tolist() == [[k, run.frames[k].step, run.frames[k].time, run["frames/tilt"][k]]
                                                  for k in chosen]
        assert list(read["frames"]) == ["frame", "step", "time (s)", "tilt (rad)"]
        for name, fields in (("grains", grains), ("contacts", contacts)):
            assert len(read[name]) == sum(len(next(iter(fields(run, k).values()))) for k in chosen)
            for k in chosen:
                rows = read[name][read[name]["frame"] == k]
                table = {column.split(" (")[0]: values for column, values in rows.items()}
                expected = fields(run, k)
                found = joined(table, expected)
                compare(found, expected)
                without = boundary == "walls" and name == "grains"
                assert set(table) - {"frame", "x", "y"} == (OF_THRESHOLDS if without else set())
                if name == "grains":
                    np.testing.assert_array_equal(np.float32([table["x"], table["y"]]).T, run.frames[k].position)
                    np.testing.assert_array_equal(np.float32(found["velocity"]), run.frames[k].velocity)
                    np.testing.assert_array_equal(found["radius"], run.radius)


@pytest.mark.parametrize("flow", [False, True])
def test_observables_are_those_of_the_run_to_the_last_bit(walls, tmp_path, flow):
    run_talus("export", walls, "--to", "observables", *(["--flow"] if flow else []), "-o", tmp_path / "observables.csv")
    with open(tmp_path / "observables.csv", newline="") as file:
        head, *rows = csv.reader(file)
    with talus.open(walls) as run:
        tilt = run.observables["tilt"]
        count = len(tilt) if flow else np.argmax(tilt) + 1
        assert count == len(rows) and (count < len(tilt)) != flow
        for name, column in zip(head, zip(*rows)):
            name, _, unit = name.partition(" (")
            assert unit in ("", run.unit(f"observables/{name}") + ")") and (unit != "") == (run.unit(f"observables/{name}") != "1")
            values = [float(text) if text else np.nan for text in column]
            np.testing.assert_array_equal(values, run.observables[name][:count], err_msg=name)


def test_moments_are_averaged_as_the_analysis_is_told_to(pandas, copied, walls, tmp_path):
    def grains_of(path, folder, *options):
        run_talus("export", path, "--to", "csv", *options, "-o", tmp_path / folder)
        return pandas.read_csv(tmp_path / folder / "grains.csv")

    run_talus("analyze", copied, "--set", "averaging=1")
    read = grains_of(copied, "averaged", "--at", "frame9", "--set", "averaging=1")
    plain = grains_of(copied, "plain", "--at", "frame9")
    with talus.open(copied) as run:
        np.testing.assert_array_equal(read["cluster_1"], run.analysis["clusters/label"][9, 0])
        np.testing.assert_array_equal(np.float32(read["lc_2 (m)"]), np.float32(run.analysis["lc/length"][9, 1]))
    assert (read["gamma_neighbourhood"] != plain["gamma_neighbourhood"]).any()
    assert read["gamma"].equals(plain["gamma"]), "stored data stay unchanged"
    with talus.open(walls) as run:
        last = len(run.frames) - 1
        assert last >= run.frames_of_tilt
    read = grains_of(walls, "flow", "--at", f"frame{last}", "--set", "averaging=1")
    assert read.equals(grains_of(walls, "plain-flow", "--at", f"frame{last}")), "a flow has no frames to average over"
