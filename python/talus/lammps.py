"""Input of LAMMPS that continues the bed of a frame with its contact forces."""

import math
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from talus.errors import WrongValue, check_flag, error_of_code, short
from talus.page import visible, write_text
from talus.simulation import _extension, _number, _path

if TYPE_CHECKING:
    from talus.frame import Frame
    from talus.run import Run

#: Time steps in the duration of a contact of the two lightest grains, with the stiffer of both springs.
STEPS_IN_CONTACT = 30
#: Surfaces of grains that come closer than this, in D, are watched while grains are moved.
NEAR = 0.1
#: Overlaps are those of the forces up to this share of the mean overlap.
TOLERANCE = 1e-3
#: Depth of the surface layer whose flow is failure, in D.
SURFACE_LAYER = 3.0

SCRIPT = """\
# {title}
# Units: the mean diameter D = 1, gravity g = 1, the mass m of a disk of diameter D = 1; hence times in sqrt(D/g), forces in m g.
# x points downslope, y away from the floor. `lmp -in in.slope` relaxes the bed and tilts it until its surface has slid 7 D;
# -var NAME VALUE changes these:
variable rate index {rate:.8g}          # deg per sqrt(D/g)
variable end index 90                 # deg, if the slope has not failed before
variable relax index 20               # sqrt(D/g) at rest, before the tilt
variable grow index {grow}                 # sqrt(D/g) of these in which gravity grows to its value
variable every index 1                # deg between two frames in slope.grains and slope.contacts
variable zeta index 1                 # damping of a contact over the critical one, for two disks of diameter D

variable kn equal {k_n:.8g}            # m g/D; the overlaps of slope.data are those of this stiffness
variable kt equal {k_t:.8g}
variable mu equal {friction:.8g}
variable begin equal {tilt:.8g}        # deg
variable n equal ceil(0.01/v_rate/{step:.8g})   # time steps per 0.01 deg

units lj
dimension 2
atom_style sphere
atom_modify map array
comm_modify vel yes
newton off
boundary p f p
read_data slope.data
group free type 1
group floor type 2
set group all density/disc $(4.0/PI)
neighbor 0.12 bin
neigh_modify every 10 delay 0 check yes exclude group floor floor

# The tangential springs. The velocities of slope.data stretch them in one step of length 1, in which nothing moves and
# friction is too large to matter; then all is at rest.
pair_style gran/hooke/history ${{kn}} ${{kt}} 0 NULL 1000 1
pair_coeff * *
timestep 1
run 1
velocity all set 0 0 0
set group all omega 0 0 0
variable damping equal 2*v_zeta*sqrt(v_kn/0.5)
pair_style gran/hooke/history ${{kn}} ${{kt}} ${{damping}} NULL ${{mu}} 1 limit_damping
pair_coeff * *

# Rest.
variable dt equal 0.01/v_rate/v_n
timestep ${{dt}}
reset_timestep 0
fix move free nve/sphere disc
compute kt free ke
compute sphere free erotate/sphere     # with the moment of inertia of spheres, 2/5 m r^2, not that of disks
variable kr equal 1.25*c_sphere
variable tilt equal v_begin
variable gx equal sin(v_tilt*PI/180)
variable gy equal -cos(v_tilt*PI/180)
variable g equal (v_grow>0)*(step*dt<v_grow)*step*dt/(v_grow+1e-9)+(step*dt>=v_grow)
fix gravity all gravity v_g vector v_gx v_gy 0
fix hold floor freeze
variable resting equal round(v_relax/v_dt)
thermo_style custom step v_tilt c_kt v_kr cpu
thermo_modify norm no
thermo $(ceil(v_resting/10))
run ${{resting}}

# The tilt. The surface layer is that of Talus, the grains above its lower edge at the time.
reset_timestep 0
unfix gravity
unfix hold
variable tilt equal v_begin+0.01*step/v_n
fix gravity all gravity 1 vector v_gx v_gy 0
fix hold floor freeze
region layer block INF INF {edge:.8g} INF INF INF units box
group layer region layer
group surface intersect layer free
compute moved free displace/atom
compute surface surface reduce ave c_moved[1]
compute flow free reduce/region layer ave vx
variable tenth equal ceil(v_n/10)
fix series all ave/time ${{tenth}} 10 $(10*v_tenth) v_tilt c_flow c_surface c_kt v_kr file slope.series
variable surface equal c_surface
fix stop all halt $(10*v_n) v_surface > 7 error continue message no
# Rows of slope.contacts: two grains, and the normal and the tangential force on the first, along x and y.
compute pairs all property/local patom1 patom2 cutoff radius
compute forces all pair/local fx fy p1 p2 cutoff radius
variable frame equal round(100*v_every)*v_n
dump grains all custom ${{frame}} slope.grains id type x y radius mass xu yu vx vy omegaz
dump_modify grains sort id format float %.12g
dump contacts all local ${{frame}} slope.contacts c_pairs[1] c_pairs[2] c_forces[1] c_forces[2] c_forces[3] c_forces[4]
dump_modify contacts format float %.10g
thermo_style custom step v_tilt c_kt c_flow c_surface cpu
thermo_modify norm no
thermo $(100*v_n)
run $(round(100*(v_end-v_begin))*v_n)
"""


