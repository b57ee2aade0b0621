"""The study of precursors of failure (docs/studies/precursor_ranking.py), for measures with a known
answer, for a made-up ensemble.h5 and for runs."""

import sys

import h5py
import numpy as np
import pytest
import talus
from conftest import ROOT

sys.path.insert(0, str(ROOT / "docs/studies"))
import precursor_ranking as study  # noqa: E402

RANDOM = np.random.default_rng(7)


def root_mean_square(*measures):
    return study.root_mean_square(study.squared_errors(*measures))[0]


def curves(beds, slope, noise, offset=0.0):
    """Returns a measure that is `slope` times the distance, plus an offset of each bed and independent
    noise."""
    return slope * study.DISTANCES + np.zeros((beds, 1)) + offset + noise * RANDOM.standard_normal((beds, len(study.DISTANCES)))


def test_estimate_is_the_mean_distance_once_the_measure_is_known():
    """Checks the definition directly, for one bed of six."""
    measure = curves(6, 1, 0.6, 0.1 * np.arange(6)[:, None])
    bed, at = 2, 5
    others = np.delete(measure, bed, axis=0)
    mean, variance = others.mean(axis=0), others.var(axis=0, ddof=1)
    weight = np.exp(-0.5 * (measure[bed, at] - mean) ** 2 / variance) / np.sqrt(variance)
    expected = (np.average(study.DISTANCES, weights=weight) - study.DISTANCES[at]) ** 2
    assert study.squared_errors(measure)[bed, at] == pytest.approx(expected, rel=1e-12)


def test_error_of_noise_is_that_of_no_measure_and_of_the_distance_itself_is_none():
    assert root_mean_square(curves(200, 0, 1)) == pytest.approx(np.std(study.DISTANCES), abs=0.1)
    assert root_mean_square(curves(20, 1, 0.01)) < 0.02
    scaled = curves(12, 1, 0.7)
    assert root_mean_square(1e-7 * scaled + 3e-7) == pytest.approx(root_mean_square(scaled), abs=1e-6), "units do not matter"


def test_two_measures_whose_errors_cancel_are_exact():
    offset = 1.5 * np.sin(np.arange(40) ** 2)[:, None]
    up, down = curves(40, 1, 0.05, offset), curves(40, 1, 0.05, -offset)
    assert root_mean_square(up) > 0.6
    assert root_mean_square(up, down) < 0.1
    assert root_mean_square(up, up) == pytest.approx(root_mean_square(up), abs=0.05), "the same measure twice adds nothing"


def test_beds_without_a_measure_are_left_out():
    measure = curves(8, 1, 0.3)
    measure[3] = np.nan
    measure[4, 0] = np.nan
    squares = study.squared_errors(measure)
    assert np.isnan(squares[3]).all() and np.isnan(squares[4, 0]) and not np.isnan(squares[4, 1:]).any()
    assert np.isnan(study.squared_errors(curves(study.MIN_CALIBRATION, 1, 0.3))).all(), "too few beds calibrate it"
    assert np.isnan(study.squared_errors(np.ones((9, len(study.DISTANCES))))).all(), "it does not vary"


def test_count_that_is_still_zero_means_far_away():
    measure = np.zeros((10, len(study.DISTANCES)))
    measure[:, 0] = 2 + np.arange(10) % 2
    squares = study.squared_errors(measure)
    assert squares[:, 0] == pytest.approx(0, abs=1e-6)
    assert squares[0, 1] == pytest.approx((study.DISTANCES[1:].mean() - study.DISTANCES[1]) ** 2)


def test_root_mean_square_has_the_error_of_its_mean():
    value, error = study.root_mean_square(np.array([[1.0], [4.0], [np.nan]]))
    assert (value, error) == pytest.approx((np.sqrt(2.5), 0.5 * 1.5 / np.sqrt(2.5)))
    assert np.isnan(study.root_mean_square(np.array([[1.0]]))[0])


