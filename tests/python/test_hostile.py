"""Maliciously changed runs: nothing outside the file is read, nothing that the program would reject is
accepted, and every failure is a talus.Error. TALUS_TRIES=2000 sets the number of random tries (.ci/full
hostile)."""

import contextlib
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tracemalloc

import h5py
import numpy as np
import pytest
import xxhash
from conftest import PROGRAM, PROGRAM_ENVIRONMENT, ROOT
from resealed import change_manifest, ensemble_manifest, reseal_folder, seal, sealed, sealed_json

import talus
from talus import trial_walk

KEPT = ROOT / "tests/runs/schema_4.h5"
HUGE = 1 << 40
SECRET = 54321.0


@pytest.fixture
def packed(tmp_path):
    return shutil.copy(KEPT, tmp_path / "run.h5")


@pytest.fixture
def folder_of_run(tmp_path):
    return shutil.copytree(ROOT / "tests/runs/schema_4_stopped.h5.run", tmp_path / "run.h5.run")


@pytest.fixture
def secret(tmp_path):
    """Creates a file that no run may reveal: numbers, as bytes and as a data set of each name that is
    tried."""
    path = tmp_path / "secret.h5"
    with h5py.File(path, "w") as file:
        for name in ("particles/grains/mass", "observables/sigma_n"):
            with h5py.File(KEPT) as kept:
                file[name] = np.full(kept[name].shape, SECRET)
    (tmp_path / "secret.bin").write_bytes(np.full(10000, SECRET).tobytes())
    return path


def use(run):
    """Accesses everything in a run."""
    for name in (*talus.checked_file.DATA_SETS, "help/frames/tilt"):
        with contextlib.suppress(talus.Error):
            run[name]
    for name in ("frames/tilt", "contacts/pair", "analysis/gamma_c"):
        with contextlib.suppress(talus.Error):
            run.unit(name), run.meaning(name)
    run.scenario, run.provenance, run.seed, run.theta_c, run.frames_of_tilt, repr(run)
    for frame in run.frames:
        for values in (frame.position, frame.unwrapped, frame.velocity, frame.angle, frame.angular_velocity):
            assert np.isfinite(values).all() and len(values) == len(run.id)
        frame.internal_moment, frame.gamma, repr(frame)
        contacts = frame.contacts
        assert contacts.start.shape == contacts.end.shape == contacts.branch.shape
        contacts.lines(), contacts.force_on_b
    for table in (run.observables, run.steps):
        assert len({len(values) for values in table.values()}) == 1
    with contextlib.suppress(talus.Error):
        dict(run.analysis)


def replaced(name, **how):
    """Replaces a data set."""
    def change(file):
        shape, kind = file[name].shape, file[name].dtype
        del file[name]
        file.create_dataset(name, **({"shape": shape, "dtype": kind} | how))
    return change


def external(name, path):
    return replaced(name, external=[(str(path), 0, h5py.h5f.UNLIMITED)])


def virtual(name, path):
    def change(file):
        shape, kind = file[name].shape, file[name].dtype
        del file[name]
        layout = h5py.VirtualLayout(shape, kind)
        layout[:] = h5py.VirtualSource(str(path), name, shape)
        file.create_virtual_dataset(name, layout)
    return change


def without(path, name):
    with h5py.File(path, "r+") as file:
        del file[name]


def linked(name, link):
    def change(file):
        del file[name]
        file[name] = link
    return change


def with_values(name, change_values):
    def change(file):
        values = file[name][()]
        change_values(values)
        file[name][...] = values
    return change


@pytest.mark.chosen
@pytest.mark.parametrize("name", ["particles/grains/mass", "observables/sigma_n"])
def test_nothing_outside_of_the_file_is_read(packed, secret, tmp_path, name):
    os.mkfifo(tmp_path / "pipe")
    for change, text in [(external(name, tmp_path / "secret.bin"), "has its values in another file"),
                         (external(name, tmp_path / "pipe"), "has its values in another file"),
                         (virtual(name, secret), "has its values in another file"),
                         (linked(name, h5py.ExternalLink(str(secret), "/" + name)), "is a link to another place"),
                         (linked(name.rpartition("/")[0], h5py.ExternalLink(str(secret), name.rpartition("/")[0])),
                          "is a link to another place"),
                         (linked(name, h5py.SoftLink("/frames/time")), "is a link to another place")]:
        shutil.copy(KEPT, packed)
        with pytest.raises(talus.Error, match=text), talus.open(sealed(packed, change)) as run:
            assert not np.any(run[name] == SECRET)
            dict(run.observables)


