"""A quantity of grains added only to the table of quantities (tests/unit/quantity) is found by its name."""

import subprocess
import sys

import pytest
import talus
from conftest import BUILD
from test_simulation import BED, bed

EXTENSION = BUILD / "made_up/_core.so"

SCRIPT = f"""
import importlib.util, sys
found = importlib.util.spec_from_file_location("talus._core", sys.argv[1])
sys.modules["talus._core"] = importlib.util.module_from_spec(found)
found.loader.exec_module(sys.modules["talus._core"])

import numpy as np
import talus

sim = talus.Simulation({BED!r})
sim.record("run.h5")
sim.deposit()
assert talus.simulation._core.__file__ == sys.argv[1]
np.testing.assert_array_equal(sim.grains["made_up"], 2 * sim.grains.radius)
np.testing.assert_array_equal(sim.draw("made_up", width=300), sim.draw("made_up", width=300))
sim.run()
frame = talus.open("run.h5").frames[0]
np.testing.assert_array_equal(frame.grains["made_up"], 2 * frame.radius)
frame.draw("made_up", width=300)
"""


def test_a_made_up_quantity_is_found(tmp_path):
    if not EXTENSION.exists():
        pytest.skip(f"{EXTENSION} is not built")
    with pytest.raises(talus.Error, match="no quantity of grains is called 'made_up'"):
        bed().grains["made_up"]
    done = subprocess.run([sys.executable, "-c", SCRIPT, EXTENSION], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
