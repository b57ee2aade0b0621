"""Simulations driven by a script: bits, views, errors, threads, and docs/python.md as printed."""

import copy
import importlib.util
import os
import pickle
import re
import subprocess
import sys
import threading
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
    scenario.write_text(bed().scenario_text)
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


def test_a_stopped_run_goes_on_on_either_side(tmp_path):
    whole = bed()
    whole.run()
    sim = bed()
    assert sim.residual is None and sim.converged is None
    sim.record(tmp_path / "deep/down/a.h5")
    sim.tilt_to(4)
    sim.commit()
    known = sim.residual, sim.converged
    sim.save(tmp_path / "saved/a.h5")
    del sim
    resumed = talus.resume(tmp_path / "deep/down/a.h5")
    saved = talus.resume(tmp_path / "saved/a.h5")
    assert (resumed.residual, resumed.converged) == (saved.residual, saved.converged) == known and known[1] is True
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
    assert frame.tilt == frame["tilt"] == tilt == 4.0 and run.tilt[frame.index] == tilt
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
    for wrong, code in [(lambda: sim.step(-1), 64), (lambda: sim.push(10**6, (0, 0)), 64), (lambda: sim.draw("gama"), 64),
                        (lambda: sim.record(tmp_path / "run.h5"), 64), (lambda: sim.draw("gamma", width=-3), 64),
                        (lambda: talus.Simulation({"bed.length": -1}), 65), (lambda: bed().record("/proc/no/run.h5"), 73)]:
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
    scenario.write_text(bed().scenario_text + """
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
    run = talus.open(tmp_path / "run.h5")
    assert chunks.state_hash == state_of(run.path) == state_of(tmp_path / "chunks.h5")


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


def test_times_of_a_condition_carry_over_fractions_of_steps():
    sim = bed(**{"bed.length": 10, "bed.depth": 4})  # steps of 2.5 ms
    sim.deposit()
    begin, calls = sim.step_count, []
    for _ in range(4):
        sim.run(0.02, until=lambda: calls.append(sim.step_count - begin), every=0.006)
    assert sim.step_count - begin == 32
    assert calls == [0, 2, 5, 7, 8, 8, 10, 13, 15, 16, 16, 18, 21, 23, 24, 24, 26, 29, 31, 32]


#: Wrong calls, the built-in exception that Python expects of each, and the exit code. `s` is a simulation, `r` its file, `f` a
#: frame of it.
WRONG = [
    (lambda s, r, f: s["kinetic_enrgy"], KeyError, 64, "did you mean 'kinetic_energy'"),
    (lambda s, r, f: f["kinetic_enrgy"], KeyError, 64, "did you mean 'kinetic_energy'"),
    (lambda s, r, f: s["nope"], KeyError, 64, "`quantities` lists the names"),
    (lambda s, r, f: s.grains["clustr"], KeyError, 64, "did you mean 'cluster'"),
    (lambda s, r, f: f.grains["clustr"], KeyError, 64, "did you mean 'cluster'"),
    (lambda s, r, f: s.contacts["statu"], KeyError, 64, "did you mean 'status'"),
    (lambda s, r, f: f.contacts["statu"], KeyError, 64, "did you mean 'status'"),
    (lambda s, r, f: r["observables/volume_strian"], KeyError, 64, "did you mean 'observables/volume_strain'"),
    (lambda s, r, f: r.observables["volume_strian"], KeyError, 64, "did you mean 'volume_strain'"),
    (lambda s, r, f: r.frames[99], IndexError, 64, "frames"),
    (lambda s, r, f: r.frame_at(99), IndexError, 64, "no frame at 99 deg"),
    (lambda s, r, f: talus.open(r.path, units="mm"), ValueError, 64, "expected \"SI\""),
    (lambda s, r, f: talus.open("none.h5"), FileNotFoundError, 66, "no such run"),
    (lambda s, r, f: talus.resume("none.h5"), FileNotFoundError, 66, "no interrupted run"),
    (lambda s, r, f: talus.open_ensemble("none"), FileNotFoundError, 66, "no ensemble here"),
    (lambda s, r, f: talus.Simulation("none.toml"), FileNotFoundError, 66, "cannot read"),
    (lambda s, r, f: talus.resume(r.path), ValueError, 64, "is complete"),
    (lambda s, r, f: bed().record(r.path), OSError, 73, "exists already"),
    (lambda s, r, f: talus.Simulation(5), TypeError, 64, "expected the path"),
    (lambda s, r, f: talus.Simulation({"bed.lenght": 3}), ValueError, 65, "did you mean 'bed.length'"),
    (lambda s, r, f: talus.Simulation({"contact.friction": -1}), ValueError, 65, "key 'contact.friction' = -1: expected"),
    (lambda s, r, f: bed().analyse_with(l_min=-1), ValueError, 65, "key 'l_min' = -1: expected"),
    (lambda s, r, f: bed().record("x.txt"), ValueError, 64, "such as"),
    (lambda s, r, f: setattr(s, "friction", None), TypeError, 64, "friction = None: expected a number"),
    (lambda s, r, f: setattr(s, "tilt_rate", "1"), TypeError, 64, "tilt_rate = '1': expected a number"),
    (lambda s, r, f: s.tilt_to(float("nan")), ValueError, 64, "finite"),
    (lambda s, r, f: s.record("x.h5", overwrite="yes"), TypeError, 64, "overwrite = 'yes'"),
    (lambda s, r, f: setattr(s, "fricton", 0.1), AttributeError, 64, "did you mean 'friction'"),
    (lambda s, r, f: setattr(s, "tilt", 0.1), AttributeError, 64, "cannot be set"),
    (lambda s, r, f: setattr(s.grains, "radus", 1), AttributeError, 64, "did you mean 'radius'"),
    (lambda s, r, f: setattr(r, "lenght", 1), AttributeError, 64, "did you mean 'length'"),
    (lambda s, r, f: setattr(f, "tlt", 1), AttributeError, 64, "did you mean 'tilt'"),
    (lambda s, r, f: f.grains.positon, AttributeError, 64, "did you mean 'position'"),
    *((lambda s, r, f, t=threads: bed(threads=t), TypeError, 64, "threads = ") for threads in ("2", None, float("nan"), 1j, [1])),
    *((lambda s, r, f, t=threads: bed(threads=t), ValueError, 64, "expected 1 to 256") for threads in (0, 257, 2**63)),
    *((lambda s, r, f, b=bad, on=which: (s, f)[on].draw("gamma", l_min=b), ValueError, 64, "l_min: expected a number from 0 to 100")
      for bad in (float("inf"), float("nan"), -1, 1e300, np.float16("inf")) for which in (0, 1)),
    (lambda s, r, f: s.draw("gamma", threshold=float("nan")), ValueError, 64, "threshold: expected"),
    (lambda s, r, f: f.draw("gamma", theta_c=float("nan")), ValueError, 64, "theta_c: expected"),
    (lambda s, r, f: s.draw("coarse", length=1e-300), ValueError, 64, "length: expected"),
    (lambda s, r, f: s.draw("gamma", range=[1]), ValueError, 64, "range: expected"),
    (lambda s, r, f: s.analyse_with(l_min=float("inf")), ValueError, 65, "l_min"),
    (lambda s, r, f: f.analyse_with(l_min=float("inf")), ValueError, 65, "l_min"),
]


@pytest.fixture(scope="module")
def opened(tmp_path_factory):
    sim = bed()
    sim.record(tmp_path_factory.mktemp("opened") / "run.h5")
    sim.run(1.5)
    while not sim.done:
        sim.run(1.5)
    run = talus.open(next(path for path in tmp_path_factory.getbasetemp().glob("opened*/run.h5")))
    return bed(), run, run.frames[-1]


@pytest.mark.parametrize("number", range(len(WRONG)))
def test_an_error_is_also_the_exception_that_python_expects(number, opened, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    call, expected, code, text = WRONG[number]
    with pytest.raises(talus.Error, match=re.escape(text)) as raised:
        call(*opened)
    assert isinstance(raised.value, expected) and raised.value.exit_code == code
    again = pickle.loads(pickle.dumps(raised.value))
    assert (type(again), str(again), again.exit_code) == (type(raised.value), str(raised.value), code)


def test_all_names_that_are_listed_are_known(opened):
    sim, run, frame = opened
    for source in (sim, frame):
        assert {"overloaded/fraction", "overloaded/fraction[1]", "kinetic_energy"} <= set(source.quantities)
        for name in source.quantities:
            assert isinstance(source[name], float), name
        assert {"cluster", "cluster_1", "cluster_2", "lc_2", "velocity"} <= set(source.grains.quantities)
        for name in source.grains.quantities:
            assert len(source.grains[name]) == len(source.grains), name
        for name in source.contacts.quantities:
            source.contacts[name]
    assert all(run[name] is not None for name in run.quantities)


def test_ids_are_integers_and_flags_are_booleans_at_every_threshold(opened):
    _, _, frame = opened
    frame.analyse_with(gamma_c=0.2, threshold_factors=[1, 1.5])
    sim = bed()
    sim.tilt_to(6)
    sim.analyse_with(gamma_c=np.array(0.2), threshold_factors=np.array([1, 1.5]))
    for grains, contacts in ((sim.grains, sim.contacts), (frame.grains, frame.contacts)):
        gamma = np.nan_to_num(grains["gamma_neighbourhood"])
        for name, factor in (("", 1), ("_1", 1), ("[1]", 1.5), ("_1_5", 1.5)):
            overloaded, cluster = grains["overloaded" + name], grains["cluster" + name]
            assert overloaded.dtype == bool and cluster.dtype == np.int64
            np.testing.assert_array_equal(overloaded, grains.free & (gamma >= factor * 0.2))
            sizes = np.bincount(cluster[cluster >= 0])
            assert sizes.sum() == overloaded.sum() and (np.diff(sizes) <= 0).all(), "clusters begin with the largest"
            assert np.isnan(grains["lc" + name][~overloaded]).all()
        for name in ("id", "type", "image", "coordination", "sliding"):
            assert grains[name].dtype == np.int64, name
        assert contacts["status"].dtype == contacts["a"].dtype == np.int64 and contacts["strong"].dtype == bool
        assert set(contacts["status"]) <= {1, 2} and grains["velocity"].shape == (len(grains), 2)
    with pytest.raises(KeyError):
        sim.grains["cluster_2"]


def test_the_tilt_has_one_unit(tmp_path):
    sim = bed(tilt={"rate": 40, "step": 0.1})
    sim.record(tmp_path / "run.h5")
    sim.tilt_to(3)
    assert sim.tilt == sim["tilt"] == 3 and sim.tilt_rate == 40, "30 steps of 0.1 deg, without rounding errors"
    sim.run()
    for units in ("SI", "D"):
        run = talus.open(tmp_path / "run.h5", units)
        for frame in run.frames:
            assert frame.tilt == frame["tilt"] == run.tilt[frame.index] == round(frame.tilt, 6)
        assert run.theta_c == sim.theta_c
    np.testing.assert_allclose(np.radians(run.tilt), talus.open(tmp_path / "run.h5")["frames/tilt"], atol=1e-11)


def test_a_scenario_is_a_dictionary_in_either_direction(tmp_path, monkeypatch):
    import pathlib
    import tomllib

    monkeypatch.chdir(tmp_path)
    text = ('[bed]\nlength = 12\ndepth = 4\n[[command]]\nat = 1\nkind = "friction"\nx = 0.3\n[[command]]\ntime = 2\nkind = "push"\n'
            'grain = 3\nx = 0.1\ny = 0\n')
    pathlib.Path("bed.toml").write_text(text)
    sim = talus.Simulation("bed.toml")
    assert talus.Simulation(tomllib.loads(text)).scenario == sim.scenario == talus.Simulation(sim.scenario).scenario
    assert tomllib.loads(sim.scenario_text) == sim.scenario
    assert talus.Simulation(command=[{"at": np.float32(1), "kind": "friction", "x": np.array(0.25)}]).scenario["command"][0]["x"] == 0.25
    both = talus.Simulation("bed.toml", command=[{"at": 1, "kind": "friction", "x": 0.25}], seed=7).scenario
    assert both["command"] == [{"at": 1, "kind": "friction", "x": 0.25}], "instead of those of the file"
    assert both["bed"] == sim.scenario["bed"] and both["seed"] == 7
    for wrong, key in [({"command": [{"at": 1, "kind": "frction"}]}, "command.1.kind"), ({"command": [{"at": 1}, {"x": None}]}, "command.2.x"),
                       ({"command": [{"at": 1}, 3]}, "command"), ({"contact": {"friction": np.ma.masked}}, "contact.friction")]:
        with pytest.raises(talus.Error, match=re.escape(key)):
            talus.Simulation(wrong)
    pathlib.Path("grains.csv").write_text("x,y,radius\n" + "".join(f"{i + 0.5},0.6,0.5\n" for i in range(10)))
    keys = {"bed.length": np.array(10), "bed.depth": np.int64(2), "deposition.method": np.str_("file"), "seed": np.array(3),
            "deposition.file": tmp_path / "grains.csv", "contact.friction": np.array(0.3), "contact.wall_friction": np.float16(0.25)}
    from_path = talus.Simulation(keys).scenario
    assert from_path["deposition"]["file"] == str(tmp_path / "grains.csv") and from_path["contact"]["friction"] == 0.3


class Watched(talus.Simulation):
    def __init__(self, *scenario, **settings):
        super().__init__(*scenario, **settings)
        self.seen = [self.tilt]


def test_a_derived_class_has_attributes_of_its_own_and_copies():
    sim = Watched(BED)
    sim.seen.append(1.0)
    other, deep = sim.copy(), copy.deepcopy(sim)
    assert type(other) is type(deep) is Watched and other.seen is sim.seen
    assert deep.seen == sim.seen and deep.seen is not sim.seen
    other.step(3)
    assert other.step_count == 3 and sim.step_count == deep.step_count == 0
