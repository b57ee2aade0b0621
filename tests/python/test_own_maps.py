"""Maps of values that a script has computed, and panels and movies of maps."""

import shutil
import subprocess

import numpy as np
import pytest
import talus
from test_simulation import bed

pytest.importorskip("talus._core", reason="the extension is not built")


@pytest.fixture(scope="module")
def frame(tmp_path_factory):
    """Returns a frame of a run that failed."""
    path = tmp_path_factory.mktemp("own") / "run.h5"
    sim = bed()
    sim.record(path)
    sim.run()
    return talus.open(path).frames[-2]


@pytest.fixture(scope="module")
def live():
    """Returns a simulation of the bed at rest."""
    sim = bed()
    sim.deposit()
    return sim


def colours_at_centres(frame, picture):
    """Returns the colour of the pixel at the centre of each free grain in a bare map."""
    free = frame.grains.free
    x, y, radius = frame.position[:, 0], frame.position[:, 1], frame.radius
    scale = picture.shape[1] / frame.run.length
    column = (x[free] * scale).astype(int)
    row = ((max(0.0, (y + radius).max()) - y[free]) * scale).astype(int)
    return np.asarray(picture)[row, column, :3]


@pytest.mark.chosen
def test_own_values_are_drawn_as_talus_draws_them(frame):
    flags = frame.grains["overloaded"]
    assert flags.dtype == bool and 0 < flags.sum() < len(flags)
    np.testing.assert_array_equal(frame.draw(flags, bare=True), frame.draw("overloaded", bare=True))
    counts = np.bincount(frame.contacts.pair.ravel(), minlength=len(frame.grains))[: len(frame.grains)].astype(float)
    np.testing.assert_array_equal(frame.draw(counts, range=[0, 6], bare=True), frame.draw("coordination", bare=True))


def test_labels_have_colours_of_their_own(frame):
    labels = np.where(frame.grains.free, np.arange(len(frame.grains)) % 3 - 1, -1)
    colours = colours_at_centres(frame, frame.draw(labels, width=1200, bare=True))
    of_label = {label: np.unique(colours[labels[frame.grains.free] == label], axis=0) for label in (-1, 0, 1)}
    assert all(len(each) == 1 for each in of_label.values()), "one colour for each label"
    assert (of_label[-1] == 255).all() and (of_label[0] != of_label[1]).any()


def test_values_of_both_signs_have_zero_in_the_middle(frame):
    values = frame.position[:, 0] - 0.3 * frame.run.length
    values[0] = np.nan
    colours = colours_at_centres(frame, frame.draw(values, width=1200, bare=True))
    assert (colours[0] == 255).all(), "no value"
    left, right = colours[np.nanargmin(values[frame.grains.free])], colours[np.nanargmax(values[frame.grains.free])]
    assert (left != right).any()
    np.testing.assert_array_equal(frame.draw(values, bare=True),
                                  frame.draw(values, bare=True, range=[-np.nanmax(np.abs(values)), np.nanmax(np.abs(values))]))


def test_values_of_contacts_are_lines_between_centres(frame):
    nothing = frame.draw(np.zeros(len(frame.contacts), bool), bare=True)
    everything = frame.draw(np.ones(len(frame.contacts), bool), bare=True)
    one = frame.draw(np.arange(len(frame.contacts)) == 5, bare=True)
    np.testing.assert_array_equal(nothing, frame.draw(np.full(len(frame.contacts), np.nan), bare=True))
    assert 0 < (one != nothing).any(axis=2).sum() < (everything != nothing).any(axis=2).sum() / 10
    assert frame.draw(frame.contacts.force[:, 0], label="f_n", unit="N/m").shape[1] == 900


@pytest.mark.chosen
@pytest.mark.parametrize(("what", "options", "kind", "text"), [
    (np.zeros(7), {}, ValueError, "7 values: expected one for each of the 84 free grains"),
    (np.zeros((84, 2)), {}, TypeError, "expected the name of a map, or an array"),
    (np.array(["a"] * 84), {}, TypeError, "expected the name of a map, or an array"),
    (np.zeros(84), {"label": 3}, TypeError, "label 3: expected a string"),
    (np.zeros(84), {"label": "漢"}, ValueError, "pictures support only Latin-1 letters"),
    (np.zeros(84), {"range": [1, 1]}, ValueError, "range"),
    ("gamma", {"label": "x"}, TypeError, "only values of your own take a label"),
])
def test_wrong_values_are_refused(frame, live, what, options, kind, text):
    for owner in (frame, live):
        with pytest.raises(kind, match=text) as caught:
            owner.draw(what, **options)
        assert isinstance(caught.value, talus.Error)


