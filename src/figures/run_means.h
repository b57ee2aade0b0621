#pragma once
/// Means over the runs of a group at the same tilt, as columns of figures.

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "analysis/quantities.h"
#include "figures/figure.h"
#include "figures/run_group.h"

namespace talus::figures {

/// Frame `frame` of run `run`.
struct Sample {
  std::size_t run = 0;
  std::size_t frame = 0;
};

/// Tilts at which at least half of the runs have a frame, and these frames.
struct CommonTilts {
  std::vector<double> tilts;                 ///< rad, ascending
  std::vector<std::vector<Sample>> samples;  ///< samples at each tilt, by run
};

/// Finds the common tilts. `tilts`: those of the frames of each run, rad, ascending. Tilts within 1e-6 rad of
/// each other are equal.
CommonTilts common_tilts(std::span<const std::vector<double>> tilts);

/// Returns the columns theta, in deg, and n, the number of runs in each row.
std::vector<Column> tilt_columns(const CommonTilts& common);

/// Returns the column `mean` with the means over runs of `values`, one value for each frame of each run,
/// NAME_error with their standard errors, and NAME_deviation with the standard deviations over the runs. NaN
/// values are ignored; a single value has neither error nor deviation.
std::vector<Column> mean_columns(const CommonTilts& common, std::span<const std::vector<double>> values,
                                 Column mean);

/// Explanation of such means for captions.
inline constexpr const char* means_caption =
    "Means over the runs of each group at the same tilt, as long as at least half of them have not failed. "
    "The dark band is the standard error of the mean, the light one the standard deviation of the runs; thin "
    "lines are the single runs, at most 100 of them. A single run has none of these.";

/// Returns theta_c of a run, rad; NaN if the slope has not failed.
double theta_c_of(const runs::RunView& run);

/// Returns the frame of the last rise with the tilt nearest to `tilt`, rad.
std::size_t frame_nearest(const runs::RunView& run, double tilt);

/// Whether the slope was tilted up to `tilt`, rad, before it failed.
bool has_frame_near(const runs::RunView& run, double tilt);

/// A number for each frame of a run; NaN for a missing value.
struct FrameColumn {
  std::string name, unit, meaning;  ///< see Column
  std::function<double(const runs::RunView& run, std::size_t frame)> value;
  bool has_side = false;  ///< whether the sign changes if the bed slopes backwards (last_rise.h)
};
/// Returns the column of a quantity of frames in the unit of tables, at threshold f if it depends on one.
FrameColumn column_of(const std::string& name, const analysis::Quantity& quantity, std::size_t f = 0);

/// Abscissa of curves: the tilt, or the angle left to theta_c of each run, interpolated at multiples of
/// output.frame_every.
enum class Abscissa { tilt, angle_left };

/// Returns means over the last rise of each run up to its theta_c: the angle (theta or angle_left), n, and
/// the mean, error and deviation of each column.
std::vector<Column> means_over_runs(std::span<const runs::RunView* const> runs,
                                    std::span<const FrameColumn> columns_of_frames,
                                    Abscissa abscissa = Abscissa::tilt);

/// Largest number of single runs that are drawn behind their mean.
inline constexpr std::size_t max_runs_drawn = 100;

/// Returns the seed, the angle and each column, run by run, for the first max_runs_drawn runs.
std::vector<Column> individual_runs(std::span<const runs::RunView* const> runs,
                                    std::span<const FrameColumn> columns_of_frames,
                                    Abscissa abscissa = Abscissa::tilt);

}  // namespace talus::figures
