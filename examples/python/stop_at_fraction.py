"""Tilts a bed until half of its grains are overloaded, holds it there for three seconds, and draws it. The run is recorded.

usage: python3 stop_at_fraction.py [SCENARIO.toml] [KEY=VALUE...]      e.g. bed.length=30 seed=2"""

import sys
import tomllib

import matplotlib.pyplot as plt
import numpy as np
import talus

BED = {"bed.length": 50, "bed.depth": 16, "tilt.rate": 2, "tilt.step": 0.004}
HOLD = 3.0  # s

words = sys.argv[1:]
scenario = words.pop(0) if words and "=" not in words[0] else BED
sim = talus.Simulation(scenario, **tomllib.loads("\n".join(words)))
sim.record("held.h5", overwrite=True)
sim.deposit()

tilted = [(sim.tilt, sim["overloaded/fraction"])]
while not sim.done and sim["overloaded/fraction"] < 0.5:
    sim.tilt_by(0.25)
    tilted.append((sim.tilt, sim["overloaded/fraction"]))

held = []


def measure():
    velocity = sim.grains.velocity[sim.grains.free]
    rms = np.sqrt((velocity**2).sum(axis=1).mean())
    held.append((sim.time, sim["overloaded/fraction"], rms / np.sqrt(sim.gravity * sim.D)))


if not sim.done:
    sim.tilt_rate = 0
    sim.run(HOLD, until=measure, every=0.02)  # measure() returns None, so it does not end the run
measure()
time, overloaded, speed = np.transpose(held)

figure, axes = plt.subplot_mosaic([["tilt", "hold"], ["map", "map"]], figsize=(8, 5.6), height_ratios=[1, 1.1], layout="constrained")
axes["tilt"].plot(*np.transpose(tilted), color="tab:red")
axes["tilt"].axhline(0.5, color="0.6", linewidth=0.8, linestyle="--")
axes["tilt"].set(xlabel=r"tilt $\theta$ (deg)", ylabel=r"overloaded grains $p_o$ ($\gamma \geq \sin 20°$)", xlim=(0, None), ylim=(0, 0.6))
axes["hold"].semilogy(time - time[0], speed, color="black")
axes["hold"].set(xlabel="time since the tilt was held (s)", ylabel=r"rms velocity ($\sqrt{gD}$)", xlim=(0, HOLD))
axes["map"].imshow(sim.draw("clusters", width=1600, bare=True))
axes["map"].set_title(rf"clusters of overloaded grains at $\theta$ = {sim.tilt:.2f} deg", fontsize=10)
axes["map"].axis("off")
figure.savefig("held.png", dpi=110)
print(f"{sim.tilt:.2f} deg: {100 * overloaded[-1]:.0f} % of the grains are overloaded; state {sim.state_hash}")
