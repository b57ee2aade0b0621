"""Runs that scripts have steered: what was in force in their frames, and what they are members of."""

import json
import subprocess

import numpy as np
import pytest
from conftest import PROGRAM, PROGRAM_ENVIRONMENT, json_of, run_talus

import talus

TOML = """
[bed]
length = 10
depth = 3
[deposition]
method = "collapse"
rest_velocity = 0.1
friction = 0.7
[tilt]
rate = 20
step = 0.02
end_angle = 4
[output]
frame_every = 0.5
observable_every = 0.2
"""


def steered(folder, name, seed=1):
    """Records a run whose friction falls from 0.5 to 0.2 at 2 deg, and returns the path."""
    (folder / "bed.toml").write_text(TOML)
    sim = talus.Simulation(str(folder / "bed.toml"), seed=seed)
    path = folder / name
    sim.record(str(path))
    sim.tilt_to(2)
    sim.friction = 0.2
    sim.run()
    return path


def refused(*words):
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, env=PROGRAM_ENVIRONMENT)
    assert done.returncode == 65, done.stderr
    return done.stderr


@pytest.mark.chosen
def test_forces_are_judged_by_the_friction_in_force(tmp_path):
    path = steered(tmp_path, "run.h5")
    with talus.open(path) as run:
        expected = [0.7 if k == 0 else 0.5 if tilt < 2 + 1e-6 else 0.2 for k, tilt in enumerate(run.tilt)]
        assert [frame.friction for frame in run.frames] == expected
        assert run.commands["x"].tolist() == [0.2] and run.commands["kind"].tolist() == [2] and len(run.departures) == 1
        sliding = 0
        for frame, mu in zip(run.frames, expected):
            force = frame.contacts.force
            own = np.abs(force[:, 1]) / (mu * force[:, 0])
            np.testing.assert_allclose(frame.contacts["mobilisation"], np.minimum(own, 1), rtol=1e-5)
            np.testing.assert_array_equal(frame.contacts.status == 2, own > 1 - 1e-6 / mu - 1e-7)
            sliding += int((frame.contacts.status == 2).sum()) if mu == 0.2 else 0
        assert sliding > 3
    live = talus.Simulation(str(tmp_path / "bed.toml"))
    live.tilt_to(3)
    before = live.contacts["mobilisation"].copy()
    live.friction = 0.1
    np.testing.assert_array_equal(live.contacts["mobilisation"], before, err_msg="no step has used it yet")
    live.step()
    force = live.contacts.force
    force = force[force[:, 0] > 0]
    np.testing.assert_allclose(live.contacts["mobilisation"], np.abs(force[:, 1]) / (0.1 * force[:, 0]), rtol=1e-6)


def test_a_steered_run_is_no_member_of_an_ensemble(tmp_path):
    path = steered(tmp_path, "2.h5", seed=2)
    run_talus("ensemble", tmp_path / "bed.toml", "--seeds", "1-2", "-o", tmp_path / "e", "--jobs", "1")
    assert all(not member.open().departures for member in talus.open_ensemble(tmp_path / "e").done())
    (tmp_path / "e/seed-2.h5").unlink()
    path.rename(tmp_path / "e/seed-2.h5")
    for words in (("ensemble", tmp_path / "bed.toml", "--seeds", "1-2", "-o", tmp_path / "e"), ("ensemble", "average", tmp_path / "e")):
        assert "friction 0.2 at 2.00 deg" in refused(*words)
    with pytest.raises(talus.Error, match="not of its scenario alone: friction 0.2 at 2.00 deg"):
        talus.open_ensemble(tmp_path / "e")


def test_a_run_tells_with_which_friction_it_began(tmp_path):
    (tmp_path / "bed.toml").write_text(TOML)
    for seed, mu in ((1, 0.3), (2, 0.9)):
        sim = talus.Simulation(str(tmp_path / "bed.toml"), seed=seed)
        sim.deposit()
        sim.friction = mu
        sim.record(str(tmp_path / f"{seed}.h5"))
        sim.run()
        with talus.open(tmp_path / f"{seed}.h5") as run:
            assert run.friction == run.scenario["contact"]["friction"] == mu
            assert run.scenario["deposition"]["friction"] == 0.7, "that of the deposition was another"
            assert run.frames[0].friction == 0.7 and run.frames[1].friction == mu
        assert json_of("info", tmp_path / f"{seed}.h5")["friction"] == mu
    run_talus("figures", tmp_path / "1.h5", tmp_path / "2.h5", "--only", "over-tilt", "-o", tmp_path / "f")
    data = json.loads((tmp_path / "f/over-tilt.json").read_text())
    assert len(list((tmp_path / "f").glob("over-tilt-*0.3*.csv"))) == 1, data
