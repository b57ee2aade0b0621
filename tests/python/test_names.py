"""Files may have any name: no command shows its raw bytes on a terminal, and all output is UTF-8."""

import json
import os
import resource
import shutil
import subprocess

import pytest

import talus
from conftest import PROGRAM

h5py = pytest.importorskip("h5py")

#: An escape sequence, a carriage return, a Latin-1 byte, and a right-to-left mark.
NAME = b"b\x1b[31m\r\xf6\xe2\x80\xae"


def call(*words, folder, code=0, **options):
    """Returns the output of a command on both streams, which must not contain control sequences."""
    done = subprocess.run([PROGRAM, *words], cwd=folder, capture_output=True, **options)
    said = done.stdout + done.stderr
    assert done.returncode == code, said
    text = said.decode("utf-8")
    assert not [c for c in text if (ord(c) < 32 and c != "\n") or c in "\x7f\x9b\u202e"], said
    return done.stdout.decode("utf-8")


@pytest.fixture(scope="module")
def place(tmp_path_factory, analysed):
    """Creates a folder with a run and its scenario under names that are not valid text."""
    folder = tmp_path_factory.mktemp("names")
    shutil.copy(analysed, os.fsencode(folder) + b"/" + NAME + b".h5")
    shutil.copy(analysed.parent / "bed.toml", os.fsencode(folder) + b"/" + NAME + b".toml")
    return folder


RUN, SCENARIO = NAME + b".h5", NAME + b".toml"


@pytest.mark.parametrize("words, code", [
    (["check", RUN], 0), (["check", SCENARIO], 0), (["check", RUN, "--json"], 0), (["check", SCENARIO, "--json"], 0),
    (["info", RUN], 0), (["info", RUN, "--json"], 0), (["analyze", RUN], 0), (["analyze", RUN, "--json"], 0),
    (["events", RUN], 0), (["events", RUN, "--json"], 0), (["repair", RUN, "-o", NAME + b"-2.h5"], 0),
    (["run", "--resume", RUN], 0), (["run", SCENARIO, "-o", RUN], 73), (["run", SCENARIO, "--set", NAME + b"=3"], 65),
    (["run", SCENARIO, "--set", b"deposition.file=" + NAME], 65), (["render", RUN, "--map", NAME], 64),
    (["render", RUN, "--map", "gamma", "--at", "0", "-o", NAME], 0), (["render", RUN, "--at", NAME], 64),
    (["panel", RUN, "--map", "gamma", "--at", "0", "-o", NAME + b".png"], 0),
    (["export", RUN, "--to", "xyz", "--at", "frame0", "-o", NAME + b".xyz"], 0),
    (["export", RUN, "--to", "html", "-o", NAME + b".html"], 0), (["dump", RUN, "--at", "0", "-o", NAME + b".fclib"], 0),
    (["solve", NAME + b".none"], 66), (["ensemble", SCENARIO, "--seeds", "1", "--jobs", "0", "-o", NAME + b"-e"], 0),
    (["figures", RUN, RUN + b"#" + NAME, "--only", NAME, "-o", "f"], 64), ([NAME], 64), (["info", b"no" + NAME], 66),
])
def test_no_command_shows_what_a_terminal_obeys(place, words, code):
    done = call(*words, folder=place, code=code)
    if "--json" in words:
        json.loads(done)


def test_text_of_files_is_utf8(place, tmp_path):
    name = os.fsencode(tmp_path) + b"/" + NAME
    shutil.copy(os.fsencode(place) + b"/" + SCENARIO, name + b".toml")
    call("run", NAME + b".toml", "--set", "tilt.end_angle=0.1", "-o", NAME + b".h5",
         folder=tmp_path)
    call("analyze", NAME + b".h5", folder=tmp_path)
    shutil.copy(name + b".h5", tmp_path / "plain.h5")
    with h5py.File(tmp_path / "plain.h5") as file:
        texts = []
        file.visititems(lambda _, item: texts.append(item.asstr()[()]) if isinstance(item, h5py.Dataset)
                        and h5py.check_string_dtype(item.dtype) and item.shape == () else None)
        assert len(texts) > 20
        # Quoted for bash.
        assert r"$'b\x1b[31m\x0d\xf6\xe2\x80\xae.h5'" in file["provenance/command"].asstr()[()]
    with talus.open(tmp_path / "plain.h5") as run:
        assert run.frames