@pytest.mark.chosen
@pytest.mark.parametrize("change, text", [
    (replaced("particles/grains/mass", shape=(HUGE,), chunks=(1024,)), "has shape .*, expected"),
    (replaced("analysis/threshold", shape=(HUGE,), chunks=(1024,), dtype="<f8"), "larger than the file can hold"),
    (replaced("contacts/pair", shape=(HUGE, 2), chunks=(1, 2)), "larger than the file can hold"),
    (replaced("parameters/scenario_resolved", dtype=h5py.string_dtype()), "is not of the type text"),
    (replaced("frames/tilt", dtype=[("x", "f8")]), "is not of the type float64"),
    (lambda file: file.move("observables", "observed"), "observables/step is missing"),
    (lambda file: file.__delitem__("steps/phase"), "steps/phase is missing"),
    (with_values("contacts/offset", lambda v: np.put(v, 2, v[4])), "does not ascend"),
    (with_values("contacts/offset", lambda v: np.put(v, 5, 10**9)), "does not ascend within"),
    (with_values("contacts/offset", lambda v: np.put(v, 1, -5)), "does not ascend"),
    (with_values("contacts/pair", lambda v: np.put(v, 1, 10**6)), "joins bodies other"),
    (with_values("contacts/pair", lambda v: np.put(v, 0, -1)), "joins bodies other"),
    (with_values("contacts/status", lambda v: np.put(v, 0, 7)), "other than 0, 1 and 2"),
    (with_values("particles/grains/position/value", lambda v: np.put(v, 0, np.nan)), "not a finite number"),
    (with_values("particles/grains/position/value", lambda v: np.put(v, 0, 1e30)), "farther away"),
    (with_values("particles/grains/radius", lambda v: np.put(v, 0, -1)), "holds values other than numbers from"),
    (with_values("particles/grains/species", lambda v: np.put(v, 0, 1)), "has no free grain, or one after"),
    (with_values("frames/tilt", lambda v: np.put(v, 0, np.inf)), "not a finite number"),
])
def test_what_the_program_refuses_is_refused(packed, change, text):
    def make(file):
        if "analysis/threshold" not in file:
            file["analysis/threshold"] = np.zeros(2)
        change(file)

    with pytest.raises(talus.Error, match=text), talus.open(sealed(packed, make)) as run:
        run["analysis/threshold"]
        use(run)


@pytest.mark.chosen
def test_values_are_no_more_bytes_than_the_file_can_hold(packed):
    """Unwritten values take as much memory as stored ones: their bytes count, and one array of them is
    made."""
    most = 1032 * os.path.getsize(packed) // 8
    for count, refused in ((most + (1 << 21), True), (1 << 20, False)):
        shutil.copy(KEPT, packed)
        sealed(packed, lambda file: file.create_dataset("analysis/threshold", (count,), "<f8", chunks=(1024,)))
        with talus.open(packed) as run:
            tracemalloc.start()
            with pytest.raises(talus.Error, match="larger than the file can hold") if refused else contextlib.nullcontext():
                assert len(run["analysis/threshold"]) == count
            peak = tracemalloc.get_traced_memory()[1]
            tracemalloc.stop()
        assert peak < (1 << 20 if refused else 9 * count)


@pytest.mark.chosen
@pytest.mark.parametrize("name", ["../other.h5", "/etc/passwd.h5", "segment_000002.h5", "sub/x.h5"])
def test_a_manifest_names_files_of_its_folder_once(folder_of_run, name):
    shutil.copy(folder_of_run / "segment_000003.h5", folder_of_run.parent / "other.h5")
    change_manifest(folder_of_run, r"^segment segment_000003.h5", f"segment {name}")
    with pytest.raises(talus.Error, match="manifest: is damaged .*does not belong to a run folder"):
        talus.open(folder_of_run)


