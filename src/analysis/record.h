#pragma once
/// Results of the analysis of a run. Each number is defined in one place, the table of quantities.h; this
/// header has only its name and type. SI units; NaN if a quantity is unknown or does not exist.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/snapshot.h"

namespace talus::analysis {

// Parameters of an analysis that a user can choose.

/// Default of l_min, in D: a grain together with its first neighbours.
inline constexpr double default_l_min = 3.0;

/// The condition under which two overloaded grains belong to one cluster.
enum class Joining {
  contacts,    ///< a contact that carries force
  neighbours,  ///< centres closer than 1.1 times the sum of the radii
};

/// Parameters of an analysis with their defaults (docs/analysis.md).
struct AnalysisParameters {
  std::vector<double> threshold_factors = {1.0, 2.0};  ///< thresholds in units of Gamma_c, ascending
  std::optional<double> gamma_c;                       ///< default: sin(theta_c) of the run
  double l_min = default_l_min;     ///< smallest diameter of a neighbourhood, in D; 0: the single grain
  std::optional<double> lc_factor;  ///< end ratio of l_c in units of Gamma_c; default: threshold_factors
  std::optional<double> lc_cut;     ///< largest l_c, in D; default: min(H, L/2)
  Joining joining = Joining::contacts;
  double averaging = 0.0;  ///< range of tilt over which internal moments are averaged, deg; 0: a single frame
  int min_contacts = 1;    ///< force-carrying contacts that a grain needs to be counted
  int sections = 20;
  int bins = 50;
  /// Rms velocity from which the bed rearranges, in g h; default: from the solver tolerance.
  std::optional<double> event_velocity;
  double event_quiet = 1.0;              ///< quiet time after which an event is over, in sqrt(D/g)
  double event_displacement = 0.01;      ///< displacement from which a grain counts as moved, in D
  std::optional<double> event_size_min;  ///< lower end of the power law of sizes, in m g D; default: fitted

