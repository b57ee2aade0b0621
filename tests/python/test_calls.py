"""Every public call with arguments of wrong types and values: each error is a talus.Error, which is also
the error that the protocols of Python require."""

import copy
import math
import os
import pickle
import shutil
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT, run_talus
from resealed import sealed

import talus

KEPT = ROOT / "tests/runs/schema_4.h5"

#: None of these is an index, a name, a position, a path or a unit.
NOTHING = [1.7, 1e300, math.nan, math.inf, -math.inf, 1j, True, np.True_, np.float64(1.0), "x", "repos", "", b"x", None, (), [0],
           {}, {1, 2}, object(), len, type, 10**30, -(10**30), np.array([1, 2]), np.array(["a", "b"]), np.array(1.5), Ellipsis,
           "\0", "\x1b[2J", "\ud800", "help/\ud800", "a/../b", slice(0.5, 2), slice("a", None), slice(None, None, 0), range(3), Exception("x")]


@pytest.fixture(scope="module")
def kept():
    with talus.open(KEPT) as run:
        yield run


def never(*values):
    """Returns all wrong values except those of these types, which are valid for the call."""
    return [value for value in NOTHING if not isinstance(value, values)]


CALLS = {
    "frames[]": (lambda run, x: run.frames[x], NOTHING),
    "frames.index": (lambda run, x: run.frames.index(x), NOTHING),
    "frame_at": (lambda run, x: run.frame_at(x), [x for x in NOTHING if repr(x) not in ("1.7", "1.0", "np.float64(1.0)", "array(1.5)")]),
    "frame_index": (lambda run, x: run.frame_index(x), NOTHING),
    "Frame": (lambda run, x: talus.Frame(run, x), NOTHING),
    "read_frame name": (lambda run, x: run.read_frame(x, 0), NOTHING + [
        "help/particles/grains/position/value", "contacts/offset", "contacts/none", "frames/tilt", "checkpoint/contact_pair"]),
    "read_frame index": (lambda run, x: run.read_frame("contacts/pair", x), NOTHING),
    "run[]": (lambda run, x: run[x], NOTHING),
    "unit": (lambda run, x: run.unit(x), NOTHING),
    "meaning": (lambda run, x: run.meaning(x), NOTHING),
    "store name": (lambda run, x: run.store(x, []), NOTHING + ["Slip", "a b", "gamma", "velocity_x", "a" * 41]),
    "store values": (lambda run, x: run.store("slip", x), NOTHING),
    "table[]": (lambda run, x: run.observables[x], NOTHING),
    "table.unit": (lambda run, x: run.steps.unit(x), NOTHING),
    "table.meaning": (lambda run, x: run.steps.meaning(x), NOTHING),
    "open": (lambda run, x: talus.open(x), NOTHING),
    "open units": (lambda run, x: talus.open(KEPT, x), NOTHING),
    "open_ensemble": (lambda run, x: talus.open_ensemble(x), NOTHING),
    "mean_of": (lambda run, x: talus.mean_of(x), [x for x in never(tuple, dict, range) if not isinstance(x, (list, np.ndarray))] +
                [[[1, 2], [3]], [1, "x"], np.array(["a"]), np.zeros((2, 2)), [1j]]),
    "stress_ratio": (lambda run, x: talus.stress_ratio(x), NOTHING + [np.zeros((2, 3)), [[1, 2], [3]], [["a"] * 2] * 2]),
}


@pytest.mark.chosen
@pytest.mark.parametrize("name", CALLS)
def test_what_is_wrong_ends_in_an_error(kept, name):
    call, values = CALLS[name]
    for value in values:
        try:
            call(kept, value)
        except talus.Error as error:
            text = str(error)
            assert len(text) > 20 and text.isprintable(), (value, text)
        except Exception as error:
            raise AssertionError(f"{name} of {value!r}") from error
        else:
            raise AssertionError(f"{name} takes {value!r}")


@pytest.mark.chosen
def test_errors_are_those_that_python_asks_for(kept):
    frames = kept.frames
    for wrong, kind in [(len(frames), IndexError), (1.7, TypeError), ("x", TypeError), (True, TypeError)]:
        with pytest.raises(kind, match=f"has {len(frames)} frames" if kind is IndexError else ""):
            frames[wrong]
    with pytest.raises(KeyError):
        kept.observables["none"]
    with pytest.raises(TypeError):
        kept.frame_at("repos")
    assert kept.observables.get("none", 3) == 3 and "none" not in kept.observables and 1 not in kept.observables
    with pytest.raises(talus.Error) as error:
        kept.observables["none"]
    assert not str(error.value).startswith(('"', "'"))
    again = pickle.loads(pickle.dumps(error.value))
    assert type(again) is type(error.value) and str(again) == str(error.value)


@pytest.mark.parametrize("name", ["help/\ud800", "\ud800/x", "results/\ud800", "help/\ud800/value"])
def test_a_name_that_no_file_can_have_is_no_damage(kept, name):
    for call in (kept.__getitem__, kept.unit, kept.meaning):
        with pytest.raises(talus.Error, match=r"has no data set .*\\ud800"):
            call(name)


