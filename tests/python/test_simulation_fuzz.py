"""Random calls of a simulation and of frames, most of them wrong: each succeeds or raises a documented
error, and leaves the simulation in the state of a twin that received only the successful calls.
TALUS_TRIES=1000 sets the number of tries; a failure names its seed, and TALUS_SEED=12 repeats it alone."""

import contextlib
import copy
import io
import os
import pickle
import random
import signal
import sys

import numpy as np
import pytest
import talus
from conftest import run_talus
from test_simulation import bed

pytest.importorskip("talus._core", reason="the extension is not built: pybind11-dev, python3-dev")

TRIES, FIRST = int(os.environ.get("TALUS_TRIES", 8)), int(os.environ.get("TALUS_SEED", -1))
SEEDS = range(TRIES) if FIRST < 0 else [FIRST]
CALLS = 60


class HostileError(Exception):
    """Error of an object passed as argument."""


class Hostile:
    """Raises an error for every access."""

    def raises(self, *_):
        raise HostileError

    __float__ = __int__ = __index__ = __len__ = __iter__ = __getitem__ = __array__ = __repr__ = __str__ = __bool__ = raises
    __call__ = __fspath__ = __lt__ = __gt__ = __add__ = __radd__ = keys = raises


class Writer(io.StringIO):
    """A terminal that has been closed."""

    def write(self, text):
        raise HostileError


#: Errors that a call may raise; the error of a Hostile object reaches the caller.
EXPECTED = (talus.Error, TypeError, AttributeError, HostileError, KeyboardInterrupt)
endless = []
endless.append(endless)


def value(rng):
    """Returns a random object, whatever is expected."""
    return rng.choice([
        0, 1, 2, 5, -1, 0.01, 0.3, 1e-9, 1e300, -1e300, 5e-324, float("nan"), float("inf"), -float("inf"), 2**31, -2**31 - 1, 2**63, 2**64,
        10**400, True, None, "a", "1", "", "\0", "\ud800", "x" * 10000, "é", b"x", b"\xff", [], {}, (), object(), np.float32(1), np.int64(3),
        np.uint64(2**63), np.array(2), np.array([1, 2]), np.zeros((2, 3)), np.array([[[]]]), np.array(["a"]), np.array([object()]),
        np.array([np.nan, 1]), np.bool_(True), np.datetime64("2020"), 1j, Hostile(), [Hostile()], lambda: 1, talus.Simulation, range(3),
        memoryview(b"abc"), endless, {"a": {}}, (1, 2), (0.01, 0.0), [1e-3, 1e-3], [[0.01, 0.0]] * 2, [1, 2], iter(())])


def number(rng):
    """Returns mostly a value of the expected kind, of less than the 12 digits to which a simulation reports its rate."""
    return value(rng) if rng.random() < 0.4 else rng.choice([0, 1, 3, 17, 0.01, 0.05, 0.5, np.float64(0.2), round(rng.random(), 9)])


def name(rng):
    return value(rng) if rng.random() < 0.3 else rng.choice([
        "gamma", "pressure", "overloaded/fraction", "lc", "lc/mean[0]", "lc/mean[1]", "lc/mean[99999999999999999999]", "lc/mean[-1]", "lc/mean[",
        "kinetic_energy", "mobilisation", "clusters", "forces", "gamma+forces", "+", "gamma+", "stress", "nope", "l_min", "gamma_c", "width",
        "gamma'\"\n", "coordination", "bed.length", "seed"])


def write(view, rng):
    """Attempts to write to a view, which must not succeed."""
    shape = value(rng)
    for wrong in (lambda: view.setflags(write=True), lambda: view.resize(7 if shape is None else shape), lambda: view.__setitem__(0, value(rng)),
                  lambda: np.add(view, 1, out=view)):
        with pytest.raises((*EXPECTED, ValueError, OverflowError, IndexError)):
            wrong()


def until(rng, sim):
    """Returns a callback that inspects, raises, steps, or interrupts."""
    kind = rng.randrange(6)
    left = [rng.randrange(5)]

    def holds():
        left[0] -= 1
        if kind == 0:
            raise HostileError
        if kind == 1:
            sim.step(1)
        if kind == 2:
            sim.copy().step(2)
        if kind == 3:
            raise KeyboardInterrupt
        return sim.tilt > 1e9 or left[0] < 0

    return rng.choice([holds, holds, value(rng)])


