#!/usr/bin/python3
"""Tilts the same beds, with the same contact forces, by Talus and by the soft contacts of LAMMPS, and compares them.

    docs/studies/two_codes.py                          # everything: computes, measures, draws; repeat it after a stop
    docs/studies/two_codes.py compute --seeds 1-2      # fewer beds
    docs/studies/two_codes.py measure                  # writes the rows of these beds in the tables of docs/data
    docs/studies/two_codes.py means -o FILE.png        # draws these tables
    docs/studies/two_codes.py maps -o FILE.png         # draws a bed by both codes

Beds of 1200 grains are poured by Talus and brought to rest. From there the same bed is tilted to failure

  talus             by Talus,
  again             by Talus from its stored state, which is rounded to single precision,
  lammps-1e5        by LAMMPS with k_n = 1e5 m g/D, from the positions and the contact forces,
  lammps-1e6        the same with 1e6 m g/D,
  positions         by Talus from the positions alone,
  fine              the same with time steps of 0.1 ms instead of 1 ms,
  lammps-positions  by LAMMPS from the positions alone, 1e5 m g/D,
  rolling           by Talus from its stored state, with rolling friction from there on, mu_r = 0.05,
  lammps-rolling    the same by LAMMPS, from the positions and the contact forces, 1e5 m g/D.

All are measured by the code below, from positions and contact forces. Runs go to runs/campaign/two-codes. Complete ones are not
computed again; a stopped run of Talus is resumed, and one of LAMMPS begins again. Everything takes about four hours on one idle
core: a bed 0.2 minutes by Talus, and by LAMMPS 3 with 1e5 m g/D, 9 with 1e6, 10 with rolling friction. Needs Debian's lammps,
python3-h5py, python3-matplotlib and python3-numpy, and the package of build/release/python."""

import argparse
import csv
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import EllipseCollection

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "build/release/python"), str(ROOT / "docs")]
import talus  # noqa: E402
from quoted_numbers import rows_of, summary  # noqa: E402
from tables import REFERENCES, both_codes  # noqa: E402
from talus.lammps import Bed  # noqa: E402

BED = {"bed.length": 60, "bed.depth": 20, "tilt.rate": 2, "tilt.step": 0.002, "output.frame_every": 1}
#: Codes, and the largest seed of their beds; the angle of failure of a single bed is uncertain, so the means need many.
CODES = {"talus": 1000, "again": 1000, "lammps-1e5": 1000, "positions": 1000, "fine": 1000, "lammps-positions": 4, "rolling": 8,
         "lammps-rolling": 8, "lammps-1e6": 8}
NAMES = {"again": "Talus again", "lammps-1e5": r"LAMMPS, $k_n = 10^5\,mg/D$", "lammps-1e6": r"LAMMPS, $k_n = 10^6\,mg/D$"}
#: Minutes on one idle core for a bed, by code.
MINUTES = {"talus": 0.2, "again": 0.2, "lammps-1e5": 3, "rolling": 0.3, "lammps-rolling": 10, "lammps-1e6": 9, "positions": 0.2,
           "fine": 0.8, "lammps-positions": 3}
FLOW, DISTANCE = 0.02, 5.0  # sqrt(g D) and D: a flow of the surface layer, and how far it goes in a failure
FRICTION = 0.5              # mu
ROLLING_FRICTION = 0.05     # mu_r
LAYER = 2.0                 # D, depth of the layers in which forces are compared
L_MIN = 3.0                 # D, diameter of the neighbourhood of a grain in gamma
MAP_TILTS = 10, 15          # deg
FORCES = 0.01, 200          # m g, axes


# ---- Computing.


def talus_run(program, path, *words):
    """Computes a run, or what is left of it."""
    words = ["--resume", path] if Path(f"{path}.run").exists() else [*words, "-o", path]
    subprocess.run([program, "run", *map(str, words), "--threads", "1", "--quiet"], check=True)


def lammps_run(folder, run, stiffness, forces=True, rolling=False):
    """Writes a bed for LAMMPS and tilts it."""
    run.frame_at(0).to_lammps(folder, k_n=stiffness, forces=forces, overwrite=True)
    if rolling:
        script = folder / "in.slope"
        script.write_text(with_rolling(script.read_text()))
    subprocess.run(["lmp", "-in", "in.slope", "-screen", "none"], cwd=folder, check=True, env=os.environ | {"OMP_NUM_THREADS": "1"})


