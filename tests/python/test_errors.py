"""Foreign, outdated and damaged files are reported with their name and a remedy."""

import sys

import h5py
import pytest
from conftest import run_talus
from resealed import seal, sealed

import talus


@pytest.mark.chosen
@pytest.mark.parametrize("path, text", [
    ("nothing.h5", "no such run; expected a run file, or a folder .*nothing.h5.run"),
    ("bed.toml", "is not a Talus run file"),
    ("plain.h5", "is not a Talus run file"),
    ("empty.h5", "nothing is committed there yet"),
    ("empty.h5.run", "nothing is committed there yet"),
])
def test_what_is_no_run(folder, path, text):
    h5py.File(folder / "plain.h5", "w").close()
    (folder / "empty.h5.run").mkdir(exist_ok=True)
    with pytest.raises(talus.Error, match=text) as error:
        talus.open(folder / path)
    assert str(error.value).startswith(str(folder / path))


def test_problem_file_is_no_run(analysed, tmp_path):
    run_talus("dump", analysed, "--at", "5", "-o", tmp_path / "problem.h5")
    with pytest.raises(talus.Error, match="is not a Talus run file"):
        talus.open(tmp_path / "problem.h5")


def test_another_schema_is_named_beside_the_one_that_is_read(copied):
    def change(file):
        file["parameters/schema_version"][()] = 3

    with pytest.raises(talus.Error, match="has schema version 3, this package reads version 4"):
        talus.open(sealed(copied, change))


def test_another_version_of_the_analysis(copied):
    def change(file):
        file["analysis/version"][()] = 2

    with talus.open(sealed(copied, change)) as run, pytest.raises(talus.Error, match="version 2, .* reads version 8"):
        run.analysis


def test_run_without_an_analysis_says_how_to_make_it(walls):
    with talus.open(walls) as run, pytest.raises(talus.Error, match=f"holds no analysis; create it with: talus analyze {walls}"):
        run.analysis


def test_truncated_file(copied):
    with copied.open("r+b") as file:
        file.truncate(copied.stat().st_size // 2)
    with pytest.raises(talus.Error, match="is damaged: it has .* bytes, but .* talus repair"):
        talus.open(copied)


def test_changed_bytes_of_a_frame_are_noticed(copied):
    with h5py.File(copied) as file:
        _, chunk = file["particles/grains/position/value"].id.read_direct_chunk((4, 0, 0))
    whole = copied.read_bytes()
    assert whole.count(chunk) == 1
    copied.write_bytes(whole.replace(chunk, chunk[:100] + bytes(20) + chunk[120:]))
    with pytest.raises(talus.Error, match="copied.h5: is damaged: .* have another hash; .* talus repair"):
        talus.open(copied)
    with talus.open(seal(copied)) as run:
        assert run.frames[3].position.shape == (len(run.id), 2)
        with pytest.raises(talus.Error, match="copied.h5: is damaged: .* talus repair"):
            run.frames[4].position


def test_missing_data_sets_are_named(copied):
    with pytest.raises(talus.Error, match="has no data set particles/grains/radius"):
        talus.open(sealed(copied, lambda file: file.__delitem__("particles/grains/radius")))


def test_names_and_units_that_do_not_exist(run, analysed):
    with pytest.raises(talus.Error, match="has no data set observables/volume"):
        run["observables/volume"]
    with pytest.raises(talus.Error, match="has no data set observables/volume"):
        run.unit("observables/volume")
    with pytest.raises(KeyError, match="no such data set in /analysis .*; did you mean 'overloaded/fraction'"):
        run.analysis["overloaded/share"]
    with pytest.raises(talus.Error, match='units=\'mm\': expected "SI"'):
        talus.open(analysed, units="mm")


@pytest.mark.parametrize("package, call", [
    ("pandas", lambda run: run.observables.to_pandas()),
    ("pandas", lambda run: run.frames[0].to_pandas()),
    ("pandas", lambda run: run.frames[0].contacts.to_pandas()),
    ("networkx", lambda run: run.frames[0].to_networkx()),
])
def test_packages_that_are_missing_are_named(run, monkeypatch, package, call):
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(ImportError, match=f"needs {package}, which is not installed: apt install python3-{package}"):
        call(run)
