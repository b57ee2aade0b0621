#pragma once
/// Averages over the members of a variant of an ensemble, and their files (docs/ensembles.md): ensemble.h5,
/// which has all of them and the analyses of the members, and averages.csv.
///
/// Every scalar result of the runs is averaged, and every quantity of their frames on two grids: of tilt, and
/// of theta_c - theta. Values between frames are interpolated linearly and never extrapolated, so that a
/// member contributes up to its last frame before theta_c.

#include <cstddef>
#include <string>
#include <vector>

#include "core/statistics.h"
#include "ensemble/member_results.h"
#include "runs/run_view.h"

namespace talus::ensemble {

/// A quantity at the points of a grid, averaged over the members that have it there.
struct AveragedQuantity {
  std::string name;  ///< for example "overloaded/fraction"; "overloaded/fraction[1]" is at threshold 1
  std::string unit;  ///< unit in tables: deg, D, ...
  std::string definition;
  bool is_list = false;                 ///< a distribution, a correlation or a tensor, without quartiles
  std::size_t width = 1;                ///< numbers at each point
  std::vector<Summary> summaries = {};  ///< points x width
};

struct AveragedCurves {
  std::vector<double> angles;  ///< deg, multiples of the frame spacing, starting at 0
  std::vector<AveragedQuantity> quantities;
};

/// The members of a variant and their averages.
struct VariantAverages {
  std::string name;                          ///< name of the variant; empty if there is only one
  std::string scenario;                      ///< TOML with every key
  std::vector<const MemberResult*> members;  ///< ascending by seed
  std::vector<AveragedQuantity> numbers;     ///< scalar results, each with one point
  AveragedCurves over_tilt;
  AveragedCurves before_failure;  ///< grid of theta_c - theta; no quantities if no slope failed
};

/// Averages members. `frame_every` is the spacing of the grids, deg. Lists are averaged over the members with
/// the bins of the first one. The result depends only on the set of members, not on the order in which they
/// finished.
VariantAverages averages_of(std::string name, std::string scenario, std::vector<const MemberResult*> members,
                            double frame_every);

/// Interpolates a series linearly at `theta` (deg); NaN outside the range of its frames.
double interpolated(const std::vector<double>& tilts, const std::vector<double>& values, double theta);

/// Returns a CSV row for each scalar quantity at each angle: variant, grid, angle, quantity, unit, n, mean,
/// standard deviation, standard error, 95 % interval of the mean, quartiles.
std::string averages_csv(const std::vector<VariantAverages>& variants);

/// Writes ensemble.h5. Throws the errors of write_durably.
void write_averages(const std::string& path, const std::vector<VariantAverages>& variants,
                    const std::string& version);

/// Reads the members of all variants from ensemble.h5, as runs without a run file: their analyses have the
/// scalars of the run, of each threshold and of each frame. Throws Error(missing_input) if the file does not
/// exist, and Error(bad_data) if write_averages cannot have written it.
std::vector<runs::RunView> read_averages(const std::string& path);

}  // namespace talus::ensemble