@pytest.mark.chosen
@pytest.mark.parametrize("change, text", [
    (lambda f: (f / "segment_000003.h5").write_bytes(bytes(27259)), "segment_000003.h5: is damaged: its hash is"),
    (lambda f: change_manifest(f, r"(segment_000003.h5 \w+ \w+) \d+", r"\1 99999999999999"), "has shape .* T = 9999"),
    (lambda f: change_manifest(f, r"(segment_000003.h5) \w+", r"\1 -1"), "has 27259 bytes, the manifest says -1"),
    (lambda f: (f / "manifest").write_text((f / "manifest").read_text().replace("segment_", "segment-", 1)),
     "manifest: is damaged"),
    (lambda f: [without(f / "segment_000003.h5", "steps/residual"), reseal_folder(f)], "steps/residual is missing"),
    (lambda f: [(f / "header.h5").unlink(), os.mkfifo(f / "header.h5")], "header.h5: is missing"),
    (lambda f: [(f / "manifest").unlink(), os.mkfifo(f / "manifest")], "nothing is committed"),
    (lambda f: change_manifest(f, r"^segment segment_000003.h5", f"segment {'x' * 300}.h5"), "x.h5: is missing, although"),
    (lambda f: os.truncate(f / "manifest", HUGE), "more than such a file can have"),
    (lambda f: (f / "header.h5").write_bytes(b"x"), "header.h5: is damaged: it has 1 bytes, the manifest says"),
    (lambda f: (f / "manifest").write_text("talus run folder 2\n"), "expected 'talus run folder 1'"),
    (lambda f: (f / "manifest").write_text(""), "manifest: begins with ''"),
])
def test_folders_are_what_their_manifest_says(folder_of_run, change, text):
    change(folder_of_run)
    with pytest.raises(talus.Error, match=text), talus.open(folder_of_run) as run:
        use(run)


def ensemble_with(folder, analysed, scenario, manifest=None, seeds=(1, 2)):
    """Creates an ensemble of two members with one state hash, whose manifest has the hash of a scenario;
    the scenario is then replaced by `scenario`. `manifest` is the declared scenario; `seeds` are those of
    finished members."""
    reported = xxhash.xxh3_64_hexdigest((scenario if manifest is None else manifest).encode())
    (folder / "scenarios").mkdir()
    (folder / "scenarios/scenario.toml").write_text(scenario)
    (folder / "ensemble.manifest").write_text(ensemble_manifest([{"scenario": reported}], seeds="1-2"))
    for seed in seeds:
        copy = shutil.copy(analysed, folder / f"seed-{seed}.h5")
        sealed(copy, lambda file: file["provenance/seed"].__setitem__((), seed))
    return folder


OF_FILE = '[deposition]\nmethod = "file"\n'


@pytest.mark.chosen
@pytest.mark.parametrize("scenario", ["x = 1\n", "deposition = 1\n", "[deposition]\nx = 1\n", OF_FILE + "# more\n"])
def test_a_scenario_of_an_ensemble_is_the_one_that_it_began_with(analysed, tmp_path, scenario):
    with pytest.raises(talus.Error, match="scenario.toml: has changed since the ensemble was started; expected"):
        talus.open_ensemble(ensemble_with(tmp_path, analysed, scenario, OF_FILE))


@pytest.mark.chosen
@pytest.mark.parametrize("scenario", ["x = 1\n", "deposition = 1\n", "[deposition]\nx = 1\n"])
def test_a_scenario_without_a_deposition_has_no_bed_of_a_file(analysed, tmp_path, scenario):
    with pytest.raises(talus.Error, match="have the same state_hash, which two seeds never have"):
        talus.open_ensemble(ensemble_with(tmp_path, analysed, scenario))


@pytest.mark.chosen
def test_a_scenario_that_was_changed_is_not_given(analysed, tmp_path):
    ensemble = talus.open_ensemble(ensemble_with(tmp_path, analysed, OF_FILE, seeds=()))
    assert ensemble.scenario() == {"deposition": {"method": "file"}}
    with (tmp_path / "scenarios/scenario.toml").open("a") as file:
        file.write("# a line\n")
    with pytest.raises(talus.Error, match="scenario.toml: has changed since the ensemble was started; expected"):
        ensemble.scenario()


@pytest.mark.chosen
def test_manifests_of_chance_are_refused_or_read(tmp_path):
    whole = ensemble_manifest([{}, {"name": "a", "full_name": "a=é", "bed": "1"}], seeds="1-3", until="theta_c:0.2", keep="10")
    body = whole[: whole.rindex('"hash"')].rstrip().rstrip(",")
    chance = np.random.default_rng(8)
    for _ in range(300):
        damaged = list(body)
        for at in chance.integers(len(damaged), size=chance.integers(1, 4)):
            damaged[at] = chr(chance.choice([34, 44, 91, 93, 123, 125, 48, 45, 92, 46, chance.integers(1, 0x24F)]))
        (tmp_path / "ensemble.manifest").write_text(sealed_json("".join(damaged)), newline="")
        try:
            talus.open_ensemble(tmp_path)
        except talus.Error as error:
            assert "ensemble.manifest" in str(error)


