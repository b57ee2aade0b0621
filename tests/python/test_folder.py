"""Runs in progress: a folder of segments that is read while it grows, and messages if it disappears."""

import fcntl
import shutil
import subprocess

import numpy as np
import pytest
from conftest import PROGRAM, ROOT, json_of, run_talus
from resealed import change_manifest

import talus


def test_frames_of_a_stopped_run_are_those_of_the_run_that_is_resumed(stopped, tmp_path):
    copy = tmp_path / "resumed.h5"
    shutil.copytree(f"{stopped}.run", f"{copy}.run")
    run_talus("run", "--resume", copy)
    with talus.open(stopped) as part, talus.open(copy) as whole:
        assert not part.complete and whole.complete and 3 < len(part.frames) < len(whole.frames)
        assert json_of("info", stopped)["frames"] == len(part.frames)
        assert np.isnan(part.theta_c)
        for mine, same in zip(part.frames, whole.frames):
            assert mine.tilt == same.tilt
            np.testing.assert_array_equal(mine.position, same.position)
            np.testing.assert_array_equal(mine.contacts.force, same.contacts.force)
        offset = part["contacts/offset"]
        np.testing.assert_array_equal(offset, whole["contacts/offset"][: len(offset)])
        np.testing.assert_array_equal(part["contacts/pair"], whole["contacts/pair"][: offset[-1]])
        for table in ("observables", "steps"):
            for name, values in getattr(part, table).items():
                np.testing.assert_array_equal(values, getattr(whole, table)[name][: len(values)], err_msg=name)
        assert part.scenario == whole.scenario and list(part.observables) == list(whole.observables)
        assert part.observables.unit("sigma_n") == "Pa" and part.observables.meaning("sigma_n") == ""


def test_run_without_a_segment_has_no_frames(tmp_path):
    folder = tmp_path / "begun.h5.run"
    shutil.copytree(ROOT / "tests/runs/schema_4_stopped.h5.run", folder)
    change_manifest(folder, r"^segment .*\n", "")
    with talus.open(folder) as run:
        assert len(run.frames) == run.frames_of_tilt == len(run.observables) == 0 and len(run.id) == 30
        with pytest.raises(talus.Error, match="has no frame yet"):
            run.frame_at(0)


def test_folder_and_file_are_found_under_either_name(stopped):
    kept = ROOT / "tests/runs/schema_4_stopped.h5"
    for path in (kept, f"{kept}.run", f"{kept}.run/"):
        with talus.open(path) as run:
            assert run["checkpoint/step"] == run.steps["step"][-1] == 548 and len(run.frames) == 2


def test_analysis_of_a_stopped_run_is_not_there_yet(stopped):
    with talus.open(stopped) as run, pytest.raises(talus.Error, match="an analysis is stored only once the run is complete"):
        run.analysis


def test_run_is_read_while_it_is_computed_and_packed(folder):
    path = folder / "growing.h5"
    # Each frame is committed; the reader needs time between two of them.
    slower = ("--set", "bed.length=30", "--set", "tilt.step=0.0005", "--set", "output.frame_every=2")
    process = subprocess.Popen([PROGRAM, "run", folder / "bed.toml", *slower, "-o", path], stderr=subprocess.DEVNULL)
    frames = []
    while process.poll() is None:
        try:
            with talus.open(path) as run:
                frames.append(len(run.frames))
                assert not frames[-1] or run.frames[-1].gamma.shape == run.id.shape
        except talus.Error as error:
            waiting = ("no such run", "nothing is committed there yet")
            assert any(text in str(error) for text in (*waiting, "no longer exists")), error
    assert process.returncode == 0
    with talus.open(path) as run:
        frames.append(len(run.frames))
    assert frames == sorted(frames) and len(set(frames)) > 3, frames


def test_run_that_replaces_another_is_read_before_it_is_packed(analysed, stopped, tmp_path):
    """If the manifest says so, the run is the folder, not the old file next to it."""
    path = tmp_path / "again.h5"
    shutil.copy(analysed, path)
    shutil.copytree(f"{stopped}.run", f"{path}.run")
    assert talus.open(path).complete
    change_manifest(tmp_path / "again.h5.run", r"^header", "replaces the packed file\nheader")
    assert not talus.open(path).complete


def test_run_that_is_packed_while_it_is_opened_is_found(stopped, analysed, tmp_path, monkeypatch):
    path = tmp_path / "packing.h5"
    shutil.copytree(f"{stopped}.run", f"{path}.run")
    read = talus.run.Storage

    def pack_and_read(place, manifest):
        if place.is_dir():
            shutil.copy(analysed, path)
            shutil.rmtree(place)
        return read(place, manifest)

    monkeypatch.setattr(talus.run, "Storage", pack_and_read)
    assert talus.open(path).complete


def test_run_that_is_packed_meanwhile_says_so(stopped, tmp_path):
    copy = tmp_path / "packed.h5"
    shutil.copytree(f"{stopped}.run", f"{copy}.run")
    with talus.open(copy) as run:
        run_talus("run", "--resume", copy)
        with pytest.raises(talus.Error, match="was completed since it was opened; open it again"):
            run.frames[2].position


def test_run_that_is_open_here_can_be_analysed_and_read_on(copied):
    with talus.open(copied) as run:
        before = run.frames[4].gamma
        run_talus("analyze", copied, "--set", "l_min=0")
        np.testing.assert_array_equal(run.frames[4].gamma, before)
        assert run.analysis["parameters/l_min"] == "3", "the file as it was when it was opened"
    with talus.open(copied) as run:
        assert run.analysis["parameters/l_min"] == "0"


@pytest.mark.parametrize("wish", [None, "FALSE", "TRUE", "BEST_EFFORT"])
def test_file_is_read_whatever_its_lock(copied, monkeypatch, wish):
    if wish is not None:
        monkeypatch.setenv("HDF5_USE_FILE_LOCKING", wish)
    frames = json_of("info", copied)["frames"]
    with copied.open() as writer:
        fcntl.flock(writer, fcntl.LOCK_EX)
        with talus.open(copied) as run:
            assert len(run.frames) == frames
            assert run.frames[1].gamma.shape == run.frames[0].gamma.shape
