"""Ensembles: members, their values and means, compared with members.csv and the output of `talus
ensemble`."""

import csv
import math
import shutil

import numpy as np
import pytest
from conftest import BED, json_of, run_talus
from resealed import ensemble_manifest, sealed_json

import talus

VARIANTS = ["contact.friction=0.2", "contact.friction=0.5"]


@pytest.fixture
def folder_of(book):
    return book / "runs/cookbook-friction"


@pytest.fixture
def ensemble(folder_of):
    return talus.open_ensemble(folder_of)


def test_members_and_means_are_those_of_talus_ensemble_status(ensemble, folder_of):
    status = json_of("ensemble", "status", folder_of)
    assert ensemble.variants == list(status["variants"]) == VARIANTS and ensemble.version == status["version"]
    names = [str(member.path.relative_to(folder_of).with_suffix("")) for member in ensemble.members]
    assert names == list(status["members"])
    for member, name in zip(ensemble.members, names):
        reported = status["members"][name]
        assert (member.stage, member.state_hash, member.seconds) == ("done", reported["state_hash"], reported["seconds"])
    for variant, means in status["variants"].items():
        for name, reported in means.items():
            mean = ensemble.mean(name, variant)
            reported = {key: np.nan if value is None else value for key, value in reported.items()}
            expected = (reported["n"], reported["mean"], reported["deviation"], reported["error"])
            assert mean == pytest.approx(expected, rel=1e-12, nan_ok=True), name
            assert not mean.count or ensemble.unit(name) == reported["unit"]


