"""Drives runs of Talus, and reads its run files and ensembles.

    import talus
    run = talus.open("runs/demo.h5", units="D")          # lengths in D, angles in deg; without: SI, rad
    frame = run.frame_at("repose")
    frame.position, frame.contacts.force, run.observables["volume_strain"], run.analysis["overloaded/fraction"]
    talus.open_ensemble("runs/ensemble").mean("theta_c")

Names of data sets are those of docs/file_format.md and docs/analysis.md; signs are those of docs/notation.md: x
downslope, y away from the floor, compression positive, rotation counter-clockwise. docs/cookbook.md has ten recipes."""

from talus.contacts import Contacts
from talus.drawing import Image, animate, panel
from talus.ensemble import Ensemble, Mean, Member, mean_of, open_ensemble
from talus.errors import Error
from talus.frame import Frame
from talus.run import Run, open
from talus.simulation import Simulation, resume
from talus.stress import stress_ratio
from talus.table import Table
from talus.version import __version__

__all__ = ["Contacts", "Ensemble", "Error", "Frame", "Image", "Mean", "Member", "Run", "Simulation", "Table", "__version__",
           "animate", "mean_of", "open", "open_ensemble", "panel", "resume", "stress_ratio"]