@pytest.mark.chosen
def test_an_ensemble_at_a_place_that_cannot_be_is_an_error(tmp_path):
    with pytest.raises(talus.Error, match="cannot be opened: .*too long"):
        talus.open_ensemble(tmp_path / ("x" * 300))


def test_names_in_a_file_write_nothing_to_the_terminal(packed):
    def change(file):
        file["provenance/\x1b[2J"] = h5py.SoftLink("/frames/tilt")

    with pytest.raises(talus.Error, match=r"provenance/\\x1b\[2J is a link"), talus.open(sealed(packed, change)) as run:
        run.provenance


NUMBERS = [np.nan, np.inf, -np.inf, 0, -1, 1, 2, 1e300, -1e9, 3e38, 1 << 31, 127, -(1 << 62), 5]


def spoil(file, chance, secret):
    """Applies one of the damages of tests/reliability/hostile_file.h to a random data set."""
    paths = []
    file.visititems(lambda name, item: paths.append(name) if isinstance(item, h5py.Dataset) and
                    not name.startswith("help/") else None)
    name = chance.choice(paths)
    shape, kind = file[name].shape, file[name].dtype
    harm = chance.randrange(16)
    if harm < 5:
        values = np.array(file[name][()])
        if values.size and kind.kind in "iuf":
            with np.errstate(all="ignore"):
                number = np.array(chance.choice(NUMBERS)).astype(kind)
            values.flat[slice(None) if harm == 0 else chance.randrange(values.size)] = number
            file[name][...] = values
        return
    del file[name]
    large = (HUGE,) if len(shape) < 2 else tuple(HUGE >> 8 * (len(shape) - 1) for _ in shape)
    one_more = (shape[0] + 1 if shape else 1, *shape[1:])
    if harm == 5:
        file.create_group(name)
    elif harm == 14:
        file[name] = chance.choice([h5py.SoftLink("/"), h5py.SoftLink("/frames/tilt"), h5py.SoftLink("/nowhere"),
                                    h5py.ExternalLink(str(secret), "/" + name)])
    elif harm < 14:
        file.create_dataset(name, **({"shape": shape, "dtype": kind} | {
            6: {"dtype": chance.choice(["<f8", ">i8", "S1000000", "<u2", "<f2"])}, 7: {"dtype": h5py.string_dtype()},
            8: {"shape": (*shape, 1)}, 9: {"shape": ()}, 10: {"shape": (0, *shape[1:])}, 11: {"shape": one_more},
            12: {"shape": large, "chunks": (1,) * len(large)},
            13: {"shape": shape or (1,), "external": [(str(secret), 0, h5py.h5f.UNLIMITED)]}}[harm]))

def spoil_one_of_folder(folder, chance, secret):
    name = chance.choice(sorted(path.name for path in folder.glob("*.h5")))
    with h5py.File(folder / name, "r+") as file:
        spoil(file, chance, secret)
    reseal_folder(folder)
    return folder


def spoil_bytes(path, chance):
    data = bytearray(path.read_bytes())
    for _ in range(chance.randrange(1, 4)):
        at = chance.randrange(512, len(data) if chance.random() < 0.5 else 6000)
        data[at] = chance.randrange(256)
    path.write_bytes(data)
    return seal(path)


def use_spoilt(seed, folder):
    """Makes one random try. Returns whether the run was rejected."""
    chance = random.Random(seed)
    (folder / "secret").write_bytes(np.full(100000, SECRET).tobytes())
    for entry in folder.glob("run*"):
        shutil.rmtree(entry) if entry.is_dir() else entry.unlink()
    if seed % 4 == 0:
        path = shutil.copytree(ROOT / "tests/runs/schema_4_stopped.h5.run", folder / "run.h5.run")
        spoil_one_of_folder(path, chance, folder / "secret")
    else:
        path = shutil.copy(KEPT, folder / "run.h5")
        if seed % 4 == 1:
            spoil_bytes(path, chance)
        else:
            sealed(path, lambda file: [spoil(file, chance, folder / "secret") for _ in range(chance.randrange(1, 3))])
    try:
        with talus.open(path) as run:
            use(run)
            assert not any(np.any(run[name] == SECRET) for name in ("particles/grains/mass", "particles/grains/radius"))
    except talus.Error:
        return True
    return False