def test_values_are_stored_with_their_run(frame, tmp_path):
    path = tmp_path / "run.h5"
    shutil.copy(frame.run.path, path)
    run = talus.open(path)
    grains, count = len(run.id), len(run.frames)
    number = [np.arange(grains) + 0.5 * k for k in range(count)]
    label = [np.where(each.free, 2, -1)[: run.free.sum()] for each in run.frames]
    flag = [each.contacts.status == 2 for each in run.frames]
    run.store("slip", number, label="v_s", unit="m/s")
    run.store("patch", label)
    run.store("slides", flag, label="sliding contacts")
    assert run.own == ["slides", "patch", "slip"] == talus.open(path).own
    for k, each in enumerate(run.frames):
        np.testing.assert_array_equal(each.grains["slip"], number[k])
        np.testing.assert_array_equal(each.grains["patch"], np.where(each.free, 2, -1))
        np.testing.assert_array_equal(each.contacts["slides"], flag[k])
    assert each.grains["patch"].dtype.kind == "i" and each.contacts["slides"].dtype == bool
    assert "slip" in each.grains.quantities and "slides" in each.contacts.quantities
    np.testing.assert_array_equal(run["own/grains/slip"], number)
    np.testing.assert_array_equal(run.read_frame("own/contacts/slides", 3), flag[3])
    np.testing.assert_array_equal(each.draw("slip"), each.draw(number[-1], label="v_s", unit="m/s"))
    with pytest.raises(OSError, match="overwrite=True"):
        run.store("slip", number)
    run.store("slip", [-each for each in number], overwrite=True)
    np.testing.assert_array_equal(run.frames[2].grains["slip"], -number[2])
    assert run.own == ["slides", "patch", "slip"]
    before = path.read_bytes()
    for name, values, kind, text in [
            ("Slip", number, ValueError, "lower-case"), ("gamma", number, ValueError, "choose another"),
            ("velocity_x", number, ValueError, "choose another"), ("lc_1_5", number, ValueError, "choose another"),
            (3, number, TypeError, "expected a string"), ("mine", number[1:], ValueError, "one for each of the"),
            ("mine", 7, TypeError, "an array for each frame"), ("mine", [*number[1:], label[0]], TypeError, "in all frames"),
            ("mine", [*number[1:], number[0][:7]], ValueError, "values: expected one"), ("mine", [*number[1:], None], TypeError, "expected an array")]:
        with pytest.raises(kind, match=text) as caught:
            run.store(name, values)
        assert isinstance(caught.value, talus.Error)
    with pytest.raises(talus.Error, match="a unit with one of the signs"):
        run.store("mine", number, unit="m,s")
    assert path.read_bytes() == before


def test_panels_and_movies_have_one_layout(frame, live, tmp_path):
    own = frame.map(frame.grains["pressure"], label="p", unit="Pa")
    one = talus.panel([frame.map("gamma")], width=600)
    two = talus.panel([[frame.map("gamma"), own], [frame.map("overloaded"), own]], width=800, title="Two maps")
    assert one.shape[1] == 600 and two.shape[1] == 800 and (two[..., 3] == 255).all()
    with pytest.raises(ValueError, match="lists of maps of one length"):
        talus.panel([[own], [own, own]])
    with pytest.raises(TypeError, match="expected a map"):
        talus.panel([frame.draw("gamma")])
    if shutil.which("ffmpeg") is None:
        return
    sim, pictures = live.copy(), []
    while not sim.done and len(pictures) < 4:
        pictures.append([sim.map("gamma"), sim.map(sim.grains["speed"], label="speed", unit="m/s", range=[0, 0.01])])
        sim.tilt_by(1)
    movie = tmp_path / "own.mp4"
    talus.animate(movie, pictures, size=(640, 360), fps=4)
    found = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=width,height,nb_read_frames",
                            "-of", "csv=p=0", movie], capture_output=True, text=True).stdout
    assert found.strip() in ("640,360,4", ""), found
    with pytest.raises(OSError, match="overwrite=True"):
        talus.animate(movie, pictures)


def test_pictures_of_a_movie_have_one_layout(frame, tmp_path):
    image = pytest.importorskip("PIL.Image", reason="python3-pil is not installed")
    if shutil.which("ffmpeg") is None:
        pytest.skip("ffmpeg is not installed")
    frames = frame.run.frames
    assert frames[0].position[:, 1].max() != frames[-1].position[:, 1].max()
    for turned in (False, True):
        talus.animate(tmp_path / "m.gif", [each.map("pressure", range=[0, 1], turned=turned) for each in (frames[0], frame, frames[-1])],
                      size=(420, 300), overwrite=True)
        bars = set()
        with image.open(tmp_path / "m.gif") as movie:
            for k in range(movie.n_frames):
                movie.seek(k)
                dark = np.asarray(movie.convert("RGB")).min(axis=2) < 128
                bars.add(int(np.flatnonzero(dark[:, :200].any(axis=1))[-1]))
        assert len(bars) == 1, "lowest row of the legend, which is on the left"