#: Calls that step or only inspect, and commands, which the twin receives too if they succeed.
LOOKS = {
    "step": lambda sim, rng: sim.step(number(rng)), "deposit": lambda sim, rng: sim.deposit(),
    "tilt_to": lambda sim, rng: sim.tilt_to(number(rng)), "tilt_by": lambda sim, rng: sim.tilt_by(number(rng)),
    "run": lambda sim, rng: sim.run(number(rng)), "finish": lambda sim, rng: sim.run(),
    "run until": lambda sim, rng: sim.run(number(rng), until=until(rng, sim), every=number(rng)),
    "quantity": lambda sim, rng: sim[name(rng)], "grains": lambda sim, rng: sim.grains[name(rng)],
    "contacts": lambda sim, rng: sim.contacts[name(rng)],
    "analyse": lambda sim, rng: sim.analyse_with(**{rng.choice(["l_min", "gamma_c", "nope", "\ud800", "a=b", "min_contacts"]): value(rng)}),
    "draw": lambda sim, rng: sim.draw(name(rng), width=rng.choice([200, 300, value(rng)])),
    "draw with": lambda sim, rng: sim.draw(**{rng.choice(["map", "theta_c", "l_min", "length", "threshold", "range", "colours", "turned", "bare",
                                                          "nope", "__class__", "maps"]): value(rng), "width": 200}),
    "commit": lambda sim, rng: sim.commit(), "copy": lambda sim, rng: rng.choice([copy.copy, copy.deepcopy])(sim).step(number(rng)),
    "pickle": lambda sim, rng: pickle.dumps(sim), "repr": lambda sim, rng: (repr(sim), repr(sim.grains), repr(sim.contacts)),
    "property": lambda sim, rng: setattr(sim, rng.choice(["tilt", "time", "phase", "state_hash", "done", "scenario"]), value(rng)),
    "record": lambda sim, rng: sim.record(value(rng), overwrite=value(rng)) if rng.random() < 0.5 else sim.record("no/such/folder"),
    "iterate": lambda sim, rng: list(rng.choice([sim, sim.grains, sim.contacts])),
    "contained": lambda sim, rng: value(rng) in rng.choice([sim, sim.grains]),
    "write": lambda sim, rng: write(rng.choice([sim.grains.position, sim.grains.velocity, sim.grains.mass, sim.grains.image]), rng),
    "made": lambda sim, rng: talus.Simulation(value(rng), **{rng.choice(["seed", "bed", "contact.friction", "threads", "nope"]): value(rng)}),
    "resumed": lambda sim, rng: talus.resume(value(rng), threads=value(rng)),
}
COMMANDS = {
    "push": lambda sim, rng: sim.push(rng.choice([value(rng), rng.randrange(60), [1, 2, rng.randrange(200)]]),
                                      rng.choice([value(rng), (0.01, -0.01), (number(rng), 0.0)])),
    "drop": lambda sim, rng: sim.drop(number(rng), number(rng), number(rng)),
    "drag": lambda sim, rng: sim.drag(number(rng), rng.choice([value(rng), (number(rng), number(rng))])),
    "release": lambda sim, rng: sim.release(), "friction": lambda sim, rng: setattr(sim, "friction", number(rng)),
    "tilt_rate": lambda sim, rng: setattr(sim, "tilt_rate", number(rng)),
}
STEPPING = ("step", "deposit", "tilt_to", "tilt_by", "run", "finish", "run until", "copy")


def catch_up(twin, sim):
    """Steps made before an error are kept, and the division into chunks does not matter. A goal of the tilt may have turned
    it, at once or when the bed was at rest."""
    if twin.tilt_rate == -sim.tilt_rate != 0:
        if twin.phase == "deposition":
            twin.deposit()
        twin.tilt_rate = sim.tilt_rate
    while (before := twin.step_count) < sim.step_count:
        with contextlib.suppress(talus.Error):
            twin.step(sim.step_count - before)
        assert twin.step_count > before


def check_whole(sim, twin):
    grains = sim.grains
    for values in (grains.position, grains.velocity, grains.angle, grains.radius, sim.contacts.force, sim.contacts.gap):
        assert np.isfinite(values).all()
    assert len(grains.position) == len(grains) == len(grains.mass) and 0 <= grains.free_count <= len(grains)
    assert sim.contacts.pair.shape == sim.contacts.force.shape == (len(sim.contacts), 2)
    assert sim.phase in ("deposition", "tilt", "flow", "done") and sim.done == (sim.phase == "done")
    assert (sim.state_hash, sim.tilt, sim.phase, sim.friction, sim.tilt_rate) == (twin.state_hash, twin.tilt, twin.phase, twin.friction,
                                                                               twin.tilt_rate)