@pytest.mark.chosen
@pytest.mark.skipif(not hasattr(os, "fork"), reason="only a child process survives")
@pytest.mark.parametrize("changes", [{647: 0x0E}, {2480: 0x0E}, {642: 143, 721: 226}])
def test_a_file_that_hdf5_crashes_on_is_an_error(tmp_path, changes):
    """Addresses of link lists outside the file, at which HDF5 reads."""
    data = bytearray(KEPT.read_bytes())
    assert data[647] == data[2480] == data[642] == 0xFF, "no addresses"
    for at, value in changes.items():
        data[at] = value
    path = tmp_path / "run.h5"
    path.write_bytes(data)
    with pytest.raises(talus.Error, match="HDF5 cannot read this file"):
        talus.open(seal(path))


@pytest.mark.skipif(not hasattr(os, "fork"), reason="only a child process survives")
def test_a_crash_of_the_trial_walk_is_an_error_and_a_file_is_walked_through_once(tmp_path, monkeypatch):
    path = shutil.copy(KEPT, tmp_path / "run.h5")
    with monkeypatch.context() as crashing:
        crashing.setattr(trial_walk, "walk", lambda _: os.kill(os.getpid(), signal.SIGSEGV))
        with pytest.raises(talus.Error, match="HDF5 crashes or hangs on this file"):
            talus.open(path)
    talus.open(path).close()
    monkeypatch.setattr(os, "fork", None)
    talus.open(path).close()


@pytest.mark.chosen
def test_any_damage_that_is_sealed_again_ends_in_an_error(tmp_path):
    tries = int(os.environ.get("TALUS_TRIES", "15"))
    refused = 0
    for seed in range(tries):
        try:
            refused += use_spoilt(seed, tmp_path)
        except Exception as error:
            raise AssertionError(f"try {seed}") from error
    assert tries / 4 < refused < tries, "the damage must make some runs unreadable, and leave others readable"


#: Bytes of a checkpoint by their places, with which HDF5 crashes when it reads the state.
CRASHING = {134: 16, 2677: 127}


@pytest.mark.parametrize("opener", ["talus.resume('run.h5')",
                                    "talus.Simulation({'bed': {'length': 10, 'depth': 1}, "
                                    "'deposition': {'method': 'file', 'file': 'run.h5'}})",
                                    "talus.open('run.h5')"])
def test_a_file_on_which_hdf5_crashes_does_not_end_the_interpreter(folder_of_run, tmp_path, opener):
    path = folder_of_run / "checkpoint_000004.h5"
    data = bytearray(path.read_bytes())
    for place, byte in CRASHING.items():
        data[place] = byte
    path.write_bytes(data)
    reseal_folder(folder_of_run)
    code = f"import talus\ntry:\n    {opener}\nexcept talus.Error as error:\n    print('refused:', error)"
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, (done.returncode, done.stderr)
    assert done.stdout.startswith("refused:") and "run.h5.run" in done.stdout, done.stdout


def test_attributes_that_claim_more_than_the_file_holds_never_end_the_program(packed):
    """The type and the shape of an attribute claim 65288 and 255 bytes: HDF5 refuses it, or crashes when it reads it."""
    original = packed.read_bytes()
    places = [place.start() for place in re.finditer(re.escape(b"\x08\x00\x08\x00unit"), original)]
    assert len(places) > 20
    refused = 0
    for place in places[:: len(places) // 20]:
        data = bytearray(original)
        data[place + 1] = data[place + 2] = 255
        packed.write_bytes(data)
        seal(packed)
        checked = subprocess.run([PROGRAM, "check", packed], capture_output=True, text=True, check=False, env=PROGRAM_ENVIRONMENT)
        assert checked.returncode in (0, 65), (place, checked.returncode, checked.stderr)
        refused += checked.returncode == 65 and str(packed) in checked.stderr
    assert refused > 5


@pytest.mark.parametrize("bit", [0x01, 0x10, 0x80])
def test_repair_loses_no_more_than_the_fact_that_is_damaged(packed, tmp_path, bit):
    """The header of a fact of the provenance cannot be read, so its group lists an object that cannot be opened."""
    with h5py.File(packed) as file:
        header = h5py.h5o.get_info(file["provenance/version"].id).addr + file.userblock_size
        frames = len(file["frames/tilt"])
    data = bytearray(packed.read_bytes())
    data[header + 24] ^= bit
    packed.write_bytes(data)
    done = subprocess.run([PROGRAM, "repair", packed, "-o", "out.h5"], cwd=tmp_path, capture_output=True, text=True,
                          env=PROGRAM_ENVIRONMENT, check=False)
    assert done.returncode == 0 and "/provenance/version" in done.stdout + done.stderr, done.stdout + done.stderr
    with h5py.File(tmp_path / "out.h5") as file:
        assert len(file["frames/tilt"]) == frames and "version" not in file["provenance"]
