"""The scripts and the notebook of examples/python run like a user runs them, draw their pictures, and show
what docs/python.md describes. Their beds are smaller here; docs/make draws the pictures of the page from
the full beds."""

import re
import runpy
import subprocess
import sys
import textwrap

import numpy as np
import pytest
from conftest import ROOT

import talus

pytest.importorskip("talus._core", reason="the extension is not built: pybind11-dev, python3-dev")

EXAMPLES = ROOT / "examples/python"
PAGE = (ROOT / "docs/python.md").read_text()
QUICK = ["deposition.rate=2", "deposition.rest_velocity=0.1", "output.frame_every=10"]


@pytest.fixture
def run_example(tmp_path, monkeypatch):
    """Runs a script in an empty folder; returns its names once it has drawn its picture."""
    plt = pytest.importorskip("matplotlib.pyplot", reason="matplotlib is not installed: python3-matplotlib")
    plt.switch_backend("Agg")
    monkeypatch.chdir(tmp_path)

    def run(name, length, depth):
        monkeypatch.setattr(sys, "argv", [name, f"bed.length={length}", f"bed.depth={depth}", *QUICK])
        names = runpy.run_path(str(EXAMPLES / f"{name}.py"), run_name="__main__")
        plt.close("all")
        [picture] = tmp_path.glob("*.png")
        assert picture.stat().st_size > 10_000 and plt.imread(picture).shape[1] == 880, "all pictures of the page have the same width"
        return names

    return run


@pytest.mark.chosen
def test_a_bed_is_held_where_half_of_it_is_overloaded(run_example, capsys):
    names = run_example("stop_at_fraction", 14, 8)
    sim, shares = names["sim"], [share for _, share in names["tilted"]]
    assert sim.tilt_rate == 0 and not sim.done
    assert shares[-1] >= 0.5 > max(shares[:-1])
    assert names["tilted"][-1][0] == sim.tilt
    assert names["time"][-1] - names["time"][0] == pytest.approx(names["HOLD"])
    assert names["speed"][-10:].max() < 1e-4 < names["speed"].max(), "it is at rest"
    assert f"{sim.tilt:.2f} deg: " in capsys.readouterr().out
    sim.commit()
    recorded = talus.open("held.h5")
    assert not recorded.complete and recorded.steps["step"][-1] == sim.step_count


def test_the_controller_keeps_a_slope_at_the_edge(run_example, capsys):
    names = run_example("edge_of_failure", 20, 10)
    sim, friction = names["sim"], names["friction"]
    assert not sim.done and sim.phase == "tilt" and sim.theta_c is None
    assert sim.tilt == pytest.approx(14, abs=0.01)
    late = names["time"] > names["DURATION"] / 2
    assert 0.15 < friction[late].min() and friction[late].max() < 0.5
    slips = names["rms"] > names["QUIET"]
    assert 0 < slips[late].mean() < 0.2, "it slips occasionally"
    rises = np.diff(friction) > 0
    np.testing.assert_array_equal(rises, slips[1:])
    assert "stands" in capsys.readouterr().out


def test_strong_contacts_turn_against_the_slope(run_example):
    names = run_example("fabric_each_degree", 24, 12)
    fabric, tilt = names["fabric"], names["tilt"]
    np.testing.assert_allclose(np.diff(tilt), 1, atol=0.01)
    assert tilt[-1] <= names["sim"].theta_c
    (first, _), (last, direction) = (fabric(names["strong"][k]) for k in (0, -1))
    assert last > first + 0.2 and last > 2 * fabric(names["weak"][-1])[0]
    assert 90 + tilt[-1] < direction < 160
    # Normals in one direction have the largest anisotropy; uniformly distributed ones have none.
    angle = np.linspace(0, np.pi, 12, endpoint=False)
    assert fabric(np.array([[0.6, 0.8]] * 5)) == pytest.approx((2, np.degrees(np.arctan2(0.8, 0.6))))
    assert fabric(np.transpose([np.cos(angle), np.sin(angle)]))[0] == pytest.approx(0, abs=1e-12)


def test_copies_are_tilted_side_by_side(run_example):
    names = run_example("friction_sweep", 14, 8)
    theta_c, frictions = names["theta_c"], names["FRICTIONS"]
    assert theta_c.shape == (3, len(frictions)) and np.isfinite(theta_c).all()
    mean = theta_c.mean(axis=0)
    assert mean[-1] > mean[0] + 4
    assert mean[0] > np.degrees(np.arctan(frictions[0])) and mean[-1] < np.degrees(np.arctan(frictions[-1]))
    # A copy in a pool gives the same result as on its own.
    alone = names["beds"][1].copy()
    assert names["tilted"](alone, frictions[2])[1] == theta_c[1, 2]


