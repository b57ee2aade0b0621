#include "io/analysis_schema.h"

namespace talus {
namespace {

using enum ElementType;
using Fields = std::vector<AnalysisField>;

const std::string moments = "averaging";
const std::string thresholds = "threshold_factors gamma_c";
const std::string ratios = moments + " min_contacts l_min";
const std::string overload = thresholds + " " + ratios;
const std::string graining = overload + " lc_factor lc_cut";
const std::string clusters = overload + " joining";

Fields general_fields() {
  return {
      {{"/analysis/version", int32, "", "1", "version of this table and of what it means"}, ""},
      {{"/analysis/key", text, "", "1",
        "XXH3 of the state hash of the run, of all parameters and of the version, 16 hexadecimal digits: an "
        "analysis with another key is computed again"},
       ""},
      {{"/analysis/parameters/*", text, "", "1", "a parameter as it was given, or its default"}, ""},
      {{"/analysis/theta_c", float64, "", "rad",
        "angle of repose, as in /results; NaN if the slope has not failed"},
       ""},
      {{"/analysis/first_slide", float64, "", "rad",
        "first tilt after which the surface layer moves downslope by 0.5 D within 0.5 deg: it may stop "
        "again; "
        "NaN if it never does"},
       ""},
      {{"/analysis/gamma_c", float64, "", "1",
        "Gamma_c, the threshold of the packing: sin(theta_c), or as given; NaN where there is neither"},
       "gamma_c"},
      {{"/analysis/threshold_factor", float64, "F", "1", "thresholds over Gamma_c"}, "threshold_factors"},
      {{"/analysis/threshold", float64, "F", "1",
        "stress ratio from which on a grain counts as overloaded, factor * Gamma_c"},
       thresholds},
  };
}

Fields packing_fields() {
  return {
      {{"/analysis/packing/volume", float64, "T", "m^2", "V, area below the free surface"}, ""},
      {{"/analysis/packing/stress", float64, "T 2 2", "Pa",
        "mean stress of the packing, the sum of the internal moments of the free grains over V (paper, Eq. "
        "6); compression positive, y away from the floor"},
       moments},
      {{"/analysis/packing/sigma_t_over_n", float64, "T", "1",
        "sigma_T / sigma_N = -sigma_yx / sigma_yy; tan(theta) for a periodic bed in equilibrium (paper, Eq. "
        "10)"},
       moments},
      {{"/analysis/packing/stress_ratio", float64, "T", "1",
        "Gamma = Q/P of the packing (paper, Eq. 7); sin(theta) for a periodic bed in equilibrium (paper, Eq. "
        "11)"},
       moments},
      {{"/analysis/packing/volume_strain", float64, "T", "1",
        "(V - V0)/V0, V0 at the start of the tilt; negative = contraction; from /observables"},
       ""},
      {{"/analysis/packing/centre_of_mass_strain", float64, "T", "1",
        "(y - y0)/y0 of the centre of mass, a quieter estimate of the volume strain; from /observables"},
       ""},
      {{"/analysis/packing/bulk_solid_fraction", float64, "T", "1",
        "share of the area that the free grains cover from 5 D above the floor to 5 D below the mean free "
        "surface; "
        "NaN where the bed is not deep enough"},
       ""},
      {{"/analysis/packing/solid_fraction", float64, "T", "1",
        "area of the free grains over V; from /observables"},
       ""},
      {{"/analysis/sections/edge", float64, "X+1", "m",
        "edges of equal sections along the bed; a grain belongs to the section of its centre"},
       "sections"},
      {{"/analysis/sections/sigma_xx", float64, "T X", "Pa",
        "mean stress sigma_xx of a section, the sum of M_xx of its grains over V / sections (paper, Fig. 6)"},
       moments + " sections"},
  };
}

Fields overload_fields() {
  return {
      {{"/analysis/gamma/edge", float64, "B+1", "1", "edges of the bins of gamma"}, "bins"},
      {{"/analysis/gamma/density", float64, "T B", "1",
        "probability density of gamma over the free grains that carry something (paper, Fig. 8); gamma of a "
        "grain is the stress ratio of its neighbourhood of diameter l_min, here and in all that follows"},
       ratios + " bins"},
      {{"/analysis/gamma/error", float64, "T B", "1",
        "standard error of the density, from the number of grains in each bin"},
       ratios + " bins"},
      {{"/analysis/gamma/mean", float64, "T", "1", "mean gamma of the free grains that carry something"},
       ratios},
      {{"/analysis/gamma/share_above_one", float64, "T", "1",
        "share of these grains with gamma above 1: the weight of a grain, small beside its contact forces, "
        "can make one principal value negative; they count in the density outside of its bins"},
       ratios},
      {{"/analysis/overloaded/fraction", float64, "T F", "1",
        "p_o: overloaded grains over the free grains that carry something"},
       overload},
      {{"/analysis/overloaded/fraction_of_all", float64, "T F", "1",
        "overloaded grains over all free grains"},
       overload},
      {{"/analysis/lc/cut", float64, "", "m",
        "diameter at which the search for l_c ends, in a periodic bed not above L; not below l_min"},
       "lc_cut l_min"},
      {{"/analysis/lc/end_ratio", float64, "F", "1", "stress ratio of a neighbourhood at which l_c is found"},
       thresholds + " lc_factor"},
      {{"/analysis/lc/length", float32, "T F N", "m",
        "l_c of an overloaded grain, a diameter: that of the smallest circle about its centre, from l_min "
        "on, "
        "in which the summed internal moments have a stress ratio not above lc/end_ratio; the cut where "
        "there "
        "is none; NaN for other grains"},
       graining},
      {{"/analysis/lc/mean", float64, "T F", "m", "mean l_c of the overloaded grains"}, graining},
      {{"/analysis/lc/error", float64, "T F", "m",
        "standard error of that mean, as if grains were independent"},
       graining},
      {{"/analysis/lc/max", float64, "T F", "m", "largest l_c"}, graining},
      {{"/analysis/lc/share_cut", float64, "T F", "1", "share of the overloaded grains whose l_c is cut off"},
       graining},
  };
}

Fields cluster_fields() {
  return {
      {{"/analysis/clusters/label", int32, "T F N", "1",
        "cluster of an overloaded grain, 0 the largest; -1 for other grains; sizes are the counts of each "
        "label"},
       clusters},
      {{"/analysis/clusters/count", int32, "T F", "1", "clusters of overloaded grains"}, clusters},
      {{"/analysis/clusters/largest", int32, "T F", "1", "grains in the largest cluster"}, clusters},
      {{"/analysis/clusters/largest_share", float64, "T F", "1", "the same over all overloaded grains"},
       clusters},
      {{"/analysis/clusters/mean", float64, "T F", "1", "mean size of the clusters, in grains"}, clusters},
      {{"/analysis/clusters/second_moment", float64, "T F", "1",
        "sum of s^2 / sum of s over the sizes s of all clusters"},
       clusters},
      {{"/analysis/clusters/second_moment_of_others", float64, "T F", "1",
        "the same without the largest cluster"},
       clusters},
      {{"/analysis/clusters/spans_depth", int32, "T F", "1",
        "1 where a cluster reaches from the floor to the surface, else 0"},
       clusters},
      {{"/analysis/clusters/spans_length", int32, "T F", "1",
        "1 where a cluster reaches from wall to wall, or around the period, else 0"},
       clusters},
      {{"/analysis/clusters/direction", float64, "2", "rad", "directions of directed paths, to the bed"}, ""},
      {{"/analysis/clusters/directed_spans", int32, "T F 2", "1",
        "1 where a path through overloaded grains leads from the floor to the surface, each of its steps "
        "within 30 deg of a direction (the paper's directed percolation), else 0"},
       clusters},
      {{"/analysis/clusters/directed_height", float64, "T F 2", "1",
        "largest rise of such a path, from centre to centre, over the mean height V / L of the bed"},
       clusters},
  };
}

Fields contact_fields() {
  return {
      {{"/analysis/contacts/coordination_number", float64, "T", "1",
        "z: force-carrying contacts per free grain that carries force, each counted for each free grain it "
        "touches"},
       ""},
      {{"/analysis/contacts/coordination_number_of_all", float64, "T", "1", "the same per free grain"}, ""},
      {{"/analysis/contacts/coordination_number_without_rattlers", float64, "T", "1",
        "z without rattlers: grains with fewer than two contacts are taken away, again and again"},
       ""},
      {{"/analysis/contacts/rattler_fraction", float64, "T", "1",
        "share of the free grains that are rattlers"},
       ""},
      {{"/analysis/contacts/direction_edge", float64, "B+1", "rad",
        "edges of the bins of the direction of contact normals to the bed"},
       "bins"},
      {{"/analysis/contacts/direction_density", float64, "T B", "1/rad",
        "probability density of the direction of contact normals"},
       "bins"},
      {{"/analysis/contacts/direction_density_by_force", float64, "T B", "1/rad",
        "the same, each contact weighted with f_n"},
       "bins"},
      {{"/analysis/contacts/direction_peak", float64, "T 3", "rad",
        "where the directions concentrate most within 30 deg of 0, 60 and 120 deg (density smoothed over 5 "
        "deg)"},
       ""},
      {{"/analysis/contacts/fabric_amplitude", float64, "T 2", "1",
        "amplitude of the Fourier components 2 and 6 of the density of directions, relative to a uniform "
        "one"},
       ""},
      {{"/analysis/contacts/fabric_angle", float64, "T 2", "rad",
        "first peak of each: at angle + k 180 deg and at angle + k 60 deg the directions concentrate"},
       ""},
      {{"/analysis/contacts/mean_normal_force", float64, "T", "N",
        "mean f_n of the force-carrying contacts, per metre of thickness"},
       ""},
      {{"/analysis/contacts/force_edge", float64, "B+1", "1",
        "edges of the bins of f_n over its mean, of equal ratio"},
       "bins"},
      {{"/analysis/contacts/force_density", float64, "T B", "1", "probability density of f_n over its mean"},
       "bins"},
      {{"/analysis/contacts/mobilisation_edge", float64, "B+1", "1",
        "edges of the bins of the mobilised friction, the size of f_t over mu f_n"},
       "bins"},
      {{"/analysis/contacts/mobilisation_density", float64, "T B", "1",
        "probability density of the mobilised friction"},
       "bins"},
      {{"/analysis/contacts/strong_share", float64, "T", "1",
        "share of the contacts whose f_n is above the mean: the strong network"},
       ""},
      {{"/analysis/contacts/strong_share_of_mean_stress", float64, "T", "1",
        "share of the mean stress that the strong network carries"},
       ""},
      {{"/analysis/contacts/strong_share_of_deviator", float64, "T", "1",
        "share of the deviator Q that it carries, along the principal axes of the whole"},
       ""},
      {{"/analysis/contacts/strong_stress_ratio", float64, "T", "1",
        "Q/P of the stress of the strong network"},
       ""},
      {{"/analysis/contacts/weak_stress_ratio", float64, "T", "1", "Q/P of the stress of the weak network"},
       ""},
      {{"/analysis/contacts/critical_share", float64, "T", "1",
        "share of the force-carrying contacts whose friction is fully mobilised"},
       ""},
      {{"/analysis/contacts/critical_largest", int32, "T", "1",
        "contacts in the largest cluster of critical contacts, joined where they share a free grain"},
       ""},
      {{"/analysis/contacts/critical_correlation_length", float64, "T", "m",
        "correlation length of these clusters, sqrt(2 sum of s^2 R^2 / sum of s^2), R the radius of gyration "
        "of a cluster"},
       ""},
  };
}

Fields correlation_fields() {
  return {
      {{"/analysis/correlation/distance", float64, "B", "m",
        "middle of the bins of the distance between two points"},
       "bins"},
      {{"/analysis/correlation/normal_force", float64, "T B", "1",
        "correlation of the normal forces at two contact points, each over the mean of its layer of 2 D: "
        "mean of df df over that of df^2"},
       "bins"},
      {{"/analysis/correlation/gamma", float64, "T B", "1", "correlation of gamma of two free grains"},
       ratios + " bins"},
      {{"/analysis/correlation/mean_stress", float64, "T B", "1",
        "correlation of p / (pi r^2) of two free grains, each over the mean of its layer of 2 D; p is the "
        "trace of the internal moment"},
       moments + " bins"},
  };
}

Fields transition_fields() {
  return {
      {{"/analysis/theta_d/lc_jump", float64, "F", "rad",
        "theta_d from l_c: tilt of the frame after the largest increase of lc/max between two frames, up to "
        "theta_c and to the first frame that reaches the cut; NaN where it never increases"},
       graining},
      {{"/analysis/theta_d/lc_jump_error", float64, "F", "rad", "spacing of these two frames"}, graining},
      {{"/analysis/theta_d/lc_jump_size", float64, "F", "m", "that increase"}, graining},
      {{"/analysis/theta_d/percolation", float64, "F", "rad",
        "theta_d from percolation: tilt of the first frame from which on, for 3 frames at least, "
        "clusters/spans_depth is 1; NaN where there is none"},
       clusters},
      {{"/analysis/theta_d/percolation_error", float64, "F", "rad",
        "spacing from the frame before; NaN where it is the first frame: then theta_d is not above it"},
       clusters},
      {{"/analysis/theta_d/dilation", float64, "2", "rad",
        "theta_d from the onset of dilation: tilt where the volume strain, and where the centre-of-mass "
        "strain, is smallest up to theta_c, each a mean over 1 deg; NaN where it does not rise after it by "
        "more than its noise"},
       ""},
      {{"/analysis/theta_d/dilation_low", float64, "2", "rad",
        "lowest tilt of the range around it in which the strain is not above the minimum by more than its "
        "noise, the rms deviation from the mean over 1 deg"},
       ""},
      {{"/analysis/theta_d/dilation_high", float64, "2", "rad", "highest tilt of that range"}, ""},
  };
}

}  // namespace

const std::vector<AnalysisField>& analysis_schema() {
  static const Fields schema = [] {
    Fields all;
    for (const Fields& part : {general_fields(), packing_fields(), overload_fields(), cluster_fields(),
                               contact_fields(), correlation_fields(), transition_fields()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return schema;
}

std::string analysis_path(std::string_view name) { return "/analysis/" + std::string(name); }

std::string analysis_name(const AnalysisField& field) {
  return field.data_set.path.substr(analysis_path("").size());
}

bool is_array(const AnalysisField& field) {
  return field.data_set.type != text && field.data_set.path != analysis_path("version");
}

bool is_present(const AnalysisField& field, const Sizes& sizes) {
  return field.data_set.shape.find('F') == std::string::npos || sizes.at('F') > 0;
}

}  // namespace talus
