"""Simulations driven by a script: bits, views, errors, threads, and docs/python.md as printed."""

import copy
import importlib.util
import os
import pickle
import re
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import talus
from conftest import ROOT, json_of, run_talus

pytest.importorskip("talus._core", reason="the extension is not built: pybind11-dev, python3-dev")

BED = {"seed": 3, "bed": {"length": 12, "depth": 7}, "deposition": {"rate": 2, "rest_velocity": 0.1},
       "tilt": {"rate": 40, "step": 0.1}, "output": {"frame_every": 2, "observable_every": 0.5}}


def bed(**settings):
    return talus.Simulation(BED, **settings)


def state_of(path):
    """Returns the state hash of a run as `talus info` prints it."""
    return json_of("info", path)["state_hash"]


@pytest.fixture(scope="module")
def reference(tmp_path_factory):
    """Returns state hash, theta_c and file of `talus run`."""
    folder = tmp_path_factory.mktemp("reference")
    scenario = folder / "bed.toml"
    scenario.write_text(bed().scenario)
    run_talus("run", scenario, "-o", folder / "run.h5", "-q")
    return talus.open(folder / "run.h5")


@pytest.mark.chosen
def test_chunks_have_the_bits_of_a_run(reference, tmp_path):
    rng = np.random.default_rng(1)
    for trial in range(2):
        sim = bed(threads=1 + trial % 2)
        if trial % 2:
            sim.record(tmp_path / f"{trial}.h5")
        while not sim.done:
            [lambda: sim.step(int(rng.integers(1, 60))), lambda: sim.run(rng.uniform(0.00125, 0.1)), lambda: sim.tilt_by(rng.uniform(0, 3)),
             lambda: sim.grains["lc"], lambda: sim.draw("gamma", width=200) if trial == 0 else None][rng.integers(5)]()
        assert sim.state_hash == state_of(reference.path)
        assert sim.theta_c == pytest.approx(np.degrees(reference.results["theta_c"]), abs=1e-9)
        if trial % 2:
            other = talus.open(tmp_path / f"{trial}.h5")
            assert other.complete
            np.testing.assert_array_equal(other.frames[-1].position, reference.frames[-1].position)


def test_a_script_is_replayed_without_python(tmp_path):
    sim = bed()
    sim.record(tmp_path / "run.h5")
    sim.tilt_to(3)
    sim.push([1, 2], (0.1, 0.0))
    sim.friction = 0.3
    sim.run()
    assert sim.state_hash in run_talus("replay", tmp_path / "run.h5")


def test_a_stopped_run_goes_on_on_either_side(tmp_path):
    whole = bed()
    whole.run()
    sim = bed()
    sim.record(tmp_path / "a.h5")
    sim.tilt_to(4)
    sim.commit()
    del sim
    resumed = talus.resume(tmp_path / "a.h5")
    resumed.run()
    assert resumed.state_hash == whole.state_hash
    sim = bed()
    sim.record(tmp_path / "b.h5")
    sim.tilt_to(4)
    sim.commit()
    del sim
    assert whole.state_hash in run_talus("run", "--resume", tmp_path / "b.h5")


@pytest.mark.chosen
def test_views_stay_valid():
    sim = bed()
    first = sim.grains.position
    assert not first.flags.writeable and first.base is not None
    with pytest.raises(ValueError):
        first[0, 0] = 1
    address = first.__array_interface__["data"][0]
    sim.deposit()
    now = sim.grains.position
    assert now.__array_interface__["data"][0] == address and len(now) > len(first)
    np.testing.assert_array_equal(first, now[: len(first)])
    other = sim.copy()
    before = now.copy()
    other.tilt_to(2)
    np.testing.assert_array_equal(now, before)
    sim.step(5)
    assert (now != before).any(), "a view follows the steps"
    velocity, contacts = other.grains.velocity, other.contacts.force
    del sim, other
    assert np.isfinite(now).all() and np.isfinite(velocity).all() and np.isfinite(contacts).all()


