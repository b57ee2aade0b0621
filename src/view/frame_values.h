#pragma once
/// What curves, landmarks and cluster colours need of each frame.

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/snapshot.h"
#include "io/analysis_record.h"
#include "io/run_file.h"
#include "maps/maps.h"

namespace talus {

/// NaN: not known, or there is none.
struct FrameValues {
  double tilt = 0.0;                                             ///< rad
  double overloaded = std::numeric_limits<double>::quiet_NaN();  ///< p_o
  double largest_share =
      std::numeric_limits<double>::quiet_NaN();  ///< overloaded grains in the largest cluster
  double mean_length = std::numeric_limits<double>::quiet_NaN();  ///< l_c, D
  double largest_length = std::numeric_limits<double>::quiet_NaN();
  bool spans = false;  ///< a cluster reaches from the floor to the surface
};

/// What these values depend on beside the frame.
struct OverloadRule {
  double theta_c = 0.0;  ///< rad
  double threshold_factor = 1.0;
  bool joined_by_neighbours = false;
  double l_min = default_l_min;  ///< D
  bool operator==(const OverloadRule&) const = default;
};
OverloadRule overload_rule(const MapSettings& settings);
/// Stress ratio from which on a grain is overloaded.
double threshold_of(const OverloadRule& rule);

/// Diameter at which the search for l_c ends, m: min(H, L/2), and not below l_min (D), as `talus analyze` has
/// it.
double length_cut(const RunStatics& statics, double l_min);

/// p_o and l_c of a frame of mapped_frame; what clusters tell is left open.
FrameValues overload_values(const Frame& frame, const RunStatics& statics, const OverloadRule& rule);

/// The analysis in the file at `path` of a run, if it has one that is of this run and of single frames as
/// they are (no averaging, min_contacts 1, l_c up to length_cut). Throws as read_analysis does.
std::optional<Analysis> read_usable_analysis(const std::string& path, const RunFile& run);

/// Which of its thresholds is that of the rule, with the same l_min and joining, and l_c that ends there;
/// none where none is.
std::optional<std::size_t> find_threshold(const Analysis& analysis, const OverloadRule& rule);

/// Of all frames of the tilt (rad), with threshold f of an analysis.
std::vector<FrameValues> stored_values(const Analysis& analysis, std::size_t f, const RunStatics& statics,
                                       const std::vector<double>& tilts);

}  // namespace talus