def test_frames_are_indexed_as_a_list_is(kept):
    whole = list(range(len(kept.frames)))
    for k in (0, -1, np.int8(2), np.uint64(1), np.array(3), 2):
        assert kept.frames[k].index == whole[k] and type(kept.frames[k].index) is int
    for part in (slice(None), slice(1, -1), slice(None, None, -2), slice(np.int64(1), 100), slice(5, 2)):
        assert [frame.index for frame in kept.frames[part]] == whole[part]
    assert [frame.index for frame in reversed(kept.frames)] == whole[::-1]
    assert kept.frames.index(kept.frames[3]) == 3 and kept.frames[2] in kept.frames and "x" not in kept.frames
    assert kept.frames.count(kept.frames[1]) == 1
    for angle in (0, 0.0, np.float32(0), np.int64(0), np.array(0.0)):
        assert kept.frame_at(angle).index == 0


@pytest.mark.chosen
def test_calls_of_an_ensemble(folder, tmp_path):
    run_talus("ensemble", folder / "bed.toml", "--seeds", "1-2", "--set", "tilt.end_angle=0.5", "-o", tmp_path / "e")
    ensemble = talus.open_ensemble(tmp_path / "e")
    [first, _] = ensemble.done()
    calls = [lambda x: ensemble.numbers(x), lambda x: ensemble.mean(x), lambda x: ensemble.unit(x),
             lambda x: ensemble.measure(lambda run: 1, units=x), lambda x: first.open(x)]
    of_variant = [lambda x: ensemble.measure(len, x), lambda x: ensemble.scenario(x), lambda x: ensemble.done(x), lambda x: ensemble.numbers("theta_c", x)]
    for value in NOTHING:
        names_one = value is None or isinstance(value, str) and value == ""
        for call in calls if names_one else calls + of_variant:
            with pytest.raises(talus.Error):
                call(value)
    for value in (1, "x", None):
        with pytest.raises(talus.Error, match="expected a function of a run"):
            ensemble.measure(value)
    with pytest.raises(talus.Error, match="arrays of several shapes"):
        ensemble.measure(lambda run: np.zeros(run.seed))
    again = pickle.loads(pickle.dumps(ensemble))
    assert again.folder.is_absolute() and again.done()[0].path.is_absolute(), "it may be opened from another folder"
    np.testing.assert_array_equal(again.numbers("gamma_c"), ensemble.numbers("gamma_c"))


def tilt_and_pair(frame):
    return frame.index, frame.tilt, frame.contacts.pair.sum(), frame.run.units, len(frame.run.frames)


@pytest.mark.chosen
@pytest.mark.parametrize("path", [KEPT, ROOT / "tests/runs/schema_4_stopped.h5.run"])
def test_runs_and_frames_can_be_pickled_and_copied(path, monkeypatch):
    monkeypatch.chdir(path.parent)
    with talus.open(path.name, units="D") as run:
        frame = run.frames[1]
        expected = tilt_and_pair(frame)
        monkeypatch.chdir("/")
        for again in (pickle.loads(pickle.dumps(frame)), copy.copy(frame), copy.deepcopy(frame),
                      pickle.loads(pickle.dumps(run)).frames[1], copy.deepcopy([run])[0].frames[1],
                      copy.copy(run).frames[1], pickle.loads(pickle.dumps(run.frames))[1]):
            assert tilt_and_pair(again) == expected
            np.testing.assert_array_equal(again.position, frame.position)
        table = pickle.loads(pickle.dumps(run.observables))
        np.testing.assert_array_equal(table["tilt"], run.observables["tilt"])
        contacts = pickle.loads(pickle.dumps(frame.contacts))
        np.testing.assert_array_equal(contacts.force, frame.contacts.force)
        two = pickle.loads(pickle.dumps([run.frames[0], run.frames[1]]))
        assert two[0].run is two[1].run, "a pickle opens a run only once"


def test_other_processes_get_runs_and_frames(kept):
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        assert list(pool.map(tilt_and_pair, kept.frames)) == [tilt_and_pair(frame) for frame in kept.frames]


@pytest.mark.chosen
def test_a_run_that_has_changed_is_not_taken_for_the_one_that_was_pickled(tmp_path):
    path = Path(shutil.copy(KEPT, tmp_path / "run.h5"))
    with talus.open(path) as run:
        packed = pickle.dumps(run.frames[1])
    shutil.copy(KEPT, path)
    assert pickle.loads(packed).index == 1, "another copy of the same bytes"
    os.utime(path, ns=(1, 1))
    sealed(path, lambda file: file["particles/grains/mass"].write_direct(np.ones(30)))
    with pytest.raises(talus.Error, match="has changed since the run was opened; open it again"):
        pickle.loads(packed)
    path.unlink()
    with pytest.raises(talus.Error, match="no such run"):
        pickle.loads(packed)


def test_a_folder_that_has_gone_on_is_told(tmp_path):
    folder = shutil.copytree(ROOT / "tests/runs/schema_4_stopped.h5.run", tmp_path / "run.h5.run")
    with talus.open(folder) as run:
        packed = pickle.dumps(run)
    run_talus("run", "--resume", tmp_path / "run.h5")
    with pytest.raises(talus.Error, match="no such run|has changed since"):
        pickle.loads(packed)