def test_frames_of_files_have_the_same_names(tmp_path):
    sim = bed()
    sim.analyse_with(gamma_c=0.3)
    sim.record(tmp_path / "run.h5")
    sim.tilt_to(4)
    pressure, tilt = sim.grains["pressure"], sim.tilt
    sim.run()
    run = talus.open(tmp_path / "run.h5")
    frame = run.frame_at(tilt)
    assert np.degrees(frame.tilt) == pytest.approx(tilt)
    np.testing.assert_allclose(frame.grains["pressure"], pressure, rtol=1e-4, atol=1)
    assert 0 <= frame["overloaded/fraction"] <= 1
    assert frame.contacts["mobilisation"].shape == (len(frame.contacts),) and frame.grains.free_count == frame.grains.free.sum()
    assert frame.draw("gamma", width=300).shape[1:] == (300, 4)
    assert len(frame.grains) == len(frame.grains.position) == len(pressure)


@pytest.mark.chosen
def test_what_is_wrong_is_said(tmp_path):
    sim = bed()
    endless, endless_table = [], {}
    endless.append(endless)
    endless_table["bed"] = endless_table
    sim.record(tmp_path / "run.h5")
    for wrong, code in [(lambda: sim["overload"], 64), (lambda: sim.tilt_to(float("nan")), 64), (lambda: sim.step(-1), 64),
                        (lambda: sim.push(10**6, (0, 0)), 64), (lambda: sim.draw("gama"), 64), (lambda: sim.grains["nope"], 64),
                        (lambda: sim.record(tmp_path / "run.h5"), 64), (lambda: sim.draw("gamma", width=-3), 64),
                        (lambda: talus.Simulation({"bed.length": -1}), 65), (lambda: talus.Simulation("no.toml"), 66),
                        (lambda: talus.resume(tmp_path / "no.h5"), 66), (lambda: talus.Simulation({"bed": {"lenght": 3}}), 65),
                        (lambda: bed(threads=0), 64), (lambda: bed().record(tmp_path / "no/no/run.h5"), 73)]:
        with pytest.raises(talus.Error) as raised:
            wrong()
        assert raised.value.exit_code == code, raised.value
    for wrong in [lambda: sim.step("a"), lambda: sim.tilt_to(None), lambda: sim.push("a", (0, 0)), lambda: sim.push(1, (0, 0, 0)),
                  lambda: sim.push(2**40, (0, 0)), lambda: sim.drag(1, ("a", 0)), lambda: sim.draw(3), lambda: sim.draw(nope=1),
                  lambda: sim.draw(length="a"), lambda: sim[3], lambda: sim.grains[3], lambda: talus.Simulation(3.0),
                  lambda: talus.Simulation({3: 4}), lambda: talus.Simulation({"bed.length": object()}), lambda: pickle.dumps(sim),
                  lambda: setattr(sim, "friction", "a"), lambda: talus.Simulation(""), lambda: sim.analyse_with(l_min=endless),
                  lambda: talus.Simulation({"bed": endless}), lambda: talus.Simulation(endless_table)]:
        with pytest.raises((talus.Error, TypeError)):
            wrong()
    sim.run()
    with pytest.raises(talus.Error, match="the run is over"):
        sim.step()


