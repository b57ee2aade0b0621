#pragma once
/// The values of the members of an ensemble, read back from its ensemble.h5 (docs/ensembles.md).

#include <cstddef>
#include <string>
#include <vector>

#include "ensemble/averages.h"
#include "runs/run_view.h"

namespace talus::ensemble {

/// A quantity of all members, as it stands in the file.
struct StoredQuantity {
  std::string name;
  std::string unit;
  std::vector<double> values;  ///< member by member, in each by point
};

/// One variant of ensemble.h5.
struct StoredVariant {
  std::string name;      ///< empty for the only one
  std::string scenario;  ///< TOML, every key
  std::vector<std::uint64_t> seeds;
  std::vector<std::string> state_hashes;
  std::vector<StoredQuantity> numbers;
  std::vector<double> tilts;  ///< deg, of over_tilt
  std::vector<StoredQuantity> over_tilt;
  std::vector<double> angles_left;  ///< deg, of before_failure; empty where no slope failed
  std::vector<StoredQuantity> before_failure;
};

/// Whether it begins as one of these, sound or not.
bool holds_averages(const std::string& path);

/// Throws Error(missing_input) where there is no such file, and Error(bad_data) where it is not what
/// write_averages makes.
std::vector<StoredVariant> read_averages(const std::string& path);

/// What the file knows of member m. Its series have the points of both grids at which it has values: with
/// those of before_failure they are known up to the last frame before theta_c, and a straight line between
/// two points is that of the frames.
MemberResult member_of(const StoredVariant& variant, std::size_t m);

/// The analysis of such a member: all its numbers of a run and of its frames, and a frame for each row of its
/// series. What is no single number (distributions, fabric, grains) is empty, and what the file does not have
/// is not known. It is that of the default parameters, with which members are analysed. `mean_diameter`: D,
/// m.
analysis::Analysis analysis_of(const MemberResult& member, double mean_diameter);

/// Member m as a run whose file is not there; `path` is that of ensemble.h5. Throws Error(bad_data) where its
/// scenario cannot be read.
runs::RunView view_of_values(const std::string& path, const StoredVariant& variant, std::size_t m);

}  // namespace talus::ensemble
