"""Deposits beds, and tilts copies of each with different friction in parallel, in a pool of threads.

usage: python3 friction_sweep.py [KEY=VALUE...]      e.g. bed.length=30"""

import os
import sys
import tomllib
from concurrent.futures import ThreadPoolExecutor

import matplotlib.pyplot as plt
import numpy as np
import talus

BED = {"bed.length": 40, "bed.depth": 10, "tilt.rate": 4, "tilt.step": 0.008}
SEEDS = [1, 2, 3]
FRICTIONS = [0.1, 0.2, 0.35, 0.6, 1.0]


def deposited(seed):
    sim = talus.Simulation(BED, **tomllib.loads("\n".join(sys.argv[1:])) | {"seed": seed})
    sim.deposit()
    return sim


def tilted(sim, friction):
    """Tilts a bed until it fails; returns its tilts (deg) and changes of volume (%), and its angle of repose (deg)."""
    sim.friction, history = friction, []
    while not sim.done:
        sim.tilt_by(0.25)
        history.append((sim.tilt, 100 * sim["volume_strain"]))
    return np.transpose(history), sim.theta_c


with ThreadPoolExecutor(os.cpu_count()) as pool:
    beds = list(pool.map(deposited, SEEDS))
    copies = [(bed.copy(), friction) for bed in beds for friction in FRICTIONS]
    results = list(pool.map(tilted, *zip(*copies)))
theta_c = np.reshape([angle for _, angle in results], (len(SEEDS), len(FRICTIONS)))

figure, (left, right) = plt.subplots(1, 2, figsize=(8, 3.6), layout="constrained")
colours = plt.cm.viridis(np.linspace(0, 0.9, len(FRICTIONS)))
for friction, colour, ((tilt, volume), angle) in zip(FRICTIONS, colours, results):
    left.plot(tilt[tilt <= angle], volume[tilt <= angle], color=colour, label=f"{friction:g}")
left.axhline(0, color="0.8", linewidth=0.8, zorder=0)
left.set(xlabel=r"tilt $\theta$ (deg)", ylabel="change of volume (%)", xlim=(0, None))
left.set_title(f"copies of the bed of seed {SEEDS[0]}, up to failure", fontsize=10)
left.legend(title=r"$\mu$", frameon=False, fontsize=9)
right.plot(FRICTIONS, theta_c.T, "o", color="0.7")
right.plot(FRICTIONS, theta_c.mean(axis=0), "k_-", markersize=14, label=f"mean of {len(SEEDS)} seeds")
friction = np.linspace(0, 0.6)
right.plot(friction, np.degrees(np.arctan(friction)), ":", color="black", linewidth=1, label=r"$\arctan\,\mu$, at which a block slides")
right.set(xlabel=r"friction between grains $\mu$", ylabel=r"angle of repose $\theta_c$ (deg)", xlim=(0, 1.05), ylim=(0, 32))
right.legend(frameon=False, loc="lower right", fontsize=9)
figure.savefig("friction-sweep.png", dpi=110)
for friction, angles in zip(FRICTIONS, theta_c.T):
    print(f"mu = {friction:g}: theta_c = {', '.join(f'{angle:.1f}' for angle in angles)} deg")