def test_a_push_moves_its_grains(run_example, capsys):
    names = run_example("push", 20, 8)
    far = np.hypot(*names["moved"].T) / names["D"]
    assert far[names["pushed"]].min() > 0.05 and len(names["pushed"]) == 10
    assert names["energy"][-1] < 1e-3 * names["energy"][0], "the bed has come to rest"
    shares = [int(share) for share in re.findall(r"(\d+)% of the grains", capsys.readouterr().out)]
    assert len(shares) == 3 and shares[0] < shares[-1]


@pytest.mark.chosen
def test_an_example_is_run_by_its_path(tmp_path):
    """Invalid settings are rejected with the message of the library."""
    done = subprocess.run([sys.executable, EXAMPLES / "push.py", "bed.lenght=3"], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 1 and "bed.lenght" in done.stderr and not list(tmp_path.iterdir())


@pytest.mark.chosen
def test_page_shows_each_example_with_its_picture_and_its_command():
    scripts = sorted(path.name for path in EXAMPLES.iterdir() if path.suffix in (".py", ".ipynb"))
    assert len(scripts) == 6
    sections = re.split(r"^### ", PAGE[PAGE.index("## Six experiments") :], flags=re.MULTILINE)[1:]
    shown = [re.search(r"!\[[^]]{20,}\]\(images/python/([\w-]+)\.png\)\n\n    \S+ examples/python/(\w+\.\w+)$", section, re.MULTILINE)
             for section in sections]
    assert sorted(found[2] for found in shown) == scripts
    for found in shown:
        assert found[1] == found[2].partition(".")[0].replace("_", "-")


def test_controller_of_the_readme_holds_its_slope(tmp_path, monkeypatch):
    [code] = re.findall(r"^ *```python\n(.*?)^ *```$", (ROOT / "README.md").read_text(), re.MULTILINE | re.DOTALL)
    assert code.count("\n") <= 10 and "sim.time < 60" in code
    (tmp_path / "assets/scenarios").mkdir(parents=True)
    (tmp_path / "assets/scenarios/demo.toml").write_text("[bed]\nlength = 20\ndepth = 10\n[tilt]\nrate = 4\nstep = 0.008\n")
    monkeypatch.chdir(tmp_path)
    names = {}
    exec(textwrap.dedent(code).replace("sim.time < 60", "sim.time < 20"), names)
    sim = names["sim"]
    assert not sim.done and sim.theta_c is None and sim.tilt == pytest.approx(14, abs=0.01)
    assert 0.15 < sim.friction < 0.49


def test_a_notebook_has_a_live_figure(tmp_path, monkeypatch):
    nbclient = pytest.importorskip("nbclient", reason="nbclient is not installed: python3-nbclient")
    nbformat = pytest.importorskip("nbformat", reason="nbformat is not installed: python3-nbformat")
    pytest.importorskip("ipykernel", reason="ipykernel is not installed: python3-ipykernel")
    notebook = nbformat.read(EXAMPLES / "live_figure.ipynb", 4)
    cells = {cell.id: cell for cell in notebook.cells}
    assert not any(cell.get("outputs") or cell.get("execution_count") for cell in notebook.cells), "the notebook is stored without outputs"
    assert '"bed.length": 36, "bed.depth": 12' in cells["bed"].source
    cells["bed"].source = cells["bed"].source.replace('"bed.length": 36, "bed.depth": 12', '"bed.length": 14, "bed.depth": 8')
    cells["tilt"].source = cells["tilt"].source.replace("sim.tilt_by(0.5)", "sim.tilt_by(3)")
    monkeypatch.delenv("MPLBACKEND", raising=False)
    first = []

    def keep_first(cell, cell_index, execute_reply):
        if cell.id == "figure":
            first.append(picture_of(cell))

    nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3", on_cell_executed=keep_first,
                            resources={"metadata": {"path": str(tmp_path)}}).execute()
    assert first and picture_of(cells["figure"]) != first[0], "the figure was updated while the bed was tilted"
    for name in ("bed", "map"):
        assert picture_of(cells[name])
    assert [output.output_type for output in cells["tilt"].outputs] == ["stream"]
    assert re.fullmatch(r"The slope failed at \d+\.\d\d deg.\n", cells["tilt"].outputs[0].text)
    assert (tmp_path / "live-figure.png").stat().st_size > 10_000


def picture_of(cell):
    """Returns the only picture among the outputs of a cell."""
    [picture] = [output.data["image/png"] for output in cell.outputs if "image/png" in output.get("data", {})]
    assert len(picture) > 5_000
    return picture
