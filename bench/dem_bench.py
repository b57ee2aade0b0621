#!/usr/bin/env python3
"""Measures the cost of a second of the paper's tilt by Contact Dynamics and by the Discrete Element Method of LAMMPS: the
same bed, from the frame nearest to 10 deg, on one core each. Prints a Markdown table.

The springs of the grains determine the step of LAMMPS. Their stiffness follows from the allowed overlap of the deepest grains under the
weight of the bed, and the step is 1/30 of the duration of a binary contact (LAMMPS recommends 1/50).

usage: dem_bench.py TALUS [--run RUN.h5] [--steps N]
"""
import argparse
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "python"))
import talus  # noqa: E402

OVERLAPS = (1e-3, 1e-4)  # D
STEPS_IN_CONTACT = 30
TILT = 10.0  # deg
PHASE_TILT = 1

INPUT = """
units si
dimension 2
boundary p f p
atom_style sphere
newton off
comm_modify vel yes
read_data {data}
set group all density/disc {density}
group floor type 2
group free type 1
pair_style gran/hooke/history {kn} NULL {damping} NULL {friction} 1
pair_coeff * *
fix gravity free gravity {gravity} vector {gx} {gy} 0
fix motion free nve/sphere disc
fix hold floor freeze
fix plane all enforce2d
neighbor {skin} bin
neigh_modify delay 0 check yes exclude group floor floor
timestep {step}
thermo_style custom step ke
thermo {steps}
run {settle}
run {steps}
"""


def write_data(frame, run, path):
    """Writes the grains of the frame, at rest; the layer is one metre thick, the unit of Talus."""
    x, y = frame.position.T
    kind = np.where(frame.free, 1, 2)
    with open(path, "w") as out:
        out.write(f"bed\n\n{len(x)} atoms\n2 atom types\n\n0 {run.length} xlo xhi\n{y.min() - run.D} "
                  f"{y.max() + 20 * run.D} ylo yhi\n-0.5 0.5 zlo zhi\n\nAtoms\n\n")
        for i in range(len(x)):
            out.write(f"{i + 1} {kind[i]} {2 * frame.radius[i]:.17g} 1.0 {x[i]:.17g} {y[i]:.17g} 0.0\n")


def dem_cost(run, frame, overlap, steps):
    """Returns the steps and the wall time (s) of LAMMPS for a second of the bed, and the final kinetic energy (J)."""
    mass = run.mass[frame.free]
    depth = len(mass) * run.D / run.length  # number of layers
    kn = depth * mass.mean() * run.gravity / (overlap * run.D)
    reduced = 0.5 * mass.min()
    step = math.pi * math.sqrt(reduced / kn) / STEPS_IN_CONTACT
    with tempfile.TemporaryDirectory() as folder:
        write_data(frame, run, os.path.join(folder, "data"))
        with open(os.path.join(folder, "in"), "w") as out:
            out.write(INPUT.format(
                data=os.path.join(folder, "data"), density=run.scenario["grains"]["density"], kn=kn,
                # 1/s, for a restitution of 0.1.
                damping=1.7 * math.sqrt(kn / mass.mean()), friction=run.scenario["contact"]["friction"], gravity=run.gravity,
                gx=math.sin(math.radians(frame.tilt)), gy=-math.cos(math.radians(frame.tilt)), skin=0.2 * run.D, step=step,
                settle=steps // 10, steps=steps))
        environment = os.environ | {"OMP_NUM_THREADS": "1"}
        done = subprocess.run(["lmp", "-in", os.path.join(folder, "in"), "-log", "none"], capture_output=True, text=True,
                              env=environment)
    times = re.findall(r"Loop time of (\S+) on 1 procs", done.stdout)
    if done.returncode != 0 or len(times) != 2:
        raise SystemExit(f"lmp failed:\n{done.stdout[-2000:]}{done.stderr}")
    energy = float(re.findall(rf"^\s*{steps + steps // 10}\s+(\S+)", done.stdout, re.MULTILINE)[-1])
    return 1.0 / step, float(times[1]) / steps / step, energy


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("talus", help="program to measure")
    parser.add_argument("--run", help="run of the paper's bed on one thread; computed if it does not exist")
    parser.add_argument("--steps", type=int, default=2000, help="number of timed steps of LAMMPS")
    arguments = parser.parse_args()
    if shutil.which("lmp") is None:
        raise SystemExit("dem_bench.py: error: lmp is missing; on Debian: apt-get install lammps")
    with tempfile.TemporaryDirectory() as folder:
        path = arguments.run or os.path.join(folder, "run.h5")
        if not os.path.exists(path):
            subprocess.run([arguments.talus, "run", os.path.join(ROOT, "assets/scenarios/paper-pbc.toml"), "-o", path,
                            "--quiet", "--threads", "1"], check=True)
        with talus.open(path) as run:
            frame = run.frame_at(TILT)
            steps = run.steps
            of_tilt = steps["phase"] == PHASE_TILT
            h = run.scenario["tilt"]["step"] / run.scenario["tilt"]["rate"]
            cost = float(run["provenance/timing/tilt"]) / (of_tilt.sum() * h)
            print(f"{frame.free.sum()} grains, on one core; LAMMPS from the frame at {frame.tilt:.1f} deg, Talus the mean of its tilt")
            print()
            print("| program | method | overlap of the deepest grains | steps for a second | wall time for a second | ratio |")
            print("|---|---|--:|--:|--:|--:|")
            print(f"| Talus | Contact Dynamics | no springs | {1.0 / h:.0f} | {cost:.1f} s | 1 |")
            for overlap in OVERLAPS:
                count, seconds, energy = dem_cost(run, frame, overlap, arguments.steps)
                print(f"| LAMMPS | springs and dashpots | {overlap:.0e} D | {count:.0f} | {seconds:.0f} s | {seconds / cost:.0f} |")
                print(f"kinetic energy at the end {energy:.1e} J", file=sys.stderr)


if __name__ == "__main__":
    sys.exit(main())
