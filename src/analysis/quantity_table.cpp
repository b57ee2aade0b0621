#include "analysis/quantities.h"

namespace talus::analysis {
namespace {

using QuantityRows = std::vector<Quantity>;

/// Returns the display of a quantity: its symbol, its title, and the same quantity in the observables.
Display curve(const std::string& symbol, const std::string& title, std::optional<Observable> recorded = {}) {
  return {symbol, title, false, recorded};
}
Display percent(const std::string& symbol, const std::string& title,
                std::optional<Observable> recorded = {}) {
  return {symbol, title, true, recorded};
}

const std::string moments = "averaging";
const std::string thresholds = "threshold_factors gamma_c";
const std::string ratios = moments + " min_contacts l_min";
const std::string overload = thresholds + " " + ratios;
const std::string graining = overload + " lc_factor lc_cut";
const std::string clusters = overload + " joining";

QuantityRows general_rows() {
  return {
      {&Analysis::theta_c, "theta_c", "", "rad",
       "angle of repose: the tilt at which the final, sustained flow began; NaN if the slope has not failed",
       "", curve("θ_c", "Angle of repose θ_c")},
      {&Analysis::first_slide, "first_slide", "", "rad",
       "first tilt after which the surface layer moves downslope by 0.5 D within 0.5 deg, even if it stops "
       "again; above theta_c if the tilt is fast compared with the flow; NaN without a slide"},
      {&Analysis::gamma_c, "gamma_c", "", "1",
       "Gamma_c, the threshold of the packing: sin(theta_c), or the given value; NaN without either",
       "gamma_c"},
      {&RunThreshold::factor, "threshold_factor", "F", "1", "thresholds over Gamma_c", "threshold_factors"},
      {&RunThreshold::gamma, "threshold", "F", "1",
       "stress ratio from which a grain counts as overloaded, factor * Gamma_c", thresholds},
  };
}

QuantityRows packing_rows() {
  return {
      {&FrameRecord::volume, "packing/volume", "T", "m^2", "V, area below the free surface"},
      {&FrameRecord::stress, "packing/stress", "T 2 2", "Pa",
       "mean stress: sum of the internal moments of the free grains over V (paper, Eq. 6); compression "
       "positive, y away from the floor",
       moments},
      {&FrameRecord::sigma_t_over_n, "packing/sigma_t_over_n", "T", "1",
       "sigma_T / sigma_N = -sigma_yx / sigma_yy; tan(theta) for a periodic bed in equilibrium (paper, Eq. "
       "10)",
       moments, curve("σ_T/σ_N", "σ_T/σ_N of the packing", Observable::sigma_t_over_n)},
      {&FrameRecord::stress_ratio, "packing/stress_ratio", "T", "1",
       "Gamma = Q/P (paper, Eq. 7); at least sin(theta) for a periodic bed in equilibrium without rolling "
       "friction, equal to it in the paper's Eq. 11",
       moments, curve("Γ = Q/P", "Γ = Q/P of the packing", Observable::stress_ratio)},
      {&FrameRecord::volume_strain, "packing/volume_strain", "T", "1",
       "(V - V0)/V0, V0 at the start of the tilt; negative = contraction; from /observables", "",
       percent("ΔV/V", "Volume strain ΔV/V", Observable::volume_strain)},
      {&FrameRecord::centre_of_mass_strain, "packing/centre_of_mass_strain", "T", "1",
       "(y - y0)/y0 of the centre of mass, less noisy; from /observables", "",
       percent("Δy/y", "Strain of the centre of mass Δy/y", Observable::centre_of_mass_strain)},
      {&FrameRecord::bulk_solid_fraction, "packing/bulk_solid_fraction", "T", "1",
       "solid fraction from 5 D above the floor to 5 D below the mean free surface; NaN if the bed is too "
       "shallow"},
      {&FrameRecord::solid_fraction, "packing/solid_fraction", "T", "1",
       "area of the free grains over V; from /observables"},
      {&Analysis::failure_ratio, "packing/failure_ratio", "", "1",
       "mean of (sigma_T / sigma_N) / tan(theta) over the last 0.5 deg before theta_c, from /observables: 1 "
       "for a periodic bed, less between walls (paper, Eq. 15, Fig. 7); NaN without failure or rows there"},
      {&Analysis::failure_ratio_spread, "packing/failure_ratio_spread", "", "1",
       "standard deviation of failure_ratio over these 0.5 deg"},
      {&Analysis::section_edge, "sections/edge", "X+1", "m",
       "edges of equal sections along the bed, to which grains belong by their centres", "sections"},
      {&FrameRecord::section_sigma_xx, "sections/sigma_xx", "T X", "Pa",
       "sigma_xx of a section, the sum of M_xx of its grains over V / sections (paper, Fig. 6)",
       moments + " sections"},
  };
}

QuantityRows overload_rows() {
  return {
      {&Analysis::gamma_edge, "gamma/edge", "B+1", "1", "edges of the bins of gamma", "bins"},
      {&FrameRecord::gamma_density, "gamma/density", "T B", "1",
       "probability density of gamma, the stress ratio of the neighbourhood of diameter l_min of a grain, "
       "over the free grains that carry force (paper, Fig. 8)",
       ratios + " bins"},
      {&FrameRecord::gamma_error, "gamma/error", "T B", "1",
       "standard error of the density, from the number of grains in each bin", ratios + " bins"},
      {&FrameRecord::gamma_mean, "gamma/mean", "T", "1", "mean gamma of the free grains that carry force",
       ratios},
      {&FrameRecord::gamma_share_above_one, "gamma/share_above_one", "T", "1",
       "share of the free grains that carry force with gamma above 1, which their weight can cause; they are "
       "in the normalisation of the density but in none of its bins",
       ratios},
      {&FrameThreshold::overloaded_fraction, "overloaded/fraction", "T F", "1",
       "p_o: overloaded grains over the free grains that carry force", overload,
       curve("p_o", "p_o, share of overloaded grains")},
      {&FrameThreshold::overloaded_fraction_of_all, "overloaded/fraction_of_all", "T F", "1",
       "overloaded grains over all free grains", overload},
      {&Analysis::lc_cut, "lc/cut", "", "m",
       "diameter at which the search for l_c ends; at most L in a periodic bed, at least l_min",
       "lc_cut l_min"},
      {&RunThreshold::end_ratio, "lc/end_ratio", "F", "1",
       "stress ratio of a neighbourhood at which l_c is found", thresholds + " lc_factor"},
      {&FrameThreshold::lc, "lc/length", "T F N", "m",
       "l_c of an overloaded grain: diameter of the smallest circle about its centre, at least l_min, whose "
       "summed internal moments have a stress ratio of at most lc/end_ratio; the cut if there is none; NaN "
       "for other grains",
       graining},
      {&FrameThreshold::lc_mean, "lc/mean", "T F", "m", "mean l_c of the overloaded grains", graining,
       curve("mean", "Mean ℓ_c of the overloaded grains")},
      {&FrameThreshold::lc_error, "lc/error", "T F", "m",
       "standard error of this mean, for independent grains", graining},
      {&FrameThreshold::lc_max, "lc/max", "T F", "m", "largest l_c", graining,
       curve("largest", "Largest ℓ_c")},
      {&FrameThreshold::lc_share_cut, "lc/share_cut", "T F", "1",
       "share of the overloaded grains whose l_c is cut off", graining},
  };
}

QuantityRows cluster_rows() {
  return {
      {&FrameThreshold::cluster, "clusters/label", "T F N", "1",
       "cluster of an overloaded grain, 0 the largest; -1 for other grains", clusters},
      {&FrameThreshold::cluster_count, "clusters/count", "T F", "1", "clusters of overloaded grains",
       clusters},
      {&FrameThreshold::largest_cluster, "clusters/largest", "T F", "1", "grains in the largest cluster",
       clusters},
      {&FrameThreshold::largest_share, "clusters/largest_share", "T F", "1",
       "share of the overloaded grains in their largest cluster", clusters,
       curve("largest cluster", "Share of the largest cluster")},
      {&FrameThreshold::mean_cluster, "clusters/mean", "T F", "1", "mean size of the clusters, in grains",
       clusters},
      {&FrameThreshold::second_moment, "clusters/second_moment", "T F", "1",
       "sum of s^2 / sum of s over the sizes s of all clusters", clusters},
      {&FrameThreshold::second_moment_of_others, "clusters/second_moment_of_others", "T F", "1",
       "the same without the largest cluster", clusters},
      {&FrameThreshold::spans_depth, "clusters/spans_depth", "T F", "1",
       "1 if a cluster reaches from the floor to the surface, else 0", clusters},
      {&FrameThreshold::spans_length, "clusters/spans_length", "T F", "1",
       "1 if a cluster reaches from wall to wall, or around the period, else 0", clusters},
      {&Analysis::direction, "clusters/direction", "2", "rad",
       "directions of directed paths, relative to the bed"},
      {&FrameThreshold::directed_spans, "clusters/directed_spans", "T F 2", "1",
       "1 if a path through overloaded grains, each step within 30 deg of a direction, leads from the floor "
       "to the surface (directed percolation of the paper), else 0",
       clusters},
      {&FrameThreshold::directed_height, "clusters/directed_height", "T F 2", "1",
       "largest rise of such a path, from centre to centre, over V / L", clusters},
  };
}

QuantityRows contact_rows() {
  return {
      {&FrameRecord::coordination_number, "contacts/coordination_number", "T", "1",
       "z: force-carrying contacts per free grain that carries force, counted for every free grain they "
       "touch",
       "", curve("z", "z, coordination number", Observable::coordination_number)},
      {&FrameRecord::coordination_number_of_all, "contacts/coordination_number_of_all", "T", "1",
       "the same number per free grain"},
      {&FrameRecord::coordination_number_without_rattlers, "contacts/coordination_number_without_rattlers",
       "T", "1", "z without rattlers: grains with fewer than two contacts are removed repeatedly"},
      {&FrameRecord::rattler_fraction, "contacts/rattler_fraction", "T", "1",
       "share of the free grains that are rattlers"},
      {&Analysis::direction_edge, "contacts/direction_edge", "B+1", "rad",
       "edges of the bins of the direction of contact normals to the bed", "bins"},
      {&FrameRecord::direction_density, "contacts/direction_density", "T B", "1/rad",
       "probability density of the direction of contact normals", "bins"},
      {&FrameRecord::direction_density_by_force, "contacts/direction_density_by_force", "T B", "1/rad",
       "the same, each contact weighted with f_n", "bins"},
      {&FrameRecord::direction_peak, "contacts/direction_peak", "T 3", "rad",
       "directions of highest density within 30 deg of 0, 60 and 120 deg, smoothed over 5 deg"},
      {&FrameRecord::fabric_amplitude, "contacts/fabric_amplitude", "T 2", "1",
       "amplitude of the Fourier components 2 and 6 of the density of directions, relative to a uniform one"},
      {&FrameRecord::fabric_angle, "contacts/fabric_angle", "T 2", "rad",
       "direction of the first peak of each component, which repeats every 180 and every 60 deg"},
      {&FrameRecord::mean_normal_force, "contacts/mean_normal_force", "T", "N/m",
       "mean f_n of the force-carrying contacts, per metre of thickness"},
      {&Analysis::force_edge, "contacts/force_edge", "B+1", "1",
       "edges of the bins of f_n over its mean, of equal ratio", "bins"},
      {&FrameRecord::force_density, "contacts/force_density", "T B", "1",
       "probability density of f_n over its mean", "bins"},
      {&Analysis::mobilisation_edge, "contacts/mobilisation_edge", "B+1", "1",
       "edges of the bins of the mobilised friction, the magnitude of f_t over mu f_n", "bins"},
      {&FrameRecord::mobilisation_density, "contacts/mobilisation_density", "T B", "1",
       "probability density of the mobilised friction", "bins"},
      {&FrameRecord::strong_share, "contacts/strong_share", "T", "1",
       "share of the contacts whose f_n is above the mean: the strong network"},
      {&FrameRecord::strong_share_of_mean_stress, "contacts/strong_share_of_mean_stress", "T", "1",
       "share of the mean stress that the strong network carries"},
      {&FrameRecord::strong_share_of_deviator, "contacts/strong_share_of_deviator", "T", "1",
       "share of the deviator Q that it carries, along the principal axes of the total stress"},
      {&FrameRecord::strong_stress_ratio, "contacts/strong_stress_ratio", "T", "1",
       "Q/P of the stress of the strong network"},
      {&FrameRecord::weak_stress_ratio, "contacts/weak_stress_ratio", "T", "1",
       "Q/P of the stress of the weak network"},
      {&FrameRecord::network_fabric_amplitude, "contacts/network_fabric_amplitude", "T 2", "1",
       "amplitude of the Fourier component 2 of the directions of the strong and of the weak contacts"},
      {&FrameRecord::network_fabric_angle, "contacts/network_fabric_angle", "T 2", "rad",
       "direction in which each of these two sets of contacts concentrates"},
      {&FrameRecord::critical_share, "contacts/critical_share", "T", "1",
       "nu: share of the force-carrying contacts whose friction is fully mobilised (critical contacts)", "",
       percent("ν", "ν, share of critical contacts")},
      {&FrameRecord::critical_bound, "contacts/critical_bound", "T", "1",
       "nu_max, the largest nu in equilibrium: 2 - (2 N + N_mu) / M for N free grains that carry force, N_mu "
       "of which have a contact with friction, and M force-carrying contacts (after McNamara and Herrmann "
       "2004); NaN if contacts resist rolling"},
      {&FrameRecord::critical_share_of_bound, "contacts/critical_share_of_bound", "T", "1",
       "nu over nu_max; NaN if there are too few contacts for equilibrium (nu_max <= 0), or if they resist "
       "rolling",
       "", curve("ν/ν_max", "ν over its bound")},
      {&FrameRecord::critical_clusters, "contacts/critical_clusters", "T", "1",
       "clusters of critical contacts, joined if they share a free grain"},
      {&FrameRecord::critical_mean, "contacts/critical_mean", "T", "1",
       "mean size of these clusters, in contacts; NaN without any", "",
       curve("mean", "Mean cluster of critical contacts")},
      {&FrameRecord::critical_weighted_mean, "contacts/critical_weighted_mean", "T", "1",
       "sum of s^2 / sum of s over these sizes: mean size of the cluster of a critical contact"},
      {&FrameRecord::critical_largest, "contacts/critical_largest", "T", "1",
       "contacts in the largest of these clusters"},
      {&FrameRecord::critical_correlation_length, "contacts/critical_correlation_length", "T", "m",
       "sqrt(2 sum of s^2 R^2 / sum of s^2), R the radius of gyration of a cluster"},
      {&Analysis::critical_exponent, "contacts/critical_exponent", "2", "1",
       "exponent a of size = b (theta_c - theta)^-a for the mean size and the weighted mean: least squares "
       "of the logarithms over the frames of the last 10 deg before theta_c that have critical contacts; NaN "
       "with fewer than 5 (Staron, Vilotte and Radjai 2002)"},
      {&Analysis::critical_exponent_error, "contacts/critical_exponent_error", "2", "1",
       "standard errors, from the scatter around the line, for independent frames"},
  };
}

QuantityRows texture_rows() {
  return {
      {&FrameRecord::texture_axis, "texture/axis", "T", "rad",
       "direction of the major principal stress of the contact forces, relative to the bed: the axis of the "
       "anisotropies below"},
      {&FrameRecord::texture_contacts, "texture/contacts", "T", "1",
       "a_c, anisotropy of the contact normals, whose density is proportional to 1 + a_c cos 2 (direction - "
       "axis)",
       "", curve("a_c", "a_c, anisotropy of contacts")},
      {&FrameRecord::texture_normal_forces, "texture/normal_forces", "T", "1",
       "a_n, anisotropy of the normal forces: their mean in a direction is 1 + a_n cos 2 (direction - axis) "
       "of that over all directions"},
      {&FrameRecord::texture_tangential_forces, "texture/tangential_forces", "T", "1",
       "a_t, anisotropy of the tangential forces: their mean is -a_t sin 2 (direction - axis) of the mean "
       "normal force"},
      {&FrameRecord::texture_branches, "texture/branches", "T", "1",
       "a_l, defined as a_n for the lengths between the centres of grains in contact; with the floor or a "
       "wall the part in the free grain counts"},
      {&FrameRecord::texture_stress_ratio, "texture/stress_ratio", "T", "1",
       "(a_c + a_n + a_t + a_l) / 2, which is Gamma to first order (Rothenburg and Bathurst 1989)"},
      {&FrameRecord::coherent_share, "texture/coherent_share", "T", "1",
       "share of the force-carrying contacts that are weak and have at least 0.8 of their friction "
       "mobilised, the coherent weak contacts (after Staron and Radjai 2005)",
       "", percent("coherent", "Coherent weak contacts")},
      {&FrameRecord::coherent_fabric, "texture/coherent_fabric", "T", "1",
       "fabric of the coherent weak contacts, 2 <cos 2 (direction - d)>, d the main direction of the strong "
       "contacts: negative across the force chains",
       "", curve("coherent", "Fabric of coherent weak contacts")},
      {&FrameRecord::incoherent_fabric, "texture/incoherent_fabric", "T", "1",
       "fabric of the other weak contacts"},
      {&FrameRecord::weak_fabric_by_friction, "texture/weak_fabric_by_friction", "T B", "1",
       "fabric of the weak contacts in each bin of the mobilised friction (contacts/mobilisation_edge); NaN "
       "for an empty bin",
       "bins"},
  };
}

QuantityRows topology_rows() {
  return {
      {&Analysis::network_threshold, "network/threshold", "B", "1",
       "thresholds of f_n over its mean, equally spaced from 0 up to 5", "bins"},
      {&FrameRecord::network_components, "network/components", "T B", "1",
       "components of at least two free grains in the network of the contacts between free grains with at "
       "least this force",
       "bins"},
      {&FrameRecord::network_loops, "network/loops", "T B", "1",
       "independent loops of this network (first Betti number): contacts - grains + components; a loop "
       "around the period counts",
       "bins"},
      {&FrameRecord::component_persistence, "network/component_persistence", "T", "1",
       "total persistence of the components of the force network, per free grain: the sum of birth - death; "
       "as the threshold falls, a component is born at its largest force over the mean, and dies when it "
       "meets an older one, or at 0 (Kramar and others 2014)"},
      {&FrameRecord::loop_persistence, "network/loop_persistence", "T", "1",
       "total persistence of the loops of the force network, per free grain: a loop is born at its smallest "
       "force over the mean and dies at 0"},
      {&FrameRecord::network_change, "network/change", "T 2", "1",
       "sliced Wasserstein distance, in sixteen directions, of the persistence diagrams of components and of "
       "loops from those of the preceding frame, per free grain (Carriere, Cuturi and Oudot 2017); NaN in "
       "the first frame"},
  };
}

QuantityRows layer_rows() {
  return {
      {&Analysis::layer_edge, "layers/edge", "Y+1", "1",
       "edges of ten equal layers, from the floor, 0, to the mean height V / L, 1; grains belong to the "
       "layer of their centre, or to the last"},
      {&FrameRecord::layer_critical_share, "layers/critical_share", "T Y", "1",
       "nu of each layer; a contact between two free grains counts half for the layer of each; NaN without "
       "contacts"},
      {&FrameRecord::layer_critical_share_of_bound, "layers/critical_share_of_bound", "T Y", "1",
       "nu of each layer over the bound for the layer, with its contacts counted as for critical_share"},
  };
}

QuantityRows rigidity_rows() {
  return {
      {&FrameRecord::rigid_clusters, "rigid/clusters", "T", "1",
       "rigid clusters: sets of two or more bodies that can only move as one, by the double-bond pebble game "
       "with two constraints for a sticking contact and one for a sliding contact (Henkes, Quint, Fily and "
       "Schwarz 2016); floor and walls are one body; -1, and NaN for the next four, without friction"},
      {&FrameRecord::rigid_largest_share, "rigid/largest_share", "T", "1",
       "share of the free grains that carry force in the largest rigid cluster", "",
       curve("largest rigid cluster", "Share of the largest rigid cluster")},
      {&FrameRecord::rigid_contact_share, "rigid/contact_share", "T", "1",
       "share of the force-carrying contacts inside a rigid cluster"},
      {&FrameRecord::rigid_floppy_modes, "rigid/floppy_modes", "T", "1",
       "motions that the contacts leave free, per free grain that carries force: 3 minus its independent "
       "constraints"},
      {&FrameRecord::rigid_redundant, "rigid/redundant", "T", "1",
       "redundant constraints per free grain that carries force: independent sets of contact forces in "
       "equilibrium without a load",
       "", curve("redundant", "Redundant constraints per grain")},
  };
}

QuantityRows deformation_rows() {
  return {
      {&FrameRecord::local_shear, "deformation/shear", "T", "1",
       "mean local shear strain of the free grains since the preceding frame: s1 - s2 of the stretch that "
       "best fits the motion of the grains within 2 D; NaN in the first frame, as below"},
      {&FrameRecord::local_shear_share, "deformation/shear_share", "T", "1",
       "localisation: share of the sum of all local shear strains in the tenth of the grains with the "
       "largest; 0.1 if all are equal; NaN without motion",
       "", percent("localised shear", "Share of shear in a tenth of the grains")},
      {&FrameRecord::nonaffine, "deformation/nonaffine", "T", "m",
       "non-affine displacement since the preceding frame: root mean over the free grains of D2min, the mean "
       "squared residual of this fit (Falk and Langer 1998, who take the sum over neighbours)",
       "", curve("non-affine", "Non-affine displacement")},
      {&FrameRecord::nonaffine_largest, "deformation/nonaffine_largest", "T", "m",
       "largest non-affine displacement of a grain"},
  };
}

QuantityRows continuum_rows() {
  return {
      {&FrameRecord::local_solid_fraction, "cells/solid_fraction", "T", "1",
       "mean local solid fraction of the free grains, the area of a grain over that of its radical "
       "(Laguerre) cell; without the open cells of the free surface, which extend to points of power above "
       "0.75 D^2",
       "", curve("mean", "Local solid fraction")},
      {&FrameRecord::local_solid_fraction_spread, "cells/solid_fraction_spread", "T", "1",
       "its standard deviation over these grains"},
      {&FrameRecord::granular_temperature, "granular_temperature", "T", "m^2/s^2",
       "mass-weighted mean over the free grains of half the mean square velocity around a grain relative to "
       "a linear velocity field, weighted with mass and Lucy's function, 5 D wide; 0 for uniform flow and "
       "uniform shear"},
  };
}

QuantityRows correlation_rows() {
  return {
      {&Analysis::correlation_distance, "correlation/distance", "B", "m",
       "middles of the bins of the distance between two points", "bins"},
      {&FrameRecord::normal_force_correlation, "correlation/normal_force", "T B", "1",
       "correlation of the normal forces at two contact points, each over the mean of its layer of 2 D: <df "
       "df> / <df^2>",
       "bins"},
      {&FrameRecord::gamma_correlation, "correlation/gamma", "T B", "1",
       "correlation of gamma of two free grains", ratios + " bins"},
      {&FrameRecord::mean_stress_correlation, "correlation/mean_stress", "T B", "1",
       "correlation of p / (pi r^2) of two free grains, each over the mean of its layer of 2 D; p: trace of "
       "the internal moment",
       moments + " bins"},
  };
}

QuantityRows transition_rows() {
  return {
      {&RunThreshold::lc_jump, "theta_d/lc_jump", "F", "rad",
       "theta_d from l_c: tilt after the largest increase of lc/max between two frames, up to theta_c and to "
       "the first frame at the cut; NaN without an increase",
       graining},
      {&RunThreshold::lc_jump_error, "theta_d/lc_jump_error", "F", "rad",
       "difference in tilt between these two frames", graining},
      {&RunThreshold::lc_jump_size, "theta_d/lc_jump_size", "F", "m", "this increase", graining},
      {&RunThreshold::percolation, "theta_d/percolation", "F", "rad",
       "theta_d from percolation: tilt of the first of at least 3 successive frames in which "
       "clusters/spans_depth is 1; NaN without such frames",
       clusters},
      {&RunThreshold::percolation_error, "theta_d/percolation_error", "F", "rad",
       "difference in tilt from the preceding frame; NaN for the first frame, at or below which theta_d then "
       "lies",
       clusters},
      {&Analysis::dilation, "theta_d/dilation", "2", "rad",
       "theta_d from dilation: tilts of the smallest volume strain and centre-of-mass strain up to theta_c, "
       "averaged over 1 deg; NaN if the strain does not rise afterwards by more than its noise"},
      {&Analysis::dilation_low, "theta_d/dilation_low", "2", "rad",
       "lowest tilt around it at which the mean strain exceeds its minimum by at most the noise, the rms "
       "deviation from the mean over 1 deg"},
      {&Analysis::dilation_high, "theta_d/dilation_high", "2", "rad", "highest such tilt"},
  };
}

}  // namespace

const std::vector<Quantity>& quantities() {
  static const QuantityRows table = [] {
    QuantityRows all;
    for (const QuantityRows& part :
         {general_rows(), packing_rows(), overload_rows(), cluster_rows(), contact_rows(), texture_rows(),
          topology_rows(), layer_rows(), rigidity_rows(), deformation_rows(), continuum_rows(),
          correlation_rows(), transition_rows(), event_quantities()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return table;
}

}  // namespace talus::analysis
