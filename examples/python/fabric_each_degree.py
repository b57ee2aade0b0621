"""Measures a quantity that Talus does not provide, at each degree of the tilt: the orientation of strong and weak contacts.

The fabric tensor of a set of contacts is the mean of n n over their normals n. Its anisotropy is twice the difference of its
principal values, and its direction is that of the larger one. Contacts that carry more than the mean force are strong.

usage: python3 fabric_each_degree.py [KEY=VALUE...]      e.g. bed.length=30 seed=2"""

import sys
import tomllib

import matplotlib.pyplot as plt
import numpy as np
import talus

BED = {"bed.length": 60, "bed.depth": 20, "tilt.rate": 4, "tilt.step": 0.008}


def normals():
    """Returns the normals of strong and of weak contacts."""
    force = sim.contacts.force[:, 0]
    mean = force[force > 0].mean()
    return sim.contacts.normal[force > mean], sim.contacts.normal[(force > 0) & (force <= mean)]


def fabric(normal):
    """Returns anisotropy and principal direction in deg, counter-clockwise from the x axis, which points downslope."""
    values, axes = np.linalg.eigh(normal.T @ normal / len(normal))
    return 2 * (values[1] - values[0]), np.degrees(np.arctan2(axes[1, 1], axes[0, 1])) % 180


sim = talus.Simulation(BED, **tomllib.loads("\n".join(sys.argv[1:])))
sim.deposit()
measured = []
while not sim.done:
    measured.append((sim.tilt, *normals()))
    sim.tilt_by(1)
tilt, strong, weak = zip(*(row for row in measured if row[0] <= sim.theta_c))  # the slope flows after theta_c

figure = plt.figure(figsize=(8, 4), layout="constrained")
figure.get_layout_engine().set(rect=(0, 0.03, 1, 0.94))  # room for labels and legend of the polar axes
grid = figure.add_gridspec(2, 2, width_ratios=[1.25, 1])
top, bottom = (figure.add_subplot(place) for place in (grid[0, 0], grid[1, 0]))
polar = figure.add_subplot(grid[:, 1], projection="polar")
top.plot(tilt, [fabric(normal)[0] for normal in strong], "o-", color="tab:red", markersize=4, label="strong contacts")
top.plot(tilt, [fabric(normal)[0] for normal in weak], "s-", color="0.6", markersize=4, label="weak contacts")
top.set(ylabel="anisotropy", ylim=(0, None), xticklabels=[])
top.legend(frameon=False)
bottom.plot(tilt, [fabric(normal)[1] for normal in strong], "o-", color="tab:red", markersize=4)
bottom.plot(tilt, 90 + np.array(tilt), "k:", linewidth=1, label="the vertical")
bottom.set(xlabel=r"tilt $\theta$ (deg)", ylabel="direction (deg)", ylim=(60, 150), yticks=range(60, 151, 30))
bottom.legend(frameon=False, loc="lower right")
edges = np.radians(np.arange(0, 181, 10))
for k, colour in [(0, "black"), (-1, "tab:red")]:
    angle = np.arctan2(strong[k][:, 1], strong[k][:, 0]) % np.pi
    density, _ = np.histogram(angle, edges, density=True)
    around = np.radians(np.arange(5, 366, 10))  # a normal and its opposite are one direction
    polar.plot(around, np.append(np.tile(density, 2), density[0]), color=colour, label=rf"$\theta$ = {tilt[k]:.0f} deg")
polar.set(ylim=(0, None), yticks=[0.2, 0.4])
polar.set_rlabel_position(22)
polar.legend(title="strong contacts per direction (1/rad)", loc="upper center", bbox_to_anchor=(0.5, -0.1), ncol=2, frameon=False)
figure.savefig("fabric-each-degree.png", dpi=110)
print(f"Anisotropy of strong contacts: {fabric(strong[0])[0]:.2f} on the flat bed, {fabric(strong[-1])[0]:.2f} at {tilt[-1]:.0f} deg")