def test_threads_run_side_by_side_and_not_in_one_simulation():
    beds = [bed() for _ in range(2)]
    with ThreadPoolExecutor(2) as pool:
        list(pool.map(lambda sim: sim.run(), beds))
    assert beds[0].state_hash == beds[1].state_hash
    shared, refused = bed(), []

    def use():
        for _ in range(200):
            try:
                shared.step(1)
                shared.tilt, shared.grains.position.sum()
            except talus.Error as error:
                refused.append(str(error))

    threads = [threading.Thread(target=use) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all("another thread" in text or "over" in text for text in refused)


def test_beds_are_recorded_side_by_side(tmp_path):
    def run(k):
        sim = bed()
        sim.record(tmp_path / f"{k}.h5")
        for _ in range(10):
            sim.step(3)
            sim.commit()
        return sim.state_hash

    with ThreadPoolExecutor(4) as pool:
        assert len(set(pool.map(run, range(8)))) == 1
    assert [talus.resume(tmp_path / f"{k}.h5").step_count for k in range(8)] == [30] * 8


def test_callbacks_may_throw_and_step():
    sim = bed()
    with pytest.raises(ZeroDivisionError):
        sim.run(until=lambda: 1 / 0)
    sim.run(until=lambda: sim.step(2) or sim.step_count > 20)
    assert sim.step_count > 20
    other = copy.deepcopy(sim)
    sim.run(0.05, until=lambda: False, every=0.01)
    other.run(0.05)
    assert sim.state_hash == other.state_hash


SCRIPT = f"import talus\nsim = talus.Simulation({BED!r}, **{{'bed.length': 60, 'bed.depth': 30, 'tilt.rate': 1, 'tilt.step': 0.005}})\n"


def test_ctrl_c_leaves_a_whole_state():
    script = SCRIPT + ("print('go', flush=True)\ntry:\n    sim.run()\nexcept KeyboardInterrupt:\n"
                       "    print('stopped', sim.step_count)\n    sim.step(2)\n    print('whole', sim.state_hash)\n")
    process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True, env=os.environ)
    assert process.stdout.readline() == "go\n"
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=60)
    assert process.returncode == 0 and "stopped" in out and "whole" in out


def test_the_interpreter_ends_while_a_bed_is_stepped():
    script = SCRIPT + ("import threading\nthreading.Thread(target=sim.run, daemon=True).start()\nimport time\ntime.sleep(0.3)\n"
                       "print('end', flush=True)\n")
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0 and done.stdout == "end\n", done.stderr


def test_memory_stays_flat():
    import resource

    sim = bed(tilt={"rate": 0.5, "step": 0.002})
    sim.deposit()
    sim.tilt_rate = 0
    views = []

    def peak_after(steps):
        for _ in range(steps // 50):
            sim.step(50)
            views.append(sim.grains.position)
            sim.contacts.force, sim["kinetic_energy"]
            del views[:-3]
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    first = peak_after(3000)
    assert peak_after(6000) - first < 8 * 1024  # kB


def test_the_page_runs_as_it_is_printed(tmp_path):
    text = (ROOT / "docs/python.md").read_text()
    code = "\n".join(re.findall(r"^```python\n(.*?)^```$", text, re.MULTILINE | re.DOTALL))
    (tmp_path / "assets").symlink_to(ROOT / "assets")
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, env=os.environ)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "held.png").stat().st_size > 1000 and (tmp_path / "last.png").stat().st_size > 1000


def test_types_are_those_of_the_stubs():
    if importlib.util.find_spec("mypy") is None:
        pytest.skip("mypy is not installed: python3-mypy")
    done = subprocess.run([sys.executable, "-m", "mypy", "--ignore-missing-imports", "--follow-imports=silent", "--cache-dir", os.devnull,
                           "talus/simulation.py", "talus/frame.py"], cwd=ROOT / "python", capture_output=True, text=True)
    assert done.returncode == 0, done.stdout


