"""Tilts a bed until half of its grains are overloaded, holds the tilt there, and watches the bed come to rest.

usage: python3 stop_at_overloaded.py [KEY=VALUE...]      such as bed.length=30 seed=2"""

import sys
import tomllib

import matplotlib.pyplot as plt
import numpy as np
import talus

BED = {"bed.length": 50, "bed.depth": 16, "tilt.rate": 2, "tilt.step": 0.004}
WANTED = 0.5  # the share of overloaded grains at which the tilt stops
HOLD = 2.0    # s

sim = talus.Simulation(BED, **tomllib.loads("\n".join(sys.argv[1:])))
sim.deposit()
begin, history = sim.time, []


def measure():
    velocity = sim.grains.velocity[sim.grains.free]
    rms = np.sqrt((velocity**2).sum(axis=1).mean())
    history.append((sim.time - begin, sim.tilt, sim["overloaded/fraction"], rms / np.sqrt(sim.gravity * sim.D)))


measure()
while not sim.done and sim["overloaded/fraction"] < WANTED:
    sim.tilt_by(0.1)
    measure()
held = sim.time - begin
sim.tilt_rate = 0
while not sim.done and sim.time - begin < held + HOLD:
    sim.run(0.05)
    measure()
time, tilt, overloaded, speed = np.array(history).T

figure, axes = plt.subplot_mosaic([["share", "speed"], ["map", "map"]], figsize=(8, 5.6), height_ratios=[1, 1.1],
                                  layout="constrained")
axes["share"].plot(time, overloaded, color="tab:red")
axes["share"].axhline(WANTED, color="0.6", linewidth=0.8, linestyle="--")
axes["share"].set(ylabel=r"overloaded grains $p_o$ ($\gamma \geq \sin 20°$)", ylim=(0, 0.6))
axes["speed"].semilogy(time, speed, color="black", linewidth=0.9)
axes["speed"].set(ylabel=r"rms velocity ($\sqrt{gD}$)")
for name in ("share", "speed"):
    axes[name].axvspan(held, time[-1], color="0.92", zorder=0)
    axes[name].set(xlabel="time since the tilt began (s)", xlim=(0, time[-1]))
axes["share"].text(held, 0.02, " held", color="0.4")
axes["map"].imshow(sim.draw("clusters", width=1600, bare=True))
axes["map"].set_title(rf"clusters of overloaded grains at $\theta$ = {sim.tilt:.1f} deg", fontsize=10)
axes["map"].axis("off")
figure.savefig("stop-at-overloaded.png", dpi=110)
print(f"p_o reached {overloaded[time <= held][-1]:.2f} at {sim.tilt:.2f} deg; after {HOLD:g} s there it is {overloaded[-1]:.2f}")