def with_rolling(script):
    """The script with LAMMPS's model "sds" of rolling: a spring and a dashpot, and a moment of mu_roll R_eff f_n at most, where R_eff =
    r_a r_b / (r_a + r_b). Talus has mu_r (r_a + r_b) f_n, which is the same with mu_roll = 4 mu_r for equal radii. Of the springs, which
    the step that stretches the tangential ones would roll as well, the first coefficient leaves nothing."""
    contacts = "pair_style granular\npair_coeff * * hooke ${{kn}} {0} tangential linear_history ${{kt}} 0.5 {1} rolling sds ${{kt}} {2} {3} " \
        "damping mass_velocity{4}\n"
    stretch = contacts.format(0, 1000, 0, 1e-12, "")
    tilt = contacts.format("${damping}", "${mu}", "$(2*v_zeta*sqrt(v_kt))", 4 * ROLLING_FRICTION, " limit_damping")
    old = re.compile(r"pair_style gran/hooke/history [^\n]*\npair_coeff \* \*\n")
    changed, count = old.subn(lambda _, each=iter((stretch, tilt)): next(each), script)
    if count != 2:
        raise ValueError("in.slope has other contacts than those that are to get rolling friction")
    return changed


def scenario_words(seed, settings):
    return [ROOT / "assets/scenarios/paper-pbc.toml", "--seed", seed, *(word for key in settings for word in ("--set", f"{key}={settings[key]}"))]


def compute(code, seed, runs, program):
    """Computes a bed by a code; that of Talus must be there for the others."""
    bed, path = path_of("talus", seed, runs), path_of(code, seed, runs)
    if code == "talus":
        talus_run(program, path, *scenario_words(seed, BED))
    elif code == "again":
        talus_run(program, path, "--branch", bed, "--at", "frame0")
    elif code == "rolling":
        talus_run(program, path, "--branch", bed, "--at", "frame0", "--set", f"contact.rolling_friction={ROLLING_FRICTION}")
    elif code in ("positions", "fine"):
        given = {"deposition.method": "file", "deposition.file": bed, "deposition.frame": 0}
        if code == "fine":
            given["tilt.step"] = BED["tilt.step"] / 10
        talus_run(program, path, *scenario_words(seed, BED | given))
    else:
        with talus.open(bed) as run:
            kind = code.removeprefix("lammps-")
            stiffness = 1e5 if kind in ("positions", "rolling") else float(kind)
            lammps_run(path, run, stiffness, kind != "positions", kind == "rolling")
    print(f"{code}, seed {seed}: done", flush=True)


# ---- Reading: lengths in D, forces in m g, m the mass of a disk of diameter D.


@dataclass
class State:
    """Grains and force-carrying contacts at one tilt."""

    tilt: float          # deg
    L: float
    free: np.ndarray
    r: np.ndarray
    x: np.ndarray
    y: np.ndarray
    unwrapped: np.ndarray  # x without jumps at the period
    a: np.ndarray        # contacts of grains a and b, with the force f_n n + f_t t on b, t = (-n_y, n_x)
    b: np.ndarray
    f_n: np.ndarray
    f_t: np.ndarray

    def __post_init__(self):
        dx, dy = self.x[self.b] - self.x[self.a], self.y[self.b] - self.y[self.a]
        dx -= self.L * np.round(dx / self.L)
        self.distance = np.hypot(dx, dy)
        self.n = np.stack([dx, dy], axis=1) / self.distance[:, None]
        self.t = np.stack([-self.n[:, 1], self.n[:, 0]], axis=1)


def of_talus(path):
    """The states of a run at whole degrees, and its flow: tilts (deg), velocities of the surface layer, sqrt(g D), and the step of time."""
    with talus.open(path) as run:
        states = {}
        for frame in run.frames:
            if abs(frame.tilt - round(frame.tilt)) < 1e-6:
                bed = Bed(frame)
                states[round(frame.tilt)] = State(frame.tilt, bed.L, bed.free, bed.r, bed.x, bed.y, bed.x + frame.image[:, 0] * bed.L,
                                                  bed.a, bed.b, bed.f_n, bed.f_t)
        time = run["observables/time"] * np.sqrt(run.gravity / run.D)
        velocity = np.diff(run["observables/surface_displacement"] / run.D) / np.diff(time)
        return states, (np.degrees(run["observables/tilt"])[1:], velocity, np.median(np.diff(time)))