def test_numbers_are_those_of_members_csv(ensemble, folder_of):
    with (folder_of / "members.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert [(m.variant, str(m.seed)) for m in ensemble.done()] == [(row["variant"], row["seed"]) for row in rows]
    assert list(rows[0])[:6] == ["variant", "contact.friction", "seed", "state_hash", "version", "seconds"]
    assert all(row["variant"] == f"contact.friction={row['contact.friction']}" for row in rows)
    assert rows[0]["theta_c (deg)"] == f"{ensemble.numbers('theta_c', VARIANTS[0])[0]:.3f}".rstrip("0"), "steps of the tilt"
    for column in list(rows[0])[6:]:
        name, unit = column[:-1].split(" (")
        for variant in VARIANTS:
            expected = [float(row[column] or "nan") for row in rows if row["variant"] == variant]
            np.testing.assert_allclose(ensemble.numbers(name, variant), expected, rtol=5e-10, err_msg=column)
        assert ensemble.unit(name) == unit


def table_like_members_csv(ensemble):
    """Returns the table of an ensemble, compared with members.csv."""
    pandas = pytest.importorskip("pandas", reason="pandas is not installed: python3-pandas")
    expected = pandas.read_csv(ensemble.folder / "members.csv", dtype={"state_hash": str})
    found = ensemble.to_pandas()
    assert list(found.columns) == [column.split(" (")[0] for column in expected.columns]
    found.columns = expected.columns
    pandas.testing.assert_frame_equal(found, expected, check_dtype=False, rtol=5e-10)
    return found


def test_table_is_members_csv(ensemble):
    found = table_like_members_csv(ensemble)
    assert found["contact.friction"].tolist() == [float(variant.split("=")[1]) for variant in found["variant"]]


@pytest.mark.parametrize("varied, expected", [
    (["command.1.kind=push,drop", "command.1.grain=2,4"],
     {"command.1.kind": ["push", "push", "drop", "drop"], "command.1.grain": [2, 4, 2, 4]}),
    (['tilt.program=["to 1", "to 0"],["to 1"]', "contact.friction=0.5"], {"tilt.program": ["to 1, to 0", "to 1"]})])
def test_tables_have_the_keys_in_which_variants_differ(tmp_path, varied, expected):
    (tmp_path / "bed.toml").write_text("[bed]\nlength = 10\ndepth = 3\n[tilt]\nrate = 4\nstep = 0.01\nprogram = [\"to 1\"]\n"
                                       "[[command]]\nat = 0.5\nkind = \"push\"\ngrain = 3\nx = 0.01\ny = 0.01\n")
    run_talus("ensemble", "bed.toml", "--seeds", "1", *(word for each in varied for word in ("--vary", each)), "-o", "e", folder=tmp_path)
    with (tmp_path / "e/members.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0])[:len(expected) + 2] == ["variant", *expected, "seed"]
    assert {key: [row[key] for row in rows] for key in expected} == {key: [str(each) for each in expected[key]] for key in expected}
    found = table_like_members_csv(talus.open_ensemble(tmp_path / "e"))
    assert {key: found[key].tolist() for key in expected} == expected


def test_own_measures_are_taken_of_each_run(ensemble):
    measured = ensemble.measure(lambda run: run.theta_c, VARIANTS[0], units="D")
    np.testing.assert_allclose(measured, ensemble.numbers("theta_c", VARIANTS[0]), rtol=1e-14)
    assert ensemble.measure(lambda run: run.analysis["threshold"], VARIANTS[1]).shape == (4, 2)
    with ensemble.members[0].open() as run:
        assert run.seed == 1 and run.friction == 0.2


def test_scenarios_are_those_of_the_variants(ensemble):
    assert [ensemble.scenario(variant)["contact"]["friction"] for variant in VARIANTS] == [0.2, 0.5]


def test_means_leave_out_what_is_no_number():
    assert talus.mean_of([1.0, math.nan, 3.0]) == pytest.approx((2, 2.0, 2**0.5, 1.0))
    assert talus.mean_of([5.0]) == pytest.approx((1, 5.0, math.nan, math.nan), nan_ok=True)
    assert talus.mean_of([]) == pytest.approx((0, math.nan, math.nan, math.nan), nan_ok=True)


def test_stages_of_members_that_are_not_done(folder_of, tmp_path):
    copy = tmp_path / "copy"
    shutil.copytree(folder_of, copy)
    variant = copy / VARIANTS[0]
    for seed in (1, 2, 3):
        (variant / f"seed-{seed}.h5").unlink()
    (variant / "seed-1.failed").write_text("exit code 65\nit failed\n")
    (variant / "seed-2.claim-0").touch()
    status = json_of("ensemble", "status", copy)
    ensemble = talus.open_ensemble(copy)
    stages = [member.stage for member in ensemble.members]
    assert stages == [reported["stage"] for reported in status["members"].values()]
    assert stages[::2] == ["failed", "claimed", "waiting", "done"] and stages[1::2] == ["done"] * 4
    assert ensemble.mean("theta_c", VARIANTS[0]).count == 1 and len(ensemble.done()) == 5


@pytest.mark.chosen
def test_ensemble_of_one_variant_needs_no_name(folder, tmp_path):
    run_talus("ensemble", folder / "bed.toml", "--seeds", "3,7-8", "--until", "theta_c:50",
              "--set", "tilt.end_angle=1", "-o", tmp_path / "one")
    ensemble = talus.open_ensemble(tmp_path / "one")
    assert (ensemble.seeds, ensemble.variants, ensemble.until) == ([3, 7, 8], [""], "theta_c:50")
    assert ensemble.scenario()["tilt"]["end_angle"] == 1 and len(ensemble.numbers("gamma_c")) == 3


def test_errors_name_what_there_is(ensemble, folder_of, tmp_path):
    with pytest.raises(talus.Error, match=f"name a variant; it has {VARIANTS[0]}, {VARIANTS[1]}"):
        ensemble.mean("theta_c")
    with pytest.raises(talus.Error, match="has no variant 'contact.friction=0.4'"):
        ensemble.mean("theta_c", "contact.friction=0.4")
    with pytest.raises(talus.Error, match="no number theta_k; did you mean 'theta_.' or 'theta_c"):
        ensemble.mean("theta_k", VARIANTS[0])
    with pytest.raises(talus.Error, match="no ensemble here; start one with"):
        talus.open_ensemble(tmp_path)
    with pytest.raises(talus.Error, match="open it with talus.open_ensemble"):
        talus.open(folder_of)


@pytest.mark.parametrize("text", ["", "{}\n", "[" * 100000, ensemble_manifest()[:-3], ensemble_manifest().replace("1", "2", 1),
                                  sealed_json("[" * 100000), sealed_json('{"seeds": ' + "1" * 5000), sealed_json('{"seeds": "1", "seeds": "2"'),
                                  sealed_json('{"seeds": NaN'), sealed_json("{,")])
def test_damaged_manifests(tmp_path, text):
    (tmp_path / "ensemble.manifest").write_text(text)
    with pytest.raises(talus.Error, match="ensemble.manifest: was not written by talus"):
        talus.open_ensemble(tmp_path)


def test_manifests_of_an_earlier_revision_are_named(tmp_path):
    (tmp_path / "ensemble.manifest").write_text("talus ensemble 1\nseeds 1-3\n")
    with pytest.raises(talus.Error, match="ensemble.manifest was written by an earlier revision of Talus; start another"):
        talus.open_ensemble(tmp_path)


@pytest.mark.parametrize("name", ["..", "../victim", "a/../../victim", "/tmp/victim", ".", "a//b", "a/", "a\x1b[2J",
                                  "a\tb", "a\rb", "a\nb", "scenario", "", "x" * 256, "é" * 128, "a/b", 1, None, ["a"]])
def test_names_of_a_manifest_stay_in_its_folder(tmp_path, name):
    (tmp_path / "ensemble.manifest").write_text(ensemble_manifest([{}, {"name": name}]))
    with pytest.raises(talus.Error, match=r"ensemble.manifest: was not written by talus, at /variants/1/name: expected"):
        talus.open_ensemble(tmp_path)


@pytest.mark.parametrize("member", [
    {"format": "talus ensemble 3"}, {"version": 1}, *({"seeds": seeds} for seeds in (
        "1-1000000000000", "5-1", "1-9000,10000-19000", str(2**63), "1" * 5000, "-1", "1-", "+1", "1_0", " 1", 1, [1], {})),
    *({"keep": keep} for keep in ("-5", "some", "1.5", "+1", f"{2**64}", "1" * 5000, 10, True)),
    *({"until": until} for until in ("foo", "theta_c:", "theta_c:x", ":1", "theta_c:0", "theta_c:-1", "theta_c:nan", "theta_c:1_0",
                                     "theta_c[x]:1", 0.2))])
def test_members_that_talus_does_not_write_are_refused(tmp_path, member):
    (tmp_path / "ensemble.manifest").write_text(ensemble_manifest(**member))
    with pytest.raises(talus.Error, match=f"ensemble.manifest: was not written by talus, at /{next(iter(member))}: expected"):
        talus.open_ensemble(tmp_path)


@pytest.mark.parametrize("member", [{"keep": keep} for keep in ("all", "analysis", "0", f"{1:030}")] + [
    {"until": until} for until in ("theta_c:0.2", "lc/max@theta_d[1]:0.5", "theta_c:1e-3", "theta_d/dilation_low:.5", "threshold[1]:2",
                                   "theta_c:inf")])
def test_members_that_talus_writes_are_taken(tmp_path, member):
    (tmp_path / "ensemble.manifest").write_text(ensemble_manifest([{"name": "x" * 255}, {"name": "é" * 127}], **member))
    ensemble = talus.open_ensemble(tmp_path)
    assert next(iter(member.values())) in (ensemble.keep, ensemble.until)
    assert ensemble.variants == ["x" * 255, "é" * 127]


def test_runs_of_other_members_are_refused(folder_of, tmp_path):
    copy = tmp_path / "copy"
    shutil.copytree(folder_of, copy)
    here, there = copy / VARIANTS[0], copy / VARIANTS[1]
    for other, fact in ((there / "seed-1.h5", "contact.friction"), (here / "seed-2.h5", "seed 2")):
        shutil.copy(other, here / "seed-1.h5")
        with pytest.raises(talus.Error, match=rf"seed-1.h5: is a run of another member \(.*{fact}"):
            talus.open_ensemble(copy)


def test_names_that_were_shortened_are_told_in_full(tmp_path):
    (tmp_path / "bed.toml").write_text("[bed]\nlength = 20\ndepth = 1\nfloor = \"smooth\"\n[tilt]\nend_angle = 0.01\n")
    (tmp_path / "a, b.csv").write_text("x,y,radius\n10.55,0.5,0.5\n9.45,0.5,0.5\n10,1.3351646544245033,0.5\n")
    run_talus("ensemble", "bed.toml", "--seeds", "1-2", "--set", "deposition.method=file", "--vary",
              'deposition.file="a, b.csv"', "-o", "e", folder=tmp_path)
    ensemble = talus.open_ensemble(tmp_path / "e")
    [name] = ensemble.variants
    assert name.startswith("deposition.file=a, b.csv~")
    assert ensemble.full_names == {name: f"deposition.file={tmp_path}/a, b.csv"}
    assert len({member.state_hash for member in ensemble.done()}) == 1, "a bed from a file has nothing random"


def test_damaged_members(folder_of, tmp_path):
    copy = tmp_path / "copy"
    shutil.copytree(folder_of, copy)
    file = copy / VARIANTS[1] / "seed-2.h5"
    file.write_bytes(file.read_bytes()[:-1])
    with pytest.raises(talus.Error, match="seed-2.h5: is damaged"):
        talus.open_ensemble(copy)


def test_members_without_frames_have_their_numbers(tmp_path):
    (tmp_path / "bed.toml").write_text(BED)
    run_talus("ensemble", "bed.toml", "--seeds", "1-2", "--keep", "1", "-o", "e", folder=tmp_path)
    kept = talus.open_ensemble(tmp_path / "e")
    assert kept.keep == "1" and len(kept.done()) == 2
    with kept.done()[0].open() as run:
        assert run.has_frames and len(run.frames[0].position)
    with kept.done()[1].open() as run:
        assert not run.has_frames and len(run.tilt) > 1 and len(run.analysis["packing/volume"]) and len(run.steps["step"])
        for read in (lambda: run.frames[0].position, lambda: run.frame_at(0).contacts):
            with pytest.raises(talus.Error, match="seed-2.h5: has no frames: it was kept for its analysis alone"):
                read()
    assert kept.mean("theta_c").count == 2
