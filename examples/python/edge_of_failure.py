"""Holds a slope at the edge of failure: friction decreases while the bed is quiet, and increases while it slips.

usage: python3 edge_of_failure.py [KEY=VALUE...]      e.g. bed.length=30 seed=2"""

import sys
import tomllib

import matplotlib.pyplot as plt
import numpy as np
import talus

BED = {"bed.length": 40, "bed.depth": 15, "tilt.rate": 4, "tilt.step": 0.008}
TILT = 14.0       # deg
EVERY = 0.02      # s between two decisions of the controller
DECAY = 0.10      # 1/s, relative rate at which friction falls while the bed is quiet
GROWTH = 1.5      # 1/s, relative rate at which friction rises while the bed slips
QUIET = 2e-3      # rms velocity, sqrt(g D), below which the bed is quiet
DURATION = 25.0   # s

sim = talus.Simulation(BED, **tomllib.loads("\n".join(sys.argv[1:])))
sim.tilt_to(TILT)
sim.tilt_rate = 0
begin, history = sim.time, []

while not sim.done and sim.time - begin < DURATION:
    rms = np.sqrt((sim.grains.velocity[sim.grains.free] ** 2).sum(axis=1).mean()) / np.sqrt(sim.gravity * sim.D)
    sim.friction *= 1 + EVERY * (GROWTH if rms > QUIET else -DECAY)
    history.append((sim.time - begin, sim.friction, rms))
    sim.run(EVERY)
time, friction, rms = np.array(history).T

figure, (top, bottom) = plt.subplots(2, sharex=True, figsize=(8, 4.6), layout="constrained")
top.plot(time, friction, color="tab:blue")
top.axhline(np.tan(np.radians(sim.tilt)), color="0.6", linewidth=0.8, linestyle="--")
top.text(0, np.tan(np.radians(sim.tilt)), r" $\tan\theta$", color="0.4", va="bottom")
top.set(ylabel=r"friction between grains $\mu$")
top.set_title(rf"tilt held at $\theta$ = {sim.tilt:.1f} deg", fontsize=10)
bottom.semilogy(time, rms, color="black", linewidth=0.7)
bottom.axhline(QUIET, color="tab:red", linewidth=0.8, linestyle="--", label=r"$\mu$ increases above this line, and decreases below it")
bottom.set(xlabel="time since the tilt was held (s)", ylabel=r"rms velocity ($\sqrt{gD}$)", xlim=(0, time[-1]),
           ylim=(1e-6, 0.2))
bottom.legend(loc="upper left", frameon=False, fontsize=9)
figure.savefig("edge-of-failure.png", dpi=110)
late = friction[time > DURATION / 2]
print(f"The slope of {sim.tilt:.1f} deg {'failed' if sim.done else 'stands'}; friction {late.mean():.3f} +- {late.std():.3f}")