def test_exports_and_tables_are_utf8(place, tmp_path):
    for words in (["export", RUN, "--to", "html", "-o", tmp_path / "page.html"],
                  ["export", RUN, "--to", "paraview", "--at", "frame0", "-o", tmp_path / "vtk"],
                  ["export", RUN, "--to", "csv", "--at", "frame0", "-o", tmp_path / "csv"],
                  ["export", RUN, "--to", "xyz", "--at", "frame0", "-o", tmp_path / "bed.xyz"],
                  ["ensemble", SCENARIO, "--seeds", "1", "--jobs", "0", "-o", tmp_path / "ensemble"]):
        call(*words, folder=place)
    texts = [path for path in tmp_path.rglob("*") if path.is_file() and path.suffix not in (".h5", ".lock")]
    assert len(texts) > 6
    for path in texts:
        path.read_bytes().decode("utf-8")


OUTPUTS = [["render", "analysed.h5", "--map", "gamma", "--at", "0"], ["panel", "analysed.h5", "--map", "gamma", "--at", "0"],
           ["export", "analysed.h5", "--to", "xyz", "--at", "frame0"], ["export", "analysed.h5", "--to", "csv", "--at", "frame0"],
           ["repair", "analysed.h5"], ["replay", "analysed.h5"], ["run", "bed.toml"], ["dump", "analysed.h5", "--at", "0"],
           ["figures", "analysed.h5", "--only", "fig04"], ["animate", "analysed.h5", "--map", "gamma"],
           ["ensemble", "bed.toml", "--seeds", "1", "--jobs", "0"]]

#: Extensions of output files, for commands that require one.
ENDINGS = {"panel": ".png", "animate": ".mp4", "xyz": ".xyz", "repair": ".h5", "replay": ".h5", "run": ".h5", "dump": ".h5"}


@pytest.mark.parametrize("words", OUTPUTS, ids=lambda words: " ".join(words[:1] + words[2:4]))
def test_output_that_cannot_be_named_is_refused(analysed, tmp_path, words):
    folder = tmp_path / "work"
    folder.mkdir()
    shutil.copy(analysed, folder / "analysed.h5")
    shutil.copy(analysed.parent / "bed.toml", folder / "bed.toml")
    ending = next((ENDINGS[word] for word in words if word in ENDINGS), "")
    os.symlink("loop" + ending, folder / ("loop" + ending))
    for output in ("loop", "loop" + ending + "/x", "x" * 300, "y" * 300 + "/x", "/".join(["z" * 250] * 20)):
        output += ending
        done = subprocess.run([PROGRAM, *words, "-o", output], cwd=folder, capture_output=True, text=True)
        # An intact run has nothing to repair.
        assert done.returncode == 73 or (words[0] == "repair" and done.returncode == 0), (output, done.stderr)
        assert "filesystem" not in done.stderr


@pytest.mark.parametrize("words", [["info"], ["check"], ["analyze"], ["events"], ["run"], ["render", "--map", "gamma"],
                                   ["panel", "-o", "p.png"], ["replay"], ["repair", "-o", "r.h5"], ["figures"], ["solve"], ["ensemble"],
                                   ["export", "--to", "xyz"], ["view"], ["dump", "--at", "0"]], ids=lambda words: words[0])
def test_input_that_cannot_be_named_is_missing(tmp_path, words):
    os.symlink("loop.h5", tmp_path / "loop.h5")
    os.symlink("loop.toml", tmp_path / "loop.toml")
    for name in ("loop.h5", "loop.toml", "x" * 300 + ".h5", "x" * 300 + ".toml", "loop.h5/a.h5"):
        done = subprocess.run([PROGRAM, words[0], name, *words[1:]], cwd=tmp_path, capture_output=True, text=True)
        assert done.returncode in (64, 65, 66, 69), (name, done.returncode, done.stderr)
        assert "filesystem" not in done.stderr


@pytest.mark.parametrize("count", range(4, 12))
def test_too_few_files_have_a_message(analysed, tmp_path, count):
    for words in (["run", analysed.parent / "bed.toml", "-o", "r.h5", "--set", "tilt.end_angle=0.01"], ["info", analysed],
                  ["analyze", analysed], ["render", analysed, "--map", "gamma", "--at", "0", "-o", "maps"]):
        done = subprocess.run([PROGRAM, *map(str, words)], cwd=tmp_path, capture_output=True, text=True,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (count, count)))
        assert done.returncode in (0, 65, 66, 69, 71, 73, 74), (words[0], done.returncode, done.stderr)
        assert "filesystem" not in done.stderr
        shutil.rmtree(tmp_path / "r.h5.run", ignore_errors=True)
        (tmp_path / "r.h5").unlink(missing_ok=True)
