#include "core/observables.h"

namespace talus {

const std::array<SeriesField, observable_count> observable_fields = {{
    {"step", "1", "steps taken since the beginning of the run, deposition included"},
    {"time", "s", "simulated time since the beginning of the run"},
    {"tilt", "rad", "angle of the bed to the horizontal, theta"},
    {"sigma_n", "Pa",
     "packing stress across the bed, <sigma_yy> = sum of M_yy over the free grains / volume; compression "
     "positive"},
    {"sigma_t", "Pa",
     "packing shear stress along the bed, <sigma_yx> = minus the sum of M_yx over the free grains / volume "
     "(the axis y of the paper points into the bed); positive when gravity pulls towards +x"},
    {"sigma_t_over_n", "1",
     "sigma_t / sigma_n; tan(theta) for a periodic bed in equilibrium (paper, Eq. 10)"},
    {"stress_ratio", "1",
     "Gamma = Q/P of the packing (paper, Eq. 7); at least sin(theta) for a periodic bed in equilibrium "
     "without rolling friction, equal to it in the paper's Eq. 11"},
    {"solid_fraction", "1", "area of the free grains over the area below the free surface"},
    {"coordination_number", "1",
     "z: force-carrying contacts per free grain that carries force, twice the contacts between free grains "
     "plus those with floor and walls"},
    {"critical_fraction", "1", "share of the force-carrying contacts whose friction is fully mobilised"},
    {"volume_strain", "1",
     "(V - V0)/V0 with V below the free surface and V0 at the start of the tilt; negative = contraction"},
    {"centre_of_mass_strain", "1",
     "(y - y0)/y0 of the centre of mass above the floor plane, a quieter estimate of the volume strain"},
    {"surface_displacement", "m",
     "mean displacement along x of the surface layer since the start of the tilt"},
    {"kinetic_energy", "J/m",
     "translational and rotational kinetic energy of the free grains, per metre of thickness"},
    {"rms_velocity", "m/s", "root mean square velocity of the free grains, rim velocity included"},
    {"largest_overlap", "m", "largest overlap of two bodies at the midpoint of the step; 0 without overlaps"},
    {"residual", "1", "largest natural-map residual eta of the steps since the last row"},
    {"at_rest", "1",
     "1 if the rms velocity stayed below deposition.rest_velocity g h for the last 50 steps, else 0"},
}};

const std::array<SeriesField, step_field_count> step_fields = {{
    {"step", "1", "steps taken since the beginning of the run"},
    {"phase", "1", "0 deposition and relaxation, 1 tilt, 3 flow after failure"},
    {"contacts", "1", "contacts and near contacts in the problem of the step"},
    {"iterations", "1", "iterations of the solver"},
    {"residual", "1", "natural-map residual eta at which the solver stopped"},
    {"converged", "1", "1 if eta reached the tolerance asked of this step, else 0"},
    {"rms_velocity", "m/s", "root mean square velocity of the free grains after the step"},
}};

}  // namespace talus