@pytest.fixture
def ensemble(tmp_path):
    """Creates an ensemble.h5 of twelve beds that fail from 18 to 22 deg. `reported` predicts the distance
    except for a scale of each bed, `strain` except for an offset, `steep` is the sine of the tilt, `noise`
    predicts nothing; `same` does not vary, and `lc/mean` is at two thresholds."""
    theta_c = 18 + 4 * (5 * np.arange(12) % 12) / 11
    frames = (theta_c / 0.25).astype(int) + 1
    tilt = np.concatenate([np.arange(count) * 0.25 for count in frames])
    scale, left = np.repeat(RANDOM.uniform(1, 3, 12), frames), np.repeat(theta_c, frames) - tilt
    noise, growth = RANDOM.uniform(size=tilt.shape), np.exp(-left / 3)
    with h5py.File(tmp_path / "ensemble.h5", "w") as file:
        analysis = file.create_group("variants/0/analysis")
        analysis["frames"], analysis["tilt"] = frames, np.radians(tilt)
        analysis["theta_c"], analysis["gamma_c"] = np.radians(theta_c), np.sin(np.radians(theta_c))
        analysis["reported"] = scale * (1 + growth) * (1 + 0.001 * noise)
        analysis["strain"] = scale - 2 + growth + 0.02 * noise
        analysis["steep"], analysis["noise"], analysis["same"] = np.sin(np.radians(tilt)), noise, 0.5 + 0 * tilt
        analysis["lc/mean"] = np.stack([20 - left + 0.1 * noise, 20 - left + noise], axis=1)
    return tmp_path / "ensemble.h5"


def test_ranking_has_the_best_measure_first_and_the_tilt_to_compare_with(ensemble):
    rows = study.ranking(study.beds_of_ensemble(ensemble))
    assert [row["error"] for row in rows] == sorted(row["error"] for row in rows)
    of = {row["measure"]: row for row in rows}
    assert "same" not in of, "it does not vary"
    assert 0.7 < of["tilt"]["error"] < 1.5, "theta_c scatters by 1.3 deg"
    assert of["steep"]["error"] == pytest.approx(of["tilt"]["error"], abs=0.02)
    assert of["steep"]["gain"] == pytest.approx(0, abs=0.1)
    assert of["noise"]["error"] > 2
    assert of["reported"]["error"] < 0.6, "by the ratio: each bed has a different scale"
    assert of["strain"]["error"] < 0.6, "by the difference: it has either sign"
    assert of["reported"]["gain"] > 3 * of["reported"]["gain_error"]
    assert of["reported"]["contrast_1"] > of["reported"]["contrast_3"] > 0
    assert {row["beds"] for row in rows} == {12}
    assert [of[name]["own_threshold"] for name in ("lc/mean", "lc/mean[1]", "reported")] == [1, 1, 0]


def test_few_beds_are_refused(ensemble):
    with h5py.File(ensemble, "r+") as file:
        file["variants/0/analysis/theta_c"][:5] = np.nan
    with pytest.raises(ValueError, match="7 beds have failed; expected at least 8"):
        study.ranking(study.beds_of_ensemble(ensemble))


def test_program_writes_a_table_prints_it_and_draws_it(ensemble, tmp_path, capsys):
    pytest.importorskip("matplotlib", reason="matplotlib is not installed: python3-matplotlib")
    table = tmp_path / "ranking.csv"
    study.main([str(ensemble), "-o", str(table)])
    assert study.read_table(table)[0].keys() == study.read_table(ROOT / "docs/data/precursor-ranking.csv")[0].keys()
    study.main([str(table), "--rows", "3"])
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 5 and lines[2].startswith("| 1 | ")
    study.main([str(table), "-o", str(tmp_path / "figures/ranking.png")])
    assert (tmp_path / "figures/ranking.png").read_bytes().startswith(b"\x89PNG")


def test_runs_are_read_by_their_analysis(analysed):
    beds = study.beds_of_runs([analysed, analysed])
    with talus.open(analysed) as run:
        mean = run.analysis["lc/mean"][:, 1]
        tilt = run.tilt[: len(mean)]
        assert beds.theta_c == pytest.approx([run.theta_c] * 2)
        at = np.interp(beds.theta_c[0] - study.DISTANCES[7], tilt, mean)
        assert beds.near["lc/mean[1]"][:, 7] == pytest.approx([at, at], nan_ok=True)
        assert "contacts/fabric_angle" not in beds.near
