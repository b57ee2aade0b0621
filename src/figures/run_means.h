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

/// The tilts at which at least half of some runs have a frame, and which frames these are.
struct CommonTilts {
  std::vector<double> tilts;                 ///< rad, ascending
  std::vector<std::vector<Sample>> samples;  ///< of each tilt, by run
};

/// `tilts`: those of the frames of each run, rad, ascending. Tilts within 1e-6 rad of each other are the
/// same.
CommonTilts common_tilts(std::span<const std::vector<double>> tilts);

/// Columns theta, in deg, and n, the number of runs behind a row.
std::vector<Column> tilt_columns(const CommonTilts& common);

/// The column `mean` with the means over runs of `values`, one for each frame of each run, NAME_error with
/// their standard errors, and NAME_deviation with the standard deviations of the runs. Values that are NaN do
/// not count; one value has neither.
std::vector<Column> mean_columns(const CommonTilts& common, std::span<const std::vector<double>> values,
                                 Column mean);

/// What captions say of such means.
inline constexpr const char* means_caption =
    "Means over the runs of each group at the same tilt, while at least half of them have not failed. The "
    "dark band is the standard error of the mean, the light one the standard deviation of the runs; thin "
    "lines are the runs themselves, the first 100 of them. A single run has none of these.";

/// theta_c of a run, rad; NaN where the slope has not failed.
double theta_c_of(const runs::RunView& run);

/// The frame of the last rise whose tilt is nearest to `tilt`, rad.
std::size_t frame_nearest(const runs::RunView& run, double tilt);

/// Whether the slope was tilted up to `tilt`, rad, before it failed.
bool stands_at(const runs::RunView& run, double tilt);

/// A number of each frame of a run; what is not there is NaN.
struct FrameColumn {
  std::string name, unit, meaning;  ///< as Column has them
  std::function<double(const runs::RunView& run, std::size_t frame)> value;
  bool has_side = false;  ///< has the other sign where the bed slopes to the other side (last_rise.h)
};
/// A quantity of frames, in the unit of tables; at threshold f where it depends on one.
FrameColumn column_of(const std::string& name, const analysis::Quantity& quantity, std::size_t f = 0);

/// What curves are drawn over: the tilt, or the angle that is left to the theta_c of each run, at multiples
/// of output.frame_every, between two frames.
enum class Abscissa { tilt, angle_left };

/// Over the last rise of each run: the angle (theta or angle_left), n, and the mean, error and deviation of
/// each column, over the frames of the runs up to the theta_c of each.
std::vector<Column> means_over_runs(std::span<const runs::RunView* const> runs,
                                    std::span<const FrameColumn> columns_of_frames,
                                    Abscissa abscissa = Abscissa::tilt);

/// The runs that are drawn one by one behind their mean are no more than this.
inline constexpr std::size_t most_runs_drawn = 100;

/// seed, the angle and each column, run by run, of the first most_runs_drawn.
std::vector<Column> runs_one_by_one(std::span<const runs::RunView* const> runs,
                                    std::span<const FrameColumn> columns_of_frames,
                                    Abscissa abscissa = Abscissa::tilt);

}  // namespace talus::figures
