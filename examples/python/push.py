"""Gives the same push to ten grains at the surface of a bed at several tilts, and shows how far the disturbance reaches.

usage: python3 push.py [KEY=VALUE...]      e.g. bed.length=30 seed=2"""

import sys
import tomllib

import matplotlib.pyplot as plt
import numpy as np
import talus
from matplotlib.collections import EllipseCollection
from matplotlib.colors import LogNorm

BED = {"bed.length": 50, "bed.depth": 12, "tilt.rate": 4, "tilt.step": 0.008}
TILTS = [0, 8, 16]   # deg
SPEED = 2.0          # sqrt(g D), downslope
DURATION = 0.4       # s, after the push
EVERY = 0.01         # s

bed = talus.Simulation(BED, **tomllib.loads("\n".join(sys.argv[1:])))
bed.deposit()
free, D = bed.grains.free, bed.D
figure, axes = plt.subplots(len(TILTS) + 1, figsize=(8, 7.8), height_ratios=[1, 1, 1, 0.7], layout="constrained")
for map, tilt in zip(axes, TILTS):
    bed.tilt_to(tilt)
    sim = bed.copy()
    sim.tilt_rate = 0
    start, turns = sim.grains.position[free].copy(), sim.grains.image[free].copy()
    x, y = start.T
    there = np.flatnonzero(abs(x - 0.25 * sim.length) < 3 * D)
    pushed = there[np.argsort(y[there])[-10:]]
    sim.push(pushed, (SPEED * np.sqrt(sim.gravity * D), 0))
    energy = [sim["kinetic_energy"]]
    while not sim.done and len(energy) < DURATION / EVERY:
        sim.run(EVERY)
        energy.append(sim["kinetic_energy"])
    moved = sim.grains.position[free] - start
    moved[:, 0] += sim.length * (sim.grains.image[free] - turns)  # across the periodic edge
    print(f"{tilt} deg: {np.mean(np.hypot(*moved.T) > 0.01 * D):.0%} of the grains have moved by more than 0.01 D")

    size = 2 * sim.grains.radius[free] / D
    rims = np.where(np.isin(np.arange(len(size)), pushed), "deepskyblue", "0.5")
    grains = EllipseCollection(size, size, 0 * size, units="xy", offsets=start / D, offset_transform=map.transData,
                               array=np.hypot(*moved.T) / D, cmap="inferno_r", norm=LogNorm(1e-4, 10),
                               edgecolor=rims, linewidth=np.where(rims == "0.5", 0.4, 1.5))
    map.add_collection(grains)
    map.set(aspect="equal", xlim=(0, sim.length / D), ylim=(0, y.max() / D + 1), ylabel="$y$ ($D$)")
    map.set_title(rf"$\theta$ = {tilt} deg", fontsize=10)
    axes[-1].semilogy(EVERY * np.arange(len(energy)), np.array(energy) / energy[0], label=rf"$\theta$ = {tilt} deg")
for map in axes[:-2]:
    map.tick_params(labelbottom=False)
axes[-2].set(xlabel="$x$ ($D$), downslope")
figure.colorbar(grains, ax=axes[:-1], label="displacement ($D$)", aspect=40, pad=0.01)
axes[-1].set(xlabel="time since the push (s)", ylabel="kinetic energy\nover that of the push", xlim=(0, DURATION), ylim=(1e-10, 3))
axes[-1].legend(frameon=False)
figure.savefig("push.png", dpi=110)