  bool operator==(const AnalysisParameters&) const = default;
};

inline constexpr std::array<double, 2> two_not_known = {not_known, not_known};

/// Results for the overloaded grains of one frame at one threshold. Arrays over grains are in the order of
/// ids.
struct FrameThreshold {
  double overloaded_fraction = not_known;
  double overloaded_fraction_of_all = not_known;
  std::vector<float> lc{};
  double lc_mean = not_known;
  double lc_error = not_known;
  double lc_max = not_known;
  double lc_share_cut = not_known;
  std::vector<Index> cluster{};
  Index cluster_count = 0;
  Index largest_cluster = 0;
  double largest_share = not_known;
  double mean_cluster = not_known;
  double second_moment = not_known;
  double second_moment_of_others = not_known;
  Index spans_depth = 0;
  Index spans_length = 0;
  std::array<Index, 2> directed_spans{};
  std::array<double, 2> directed_height = two_not_known;
};

/// Results of one frame.
struct FrameRecord {
  double tilt = 0.0;  ///< rad
  double volume = not_known;
  std::array<double, 4> stress = {not_known, not_known, not_known, not_known};  ///< xx, xy, yx, yy
  double sigma_t_over_n = not_known;
  double stress_ratio = not_known;
  double volume_strain = not_known;
  double centre_of_mass_strain = not_known;
  double bulk_solid_fraction = not_known;
  double solid_fraction = not_known;
  std::vector<double> section_sigma_xx{};
  std::vector<double> gamma_density{};
  std::vector<double> gamma_error{};
  double gamma_mean = not_known;
  double gamma_share_above_one = not_known;
  double coordination_number = not_known;
  double coordination_number_of_all = not_known;
  double coordination_number_without_rattlers = not_known;
  double rattler_fraction = not_known;
  std::vector<double> direction_density{};
  std::vector<double> direction_density_by_force{};
  std::array<double, 3> direction_peak = {not_known, not_known, not_known};
  std::array<double, 2> fabric_amplitude = two_not_known;
  std::array<double, 2> fabric_angle = two_not_known;
  double mean_normal_force = not_known;
  std::vector<double> force_density{};
  std::vector<double> mobilisation_density{};
  double strong_share = not_known;
  double strong_share_of_mean_stress = not_known;
  double strong_share_of_deviator = not_known;
  double strong_stress_ratio = not_known;
  double weak_stress_ratio = not_known;
  std::array<double, 2> network_fabric_amplitude = two_not_known;  ///< strong, weak
  std::array<double, 2> network_fabric_angle = two_not_known;
  double texture_axis = not_known;
  double texture_contacts = not_known;
  double texture_normal_forces = not_known;
  double texture_tangential_forces = not_known;
  double texture_branches = not_known;
  double texture_stress_ratio = not_known;
  double coherent_share = not_known;
  double coherent_fabric = not_known;
  double incoherent_fabric = not_known;
  std::vector<double> weak_fabric_by_friction{};
  double critical_share = not_known;
  double critical_bound = not_known;
  double critical_share_of_bound = not_known;
  Index critical_clusters = 0;
  double critical_mean = not_known;
  double critical_weighted_mean = not_known;
  Index critical_largest = 0;
  double critical_correlation_length = not_known;
  std::vector<double> layer_critical_share{};
  std::vector<double> layer_critical_share_of_bound{};
  double local_shear = not_known;  ///< since the preceding frame, as the next three
  double local_shear_share = not_known;
  double nonaffine = not_known;
  double nonaffine_largest = not_known;
  double local_solid_fraction = not_known;
  double local_solid_fraction_spread = not_known;
  double granular_temperature = not_known;
  Index rigid_clusters = 0;
  double rigid_largest_share = not_known;
  double rigid_contact_share = not_known;
  double rigid_floppy_modes = not_known;
  double rigid_redundant = not_known;
  std::vector<double> network_components{};
  std::vector<double> network_loops{};
  double component_persistence = not_known;
  double loop_persistence = not_known;
  std::array<double, 2> network_change = two_not_known;  ///< components, loops
  std::vector<double> normal_force_correlation{};
  std::vector<double> gamma_correlation{};
  std::vector<double> mean_stress_correlation{};
  std::vector<FrameThreshold> thresholds{};  ///< one for each threshold of the run
};

/// A threshold and the transitions of the run that depend on it.
struct RunThreshold {
  double factor = not_known;
  double gamma = not_known;
  double end_ratio = not_known;
  double lc_jump = not_known;
  double lc_jump_error = not_known;
  double lc_jump_size = not_known;
  double percolation = not_known;
  double percolation_error = not_known;
};

/// Kind of an event. Distributions include only rearrangements.
enum class EventKind : Index {
  rearrangement = 0,
  failure = 1,     ///< the flow that made the slope fail, and later events
  unfinished = 2,  ///< not over at the end of the tilt
};

/// A rearrangement: a burst of motion between two quiet periods.
struct EventRecord {
  double begin = not_known;  ///< rad
  double end = not_known;    ///< rad
  double time = not_known;
  double duration = not_known;
  double waiting = not_known;
  Index kind = 0;  ///< EventKind
  double peak_velocity = not_known;
  double path = not_known;
  double energy = not_known;
  double volume_strain = not_known;
  double centre_of_mass_strain = not_known;
  double coordination_number = not_known;
  Index grains = 0;
  double depth = not_known;
  std::array<double, 2> centre = two_not_known;
  std::array<double, 2> frame_tilt = two_not_known;
  Index sharing = 0;
};

/// The analysis of a run. There are no thresholds if neither theta_c nor gamma_c is known.
struct Analysis {
  std::string key;   ///< hash of all inputs of the analysis
  Facts parameters;  ///< name and value as text, in the order of the table of parameters
  double theta_c = not_known;
  double first_slide = not_known;
  double gamma_c = not_known;
  double failure_ratio = not_known;
  double failure_ratio_spread = not_known;
  double lc_cut = not_known;
  std::vector<double> section_edge{};
  std::vector<double> gamma_edge{};
  std::array<double, 2> direction = two_not_known;
  std::vector<double> direction_edge{};
  std::vector<double> force_edge{};
  std::vector<double> mobilisation_edge{};
  std::vector<double> layer_edge{};
  std::array<double, 2> critical_exponent = two_not_known;  ///< for the mean size and for the weighted mean
  std::array<double, 2> critical_exponent_error = two_not_known;
  std::vector<double> network_threshold{};
  std::vector<double> correlation_distance{};
  /// Onset in the volume strain, in the centre-of-mass strain.
  std::array<double, 2> dilation = two_not_known;
  std::array<double, 2> dilation_low = two_not_known;
  std::array<double, 2> dilation_high = two_not_known;
  double event_threshold = not_known;
  double event_noise = not_known;
  double event_quiet_time = not_known;
  double event_count = not_known;
  double event_energy = not_known;
  double event_dilating_share = not_known;
  double event_dilating_share_error = not_known;
  double event_size_exponent = not_known;
  double event_size_exponent_error = not_known;
  double event_size_minimum = not_known;
  double event_size_distance = not_known;
  double event_size_count = not_known;
  double event_waiting_exponent = not_known;
  double event_waiting_exponent_error = not_known;
  double event_waiting_minimum = not_known;
  double event_waiting_distance = not_known;
  double event_waiting_count = not_known;
  double event_waiting_mean = not_known;
  double event_waiting_mean_error = not_known;
  std::vector<RunThreshold> thresholds{};
  std::vector<FrameRecord> frames{};
  std::vector<EventRecord> events{};  ///< ascending in time
};

}  // namespace talus::analysis