def attempt(do, *arguments):
    """Makes a call, and interrupts it if it steps for long. The interruption may come as late as when the timer is stopped."""
    with contextlib.suppress(*EXPECTED):
        try:
            signal.setitimer(signal.ITIMER_REAL, 0.1)
            do(*arguments)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)


@pytest.fixture(autouse=True)
def interrupting(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    former = signal.signal(signal.SIGALRM, signal.default_int_handler)
    yield
    signal.signal(signal.SIGALRM, former)


@pytest.mark.parametrize("seed", SEEDS)
def test_calls_of_chance_leave_a_simulation_whole(seed, tmp_path, monkeypatch):
    rng = random.Random(seed)
    sim = bed(threads=1 + seed % 2, progress=seed % 4 == 3)
    monkeypatch.setattr(sys, "stderr", Writer() if seed % 8 == 7 else io.StringIO())
    twin = bed(progress=False)
    recorded = seed % 3 > 0
    if recorded:
        sim.record(tmp_path / "run.h5")
    views = []
    for k in range(CALLS):
        called = rng.choice([*LOOKS, *COMMANDS, *COMMANDS])
        state = rng.getstate()
        where = f"TALUS_SEED={seed}, call {k}: {called}"
        try:
            if called in COMMANDS:
                try:
                    COMMANDS[called](sim, rng)
                except EXPECTED:
                    pass
                else:
                    again = random.Random()
                    again.setstate(state)
                    COMMANDS[called](twin, again)
            elif called in STEPPING:
                attempt(LOOKS[called], sim, rng)
            else:
                with contextlib.suppress(*EXPECTED):
                    LOOKS[called](sim, rng)
            catch_up(twin, sim)
            check_whole(sim, twin)
        except BaseException as error:
            raise AssertionError(where) from error
        views.append(sim.grains.position)
        del views[:-5]
    with contextlib.suppress(talus.Error):  # already released, or ended
        sim.tilt_rate = 90
    end = sim.state_hash, sim.done
    del sim
    assert all(np.isfinite(view).all() for view in views)
    views.clear()  # they keep the simulation alive, and it keeps its recording
    if recorded and not end[1]:
        resumed = talus.resume("run.h5", progress=False)
        assert resumed.state_hash == end[0], f"TALUS_SEED={seed}"
        with contextlib.suppress(talus.Error):
            resumed.tilt_to(80)
        done, end = resumed.done, (resumed.state_hash, True)
        del resumed
        if not done:
            return
    if recorded:
        assert end[0] in run_talus("replay", "run.h5"), f"TALUS_SEED={seed}"


def test_calls_of_chance_of_frames(tmp_path):
    sim = bed(progress=False)
    sim.record(tmp_path / "run.h5")
    sim.run()
    run = talus.open(tmp_path / "run.h5")
    looks = [
        lambda rng: run.frames[value(rng)], lambda rng: run.frame_at(value(rng)), lambda rng: run[value(rng)],
        lambda rng: rng.choice(run.frames)[name(rng)], lambda rng: rng.choice(run.frames).grains[name(rng)],
        lambda rng: rng.choice(run.frames).draw(name(rng), width=rng.choice([200, value(rng)])),
        lambda rng: rng.choice(run.frames).draw(**{rng.choice(["theta_c", "length", "threshold", "range", "nope"]): value(rng), "width": 200}),
        lambda rng: getattr(rng.choice(run.frames).grains, rng.choice(["position", "mass", "nope", "_frame"])),
        lambda rng: pickle.loads(pickle.dumps(rng.choice(run.frames)))["lc"], lambda rng: rng.choice(run.frames) == value(rng),
        lambda rng: talus.open(value(rng)), lambda rng: rng.choice(run.frames).draw(width=200).save(value(rng))]
    for seed in SEEDS:
        rng = random.Random(seed)
        for k in range(CALLS // 2):
            try:
                rng.choice(looks)(rng)
            except (*EXPECTED, OSError):  # a picture that cannot be saved
                pass
            except Exception as error:
                raise AssertionError(f"TALUS_SEED={seed}, call {k}") from error