def frames_of(path):
    """The frames of a dump: time step, length of the box along x, and the table of its rows."""
    for frame in path.read_text().split("ITEM: TIMESTEP\n")[1:]:
        lines = frame.split("\n")
        count = int(lines[2])
        yield int(lines[0]), float(lines[4].split()[1]), np.array(" ".join(lines[8:8 + count]).split(), float).reshape(count, -1)


def of_lammps(folder):
    """The same of a run of LAMMPS."""
    states = {}
    steps, tilts, velocity = np.loadtxt(folder / "slope.series")[:, :3].T
    degrees = (tilts[1] - tilts[0]) / (steps[1] - steps[0])  # in a time step
    for (step, L, grains), (_, _, pairs) in zip(frames_of(folder / "slope.grains"), frames_of(folder / "slope.contacts")):
        _, kind, x, y, r, _, unwrapped = grains.T[:7]
        a, b = pairs[:, :2].astype(int).T - 1
        state = State(step * degrees, L, kind == 1, r, x, y, unwrapped, a, b, 0, 0)
        f_n, f_t = -(pairs[:, 2:4] * state.n).sum(axis=1), -(pairs[:, 4:6] * state.t).sum(axis=1)
        carries = f_n > 1e-9
        states[round(state.tilt)] = State(state.tilt, L, state.free, r, x, y, unwrapped, a[carries], b[carries], f_n[carries], f_t[carries])
    rate = next(line for line in (folder / "in.slope").read_text().split("\n") if line.startswith("variable rate")).split()[3]
    return states, (tilts, velocity, (tilts[1] - tilts[0]) / float(rate))


# ---- Measuring.


def theta_c(tilt, velocity, dt):
    """The tilt at which the flow begins that carries the surface layer 5 D without a stop (docs/scenario.md); NaN without one."""
    moved = 0.0
    for k, v in enumerate(velocity):
        moved = moved + v * dt if v > FLOW else 0.0
        if moved >= DISTANCE:
            begin = k - np.argmax(velocity[k::-1] <= FLOW) + 1 if (velocity[:k] <= FLOW).any() else 0
            return tilt[begin]
    return np.nan


def moments(state):
    """The internal moments of the grains, (N, 2, 2), compression positive."""
    force = state.f_n[:, None] * state.n + state.f_t[:, None] * state.t
    half = (state.r[state.a] + state.r[state.b] - state.distance) / 2
    moment = np.zeros((len(state.x), 2, 2))
    for grain, sign in ((state.a, 1), (state.b, 1)):
        np.add.at(moment, grain, sign * (state.r[grain] - half)[:, None, None] * state.n[:, :, None] * force[:, None, :])
    return moment


def neighbourhood_gamma(state):
    """gamma of the neighbourhood of each free grain; NaN if the grain carries nothing."""
    free = np.flatnonzero(state.free)
    dx = state.x[free, None] - state.x[free]
    dx -= state.L * np.round(dx / state.L)
    near = dx**2 + (state.y[free, None] - state.y[free]) ** 2 <= (L_MIN / 2) ** 2
    gamma = talus.stress_ratio((near.astype(float) @ moments(state)[free].reshape(-1, 4)).reshape(-1, 2, 2))
    return np.where(np.isin(free, [state.a, state.b]), gamma, np.nan)


def volume(state, step=0.002):
    """The area below the upper envelope of the free grains, down to the floor plane."""
    count = round(state.L / step)
    height = np.zeros(count)
    for x, y, r in zip(state.x[state.free], state.y[state.free], state.r[state.free]):
        column = np.arange(int((x - r) / step), int((x + r) / step) + 2)
        offset = (column + 0.5) * state.L / count - x
        column, offset = column[abs(offset) < r] % count, offset[abs(offset) < r]
        height[column] = np.maximum(height[column], y + np.sqrt(r**2 - offset**2))
    return height.mean() * state.L


