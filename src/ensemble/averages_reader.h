#pragma once
/// Reads the values of the members of an ensemble from its ensemble.h5 (docs/ensembles.md).

#include <cstddef>
#include <string>
#include <vector>

#include "ensemble/averages.h"
#include "runs/run_view.h"

namespace talus::ensemble {

/// A quantity of all members, as stored in the file.
struct StoredQuantity {
  std::string name;
  std::string unit;
  std::vector<double> values;  ///< members x points
};

/// One variant of ensemble.h5.
struct StoredVariant {
  std::string name;      ///< empty if there is only one variant
  std::string scenario;  ///< TOML with every key
  std::vector<std::uint64_t> seeds;
  std::vector<std::string> state_hashes;
  std::vector<StoredQuantity> numbers;
  std::vector<double> tilts;  ///< deg, grid of over_tilt
  std::vector<StoredQuantity> over_tilt;
  std::vector<double> angles_left;  ///< deg, grid of before_failure; empty if no slope failed
  std::vector<StoredQuantity> before_failure;
};

/// Whether a file begins like an ensemble.h5, even if it is damaged.
bool holds_averages(const std::string& path);

/// Reads ensemble.h5. Throws Error(missing_input) if the file does not exist, and Error(bad_data) if
/// write_averages cannot have written it.
std::vector<StoredVariant> read_averages(const std::string& path);

/// Returns the stored results of member m. Its series contain the points of both grids at which it has
/// values. With those of before_failure they extend to the last frame before theta_c, and between two points
/// they equal the interpolation between frames.
MemberResult member_of(const StoredVariant& variant, std::size_t m);

/// Rebuilds the analysis of such a member, with all scalar results, and one frame for each row of its series.
/// Quantities with several values (distributions, fabric, grains) are empty, and quantities that the file
/// lacks are unknown. The analysis parameters are the defaults, with which members are analysed.
/// `mean_diameter` is D, m.
analysis::Analysis analysis_of(const MemberResult& member, double mean_diameter);

/// Returns member m as a run without a run file; `path` is the path of ensemble.h5. Throws Error(bad_data) if
/// its scenario cannot be read.
runs::RunView view_of_values(const std::string& path, const StoredVariant& variant, std::size_t m);

}  // namespace talus::ensemble