class Bed:
    """Grains and contacts of a frame, in units of D, g, and the mass m of a disk of diameter D."""

    def __init__(self, frame: "Frame") -> None:
        run, contacts = frame.run, frame.contacts
        D = run.D if run.units == "SI" else 1.0
        weight = run.mass[0] / (2 * run.radius[0] / D) ** 2 * run.gravity
        self.L, self.free, self.r = run.length / D, run.free, run.radius / D
        self.x, self.y = (frame.position / D).T
        self.a, self.b = contacts.pair.T
        self.f_n, self.f_t = contacts.force.T / weight

    def normals(self, a: np.ndarray, b: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Returns the unit normals (x, y) of pairs, from a to b, and their overlaps, negative for gaps."""
        dx, dy = self.x[b] - self.x[a], self.y[b] - self.y[a]
        dx -= self.L * np.round(dx / self.L)
        d = np.hypot(dx, dy)
        return dx / d, dy / d, self.r[a] + self.r[b] - d

    def near(self) -> tuple[np.ndarray, np.ndarray]:
        """Returns the pairs of grains without a force whose surfaces are close, except those of two of the floor."""
        order = np.argsort(self.y)
        reach = np.searchsorted(self.y[order], self.y[order] + 2 * self.r.max() + NEAR, side="right")
        a = np.repeat(order, reach - np.arange(len(order)) - 1)
        b = np.concatenate([order[k + 1:end] for k, end in enumerate(reach)])
        a, b = np.minimum(a, b), np.maximum(a, b)
        loaded = np.isin(a * len(order) + b, self.a * len(order) + self.b)
        close = ~loaded & (self.free[a] | self.free[b]) & (self.normals(a, b)[2] > -NEAR)
        return a[close], b[close]


def least_change(rows: np.ndarray, columns: np.ndarray, values: np.ndarray, goal: np.ndarray, count: int) -> np.ndarray:
    """Returns the smallest u, of `count` numbers, with sum of values * u[columns] over each row = goal, by conjugate
    gradients; the nearest to the goal if there is none."""
    u, left = np.zeros(count), goal
    gradient = direction = np.bincount(columns, values * left[rows], count)
    size = first = gradient @ gradient
    for _ in range(10 * count):
        if not size > 1e-24 * first:
            break
        change = np.bincount(rows, values * direction[columns], len(goal))
        step = size / (change @ change)
        u, left = u + step * direction, left - step * change
        gradient = np.bincount(columns, values * left[rows], count)
        size, before = gradient @ gradient, size
        direction = gradient + size / before * direction
    return u


def overlap(bed: Bed, k_n: float) -> bool:
    """Changes centres and radii as little as possible until contacts overlap by f_n / k_n and no other grains do. Returns
    whether that was possible. If only centres moved, the bed would sink by the sum of the overlaps over its depth, and
    other grains would come into contact."""
    near_a, near_b = bed.near()
    held, count = np.zeros(len(near_a), bool), len(bed.x)
    tolerance = TOLERANCE * bed.f_n.mean() / k_n
    for _ in range(20):
        a, b = np.append(bed.a, near_a[held]), np.append(bed.b, near_b[held])
        nx, ny, present = bed.normals(a, b)
        goal = np.append(bed.f_n / k_n, np.zeros(held.sum())) - present
        if np.abs(goal[:len(bed.a)]).max() < tolerance and bed.normals(*bed.near())[2].max(initial=-1) < tolerance:
            return True
        rows = np.tile(np.arange(len(a)), 6)
        columns = np.concatenate([a, b, count + a, count + b, 2 * count + a, 2 * count + b])
        values = np.concatenate([nx, -nx, ny, -ny, np.ones(2 * len(a))]) * np.append(np.tile(bed.free, 2), np.ones(count))[columns]
        x, y, r = least_change(rows, columns, values, goal, 3 * count).reshape(3, count)
        bed.x, bed.y, bed.r = bed.x + x, bed.y + y, bed.r + r
        held |= bed.normals(near_a, near_b)[2] > 0
    return False


def stretching(bed: Bed, k_t: float) -> np.ndarray:
    """Returns velocities (v_x, v_y, omega) of all grains, (3, N), that stretch the tangential springs by f_t / k_t within
    unit time."""
    nx, ny, _ = bed.normals(bed.a, bed.b)
    count, a, b = len(bed.x), bed.a, bed.b
    rows = np.tile(np.arange(len(a)), 6)  # of v_a - v_b along t = (-n_y, n_x), and of r omega of both
    columns = np.concatenate([a, b, count + a, count + b, 2 * count + a, 2 * count + b])
    values = np.concatenate([-ny, ny, nx, -nx, np.ones(2 * len(a))])
    moved = least_change(rows, columns, values, bed.f_t / k_t, 3 * count).reshape(3, count)
    moved[2] /= bed.r
    return moved


def stiffness(value: Any, what: str) -> float:
    """Returns a stiffness as a float. Raises WrongValue if it is not above 0."""
    number = _number(value, what)
    if not (0 < number < math.inf):
        raise WrongValue(f"{what}={short(value)}: expected a number above 0, in m g/D")
    return number


def outputs(folder: str, overwrite: bool, run: "Run") -> list[str]:
    """Returns the paths of slope.data and in.slope. Raises FailedFile if one exists and is not to be replaced, or cannot be."""
    paths = [os.path.join(folder, name) for name in ("slope.data", "in.slope")]
    for path in paths:
        if os.path.lexists(path) and not overwrite:
            raise error_of_code(73, f"{path}: exists already; replace a file with overwrite=True")
        _extension()._output_target(_path(path), True, [_path(run.storage.absolute)])
    return paths


def title_of(frame: "Frame") -> str:
    """Returns a line about the frame for the head of a file. In the name of the run it has no quotation marks: three of them
    begin a text of several lines, for LAMMPS even in a comment."""
    name = visible(os.path.basename(frame.run.path)).replace("\n", "\\x0a").replace('"', "'")
    return f"Frame {frame.index} of {name}, at {frame.tilt:.8g} deg"


def write(frame: "Frame", folder: Any, k_n: Any, k_t: Any, forces: Any, overwrite: Any) -> None:
    """Writes slope.data and in.slope; see Frame.to_lammps."""
    run, k_n = frame.run, stiffness(k_n, "k_n")
    k_t = k_n / 2 if k_t is None else stiffness(k_t, "k_t")
    forces, place = check_flag(forces, "forces"), os.fsdecode(_path(folder))
    data_path, script_path = outputs(place, check_flag(overwrite, "overwrite"), run)
    if not run.periodic or (frame.contacts.pair >= len(run.radius)).any() or run.resists_rolling:
        raise WrongValue(f"{run.path}: to_lammps() writes periodic beds on a rough floor without rolling friction; this bed has "
                         f"{'side walls' if not run.periodic else 'rolling friction' if run.resists_rolling else 'a smooth floor'}")
    bed = Bed(frame)
    edge = frame["packing/volume"] / (bed.L * run.D**2) - SURFACE_LAYER
    velocity = np.zeros((3, len(bed.x)))
    if forces:
        if not overlap(bed, k_n):
            raise WrongValue(f"k_n={k_n:g}: found no positions near those of the frame in which contacts overlap by f_n / k_n; use "
                             f"k_n={10 * k_n:g}, or forces=False")
        velocity = stretching(bed, k_t)
    lightest = (2 * bed.r[bed.free].min()) ** 2
    title = title_of(frame)
    script = SCRIPT.format(
        title=title, rate=run.scenario["tilt"]["rate"] * math.sqrt(run.D / run.gravity), grow=0 if forces else 10, k_n=k_n, k_t=k_t,
        friction=run.friction_of(frame.index, after=True), tilt=frame.tilt,
        step=math.pi * math.sqrt(lightest / 2 / max(k_n, k_t)) / STEPS_IN_CONTACT, edge=edge)
    lines = [title, "", f"{len(bed.x)} atoms", "2 atom types", "", f"0 {bed.L:.17g} xlo xhi",
             f"{bed.y.min() - 1:.8g} {bed.y.max() + 40:.8g} ylo yhi", "-0.5 0.5 zlo zhi", "", "Atoms # sphere", ""]
    lines += [f"{i + 1} {kind} {2 * r:.17g} 1 {x:.17g} {y:.17g} 0"
              for i, (kind, r, x, y) in enumerate(zip(np.where(bed.free, 1, 2), bed.r, bed.x % bed.L, bed.y))]
    lines += ["", "Velocities", ""]
    lines += [f"{i + 1} {v_x:.17g} {v_y:.17g} 0 0 0 {omega:.17g}" for i, (v_x, v_y, omega) in enumerate(velocity.T)]
    _extension()._prepare_folder(_path(place))
    try:
        write_text(Path(data_path), "\n".join(lines) + "\n")
        write_text(Path(script_path), script)
    except OSError as error:
        raise error_of_code(74, f"{place}: slope.data and in.slope cannot be written: {error.strerror}") from None