def measured(state, first, gamma_c):
    """The quantities of a state; `first` is that at the beginning of the tilt."""
    total = moments(state)[state.free].sum(axis=0)
    free, ends = state.free, [state.a, state.b]
    carrying = free & np.isin(np.arange(len(free)), ends)
    between = (free[state.a].astype(int) + free[state.b]).sum()
    major = 0.5 * np.arctan2(total[0, 1] + total[1, 0], total[0, 0] - total[1, 1])
    angle = 2 * (np.arctan2(state.n[:, 1], state.n[:, 0]) - major)
    a_c = 2 * np.cos(angle).mean()
    mobilised = abs(state.f_t) / (FRICTION * state.f_n)
    gamma = neighbourhood_gamma(state)
    moved = np.hypot(state.unwrapped - first.unwrapped, state.y - first.y)[free].mean()
    return {"Gamma": float(talus.stress_ratio(total)),
            "sigma_t/sigma_n": -total[1, 0] / total[1, 1],
            "sigma_xx/sigma_yy": total[0, 0] / total[1, 1],
            "p_o": (gamma[np.isfinite(gamma)] >= gamma_c).mean() if np.isfinite(gamma_c) else np.nan,
            "z": between / carrying.sum(),
            "phi": np.pi * (state.r[free] ** 2).sum() / volume(state),
            "a_c": a_c,
            "a_n": 2 * (state.f_n * np.cos(angle)).sum() / state.f_n.sum() - a_c,
            "a_t": -2 * (state.f_t * np.sin(angle)).sum() / state.f_n.sum(),
            "sliding": (mobilised > 0.999).mean(),
            "mobilised": mobilised.mean(),
            "weak": (state.f_n < 0.1 * state.f_n.mean()).mean(),
            "displacement": moved}


def common_contacts(state, other):
    """The indices of the contacts that both states have, in each."""
    def key(s):
        return np.minimum(s.a, s.b) * len(s.x) + np.maximum(s.a, s.b)

    _, i, j = np.intersect1d(key(state), key(other), return_indices=True)
    return i, j


def common_forces(state, other):
    """The normal forces of the contacts that both states have."""
    i, j = common_contacts(state, other)
    return state.f_n[i], other.f_n[j]