def test_commands_of_the_scenario_are_carried_out_however_it_is_stepped(tmp_path):
    scenario = tmp_path / "scripted.toml"
    scenario.write_text(bed().scenario + """
[[command]]
at = 2
kind = "drop"
grain = 5
x = 0.05
y = 0.02
[[command]]
time = 0.1
kind = "friction"
x = 0.2
[[command]]
at = 5
kind = "tilt_rate"
x = 0
[[command]]
time = 0.3
kind = "tilt_rate"
x = 40
""")
    run_talus("run", scenario, "-o", tmp_path / "run.h5", "-q")
    chunks = talus.Simulation(scenario, threads=2)
    chunks.record(tmp_path / "chunks.h5")
    chunks.tilt_to(6)  # through the hold
    assert chunks.friction == 0.2
    chunks.copy().run()
    while not chunks.done:
        chunks.step(17)
    by_hand = bed()
    by_hand.tilt_to(2)
    by_hand.drop(5, 0.05, 0.02)
    by_hand.tilt_to(4)
    by_hand.friction = 0.2
    by_hand.tilt_to(5)
    by_hand.tilt_rate = 0
    by_hand.run(0.175)
    by_hand.tilt_rate = 40
    by_hand.run()
    run = talus.open(tmp_path / "run.h5")
    assert chunks.state_hash == by_hand.state_hash == state_of(run.path) == state_of(tmp_path / "chunks.h5")


def test_a_cyclic_tilt_with_feedback_is_replayed_without_python(tmp_path):
    """The tilt turns when the share of sliding contacts passes 0.3, and at each goal on the other side."""
    sim = bed(**{"bed.length": 10, "bed.depth": 4})
    sim.record(tmp_path / "cycles.h5")
    turns = []
    for cycle in range(2):
        sim.tilt_to(0)
        sim.tilt_rate = 40
        sim.run(until=lambda: sim["contacts/critical_share"] > 0.3 or sim.tilt > 6, every=0.005)
        turns.append(sim.tilt)
        sim.tilt_to(-3)
        turns.append(sim.tilt)
        sim.tilt_by(1.5)
        turns.append(sim.tilt)
    assert not sim.done and np.allclose(turns[1::3], -3) and np.allclose(turns[2::3], -1.5) and min(turns[::3]) > 0
    sim.commit()
    run_talus("replay", tmp_path / "cycles.h5", "-o", tmp_path / "again.h5")
    assert state_of(tmp_path / "again.h5") == sim.state_hash == state_of(tmp_path / "cycles.h5")
    del sim
    resumed = talus.resume(tmp_path / "cycles.h5")
    resumed.tilt_to(1)
    assert resumed.tilt == pytest.approx(1)


def test_goals_that_are_never_reached_are_errors():
    sim = bed(**{"bed.length": 10, "bed.depth": 4})
    for seconds in (-1, 0, 0.0004, float("nan"), float("inf")):
        with pytest.raises(talus.Error):
            sim.run(seconds)
        with pytest.raises(talus.Error):
            sim.run(seconds, until=lambda: True)
    with pytest.raises(talus.Error, match=r"step\(-3\)"):
        sim.step(-3)
    with pytest.raises(talus.Error, match="every"):
        sim.run(1, until=lambda: False, every=-0.1)
    assert sim.step_count == 0
    sim.deposit()
    sim.tilt_rate = 0
    for goal in (lambda: sim.tilt_to(2), lambda: sim.tilt_by(-1), sim.run):
        with pytest.raises(talus.Error, match="held"):
            goal()
    with pytest.raises(talus.Error, match="-100 ... 100"):
        sim.tilt_rate = -101
    program = bed(**{"bed.length": 10, "bed.depth": 4, "tilt.program": ["to 2", "to -2"]})
    with pytest.raises(talus.Error, match="programme"):
        program.tilt_to(3)
    program.tilt_to(-1)
    assert program.tilt == pytest.approx(-1)


def test_times_of_a_condition_carry_over_fractions_of_steps():
    sim = bed(**{"bed.length": 10, "bed.depth": 4})  # steps of 2.5 ms
    sim.deposit()
    begin, calls = sim.step_count, []
    for _ in range(4):
        sim.run(0.02, until=lambda: calls.append(sim.step_count - begin), every=0.006)
    assert sim.step_count - begin == 32
    assert calls == [0, 2, 5, 7, 8, 8, 10, 13, 15, 16, 16, 18, 21, 23, 24, 24, 26, 29, 31, 32]
    for _ in range(10):
        sim.run(0.006)
    assert sim.step_count - begin == 56