def agreement(state, other):
    """How many of the contacts of a state another has, and the correlation of their normal forces, each over the mean of the first state
    at that depth, without which the growth of all forces with the depth would be a correlation."""
    layer = (contact_heights(state) // LAYER).astype(int)
    means = np.bincount(layer, state.f_n) / np.maximum(np.bincount(layer), 1)
    i, j = common_contacts(state, other)
    return {"common": len(i) / len(state.a), "correlation": np.corrcoef(*(f / means[layer[i]] for f in (state.f_n[i], other.f_n[j])))[0, 1]}


def contact_heights(state):
    return np.maximum((state.y[state.a] + state.y[state.b]) / 2, 0)


def path_of(code, seed, runs):
    """The run of a bed by a code: a file of Talus, or a folder of LAMMPS."""
    return runs / (f"{code}-{seed}" if code.startswith("lammps") else f"{code}-{seed}.h5")


def is_done(code, seed, runs):
    path = path_of(code, seed, runs)
    return "Total wall time" in (path / "log.lammps").read_text() if (path / "log.lammps").exists() else path.is_file()


def measure(seeds, runs):
    """Returns rows for each bed and code, and for each of their states up to the failure of the first of both."""
    beds, states = [], []
    for seed in (s for s in seeds if is_done("talus", s, runs)):
        references = {}
        for code in (c for c in CODES if is_done(c, seed, runs)):
            path = path_of(code, seed, runs)
            found, flow = of_lammps(path) if path.is_dir() else of_talus(path)
            own = theta_c(*flow)
            references[code] = found, own
            beds.append({"seed": seed, "code": code, "theta_c (deg)": own, "version": version_of(path)})
            base = "rolling" if code == "rolling" else REFERENCES.get(code, "talus")  # has states beyond the failure of `talus`
            reference, angle = references.get(base, ({}, np.nan))
            for tilt in sorted(t for t in found.keys() & reference.keys() if not t > np.fmin(own, angle)):
                values = measured(found[tilt], found[min(found)], np.sin(np.radians(angle)))
                states.append({"seed": seed, "code": code, "tilt (deg)": tilt, **values, **agreement(reference[tilt], found[tilt])})
    return beds, states


def version_of(path):
    """The program that computed a run."""
    if path.is_dir():
        return (path / "log.lammps").read_text().split("\n", maxsplit=1)[0]
    with talus.open(path) as run:
        return f"Talus {run.provenance['version']} ({run.provenance['git_hash']})"


def write_rows(path, rows):
    """Writes a table, in which rows of other beds and codes remain."""
    def text(value):
        if isinstance(value, float | np.floating):
            return "" if np.isnan(value) else f"{value:.6g}"
        return str(value)

    made = {(str(row["seed"]), row["code"]) for row in rows}
    kept = [row for row in (rows_of(path) if path.exists() else []) if (row["seed"], row["code"]) not in made]
    rows = sorted(kept + rows, key=lambda row: (list(CODES).index(row["code"]), int(row["seed"])))
    columns = list(dict.fromkeys(key for row in rows for key in row))
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows([text(row.get(column, "")) for column in columns] for row in rows)


# ---- Drawing.


STYLES = {"talus": ("black", "o"), "again": ("0.6", "s"), "lammps-1e5": ("tab:red", "^"), "lammps-1e6": ("tab:blue", "v")}
PANELS = [("Gamma", r"stress ratio $\Gamma$"), ("p_o", r"overloaded fraction $p_o$"), ("z", "coordination number $z$"),
          ("a_c", "anisotropy of contacts $a_c$"), ("a_n", "anisotropy of normal forces $a_n$"),
          ("a_t", "anisotropy of tangential forces $a_t$"), ("displacement", "mean displacement ($D$)")]


def draw_means(path):
    """theta_c of single beds against that of Talus, and the means of quantities against the tilt, from the tables."""
    figure, axes = plt.subplots(2, 4, figsize=(14, 6.4), layout="constrained")
    first, *others = axes.flat
    angles = {code: both_codes(code, "theta_c") for code in NAMES}
    known = [angle for both in angles.values() for values in both for angle in values]
    ends = [min(known) - 1, max(known) + 1]
    first.plot(ends, ends, color="0.7", linewidth=0.8)
    for code, label in NAMES.items():
        if angles[code][0]:
            first.plot(*angles[code], STYLES[code][1], color=STYLES[code][0], markersize=5, label=label)
    first.set(xlabel=r"$\theta_c$ by Talus (deg)", ylabel=r"$\theta_c$ of the same bed (deg)", xlim=ends, ylim=ends, aspect="equal")
    first.legend(frameon=False, fontsize=8)
    for panel, (name, label) in zip(others, PANELS):
        both = {tilt: both_codes("lammps-1e5", f"{name}@{tilt}") for tilt in range(91)}
        most = max(len(own) for own, _ in both.values())
        both = {tilt: values for tilt, values in both.items() if len(values[0]) == most}  # before the first of the beds has failed
        again = {tilt: both_codes("again", f"{name}@{tilt}")[1] for tilt in both}
        for code, series in (("again", again.values()), ("talus", (own for own, _ in both.values())), ("lammps-1e5", (other for _, other in both.values()))):
            means = [summary(values) for values in series]
            tilt, mean, spread = list(both), [each["mean"] for each in means], [each["error"] for each in means]
            panel.errorbar(tilt, mean, spread, fmt=STYLES[code][1] + "-", color=STYLES[code][0], markersize=3.5, linewidth=0.8, capsize=2,
                           label=NAMES.get(code, "Talus"))
        panel.set(xlabel=r"tilt $\theta$ (deg)", ylabel=label)
    others[-1].set_yscale("log")
    others[0].legend(frameon=False, fontsize=8)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def draw_maps(path, seed, runs):
    """gamma of the neighbourhoods in the same bed by both codes at 10 deg, and the normal forces of the same contacts there and at 15 deg."""
    own, other = of_talus(path_of("talus", seed, runs))[0], of_lammps(path_of("lammps-1e5", seed, runs))[0]
    figure = plt.figure(figsize=(10, 6.2), layout="constrained")
    grid = figure.add_gridspec(2, 2, width_ratios=[2.6, 1])
    maps = []
    for k, (states, name) in enumerate(((own, "Talus"), (other, NAMES["lammps-1e5"]))):
        axes, state = figure.add_subplot(grid[k, 0]), states[MAP_TILTS[0]]
        size, centres = np.tile(2 * state.r[state.free], 3), np.stack([state.x, state.y], axis=1)[state.free]
        images = np.concatenate([centres + (shift * state.L, 0) for shift in (-1, 0, 1)])  # grains at an edge are drawn at both
        grains = EllipseCollection(size, size, 0 * size, units="xy", offsets=images, offset_transform=axes.transData,
                                   array=np.tile(neighbourhood_gamma(state), 3), cmap="Greys", clim=(0, 0.8), edgecolor="0.4",
                                   linewidth=0.3)
        axes.add_collection(grains)
        axes.set(aspect="equal", xlim=(0, state.L), ylim=(-0.5, state.y.max() + 1), ylabel="$y$ ($D$)")
        axes.set_title(rf"{name}, $\theta$ = {MAP_TILTS[0]} deg", fontsize=10)
        maps.append(axes)
    maps[-1].set_xlabel("$x$ ($D$)")
    figure.colorbar(grains, ax=maps, label=r"$\gamma$ of neighbourhoods 3 $D$ wide", location="bottom", aspect=40, shrink=0.5, pad=0.02)
    for k, tilt in enumerate(MAP_TILTS):
        axes, forces = figure.add_subplot(grid[k, 1]), common_forces(own[tilt], other[tilt])
        axes.loglog(*forces, ".", color="black", markersize=2)
        axes.plot(FORCES, FORCES, color="0.6", linewidth=0.8)
        axes.set(xlim=FORCES, ylim=FORCES, aspect="equal", xlabel="$f_n$ by Talus ($m g$)", ylabel="$f_n$ by LAMMPS ($m g$)")
        axes.set_title(f"{len(forces[0])} common contacts, {tilt} deg", fontsize=10)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def seeds_in(text):
    """The seeds of "1-16" or "1-3,8"."""
    ranges = [part.split("-") for part in text.split(",")]
    return [seed for part in ranges for seed in range(int(part[0]), int(part[-1]) + 1)]


def compute_all(seeds, codes, jobs, runs, program):
    """Computes what is missing; the beds of all codes begin with those of Talus."""
    runs.mkdir(parents=True, exist_ok=True)
    for code in ["talus"] + [code for code in CODES if code in codes and code != "talus"]:
        left = [seed for seed in seeds if seed <= CODES[code] and not is_done(code, seed, runs)]
        hours = MINUTES[code] * len(left) / jobs / 60
        print(f"{code}: {len(left)} beds to compute, about {hours:.1f} hours on an idle machine", flush=True)
        with ThreadPoolExecutor(jobs) as pool:
            list(pool.map(lambda seed, code=code: compute(code, seed, runs, program), left))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("part", nargs="?", choices=["compute", "measure", "means", "maps"], help="one part [all]")
    parser.add_argument("--seeds", default="1-16", help="beds, e.g. 1-16 or 1-3,8 [%(default)s]")
    parser.add_argument("--codes", nargs="+", default=list(CODES), choices=list(CODES), metavar="CODE", help="codes besides talus [all]")
    parser.add_argument("--jobs", type=int, default=1, help="runs at a time, each on one core [%(default)s]")
    parser.add_argument("--runs", type=Path, default=ROOT / "runs/campaign/two-codes", help="folder of the runs")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", help="picture of the part means or maps")
    parser.add_argument("--talus", default=os.environ.get("TALUS_PROGRAM", str(ROOT / "build/release/talus")))
    arguments = parser.parse_args()
    part, seeds, runs = arguments.part, seeds_in(arguments.seeds), arguments.runs.resolve()
    if part in (None, "compute"):
        compute_all(seeds, arguments.codes, arguments.jobs, runs, arguments.talus)
    if part in (None, "measure"):
        beds, states = measure(seeds, runs)
        write_rows(ROOT / "docs/data/two-codes-beds.csv", beds)
        write_rows(ROOT / "docs/data/two-codes-states.csv", states)
    if part in (None, "means"):
        draw_means(arguments.output or ROOT / "docs/images/two-codes.png")
    if part in (None, "maps"):
        draw_maps(arguments.output or ROOT / "docs/images/two-codes-maps.png", seeds[0], runs)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit("two_codes.py: stopped; repeat the command to continue")
    except (OSError, ValueError, subprocess.CalledProcessError) as failed:
        sys.exit(f"two_codes.py: error: {failed}")
