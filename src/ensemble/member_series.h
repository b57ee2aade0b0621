#pragma once
/// What one member of an ensemble gave over its tilt: every quantity with one number a frame, in a table
/// beside its run.

#include <string>
#include <vector>

#include "analysis/record.h"

namespace talus {

struct NamedSeries {
  std::string name;            ///< "overloaded/fraction", "overloaded/fraction[1]": at threshold 1
  std::string unit;            ///< of tables: deg, D, ...
  std::vector<double> values;  ///< by frame; NaN where there is none
};

struct MemberSeries {
  std::vector<double> theta;  ///< deg, ascending
  std::vector<NamedSeries> series;
};

/// The frames up to theta_c, or all of a slope that has not failed. Where the tilt goes up and down, those of
/// its last_rise; of a hold the first one.
std::vector<const FrameRecord*> frames_to_failure(const Analysis& analysis);

/// Of these frames, in the order of the table of quantities. `mean_diameter` (m) is the D of its lengths.
MemberSeries member_series(const Analysis& analysis, double mean_diameter);

/// CSV: theta, then a column for each series, a row for each frame, with full digits.
std::string series_csv(const MemberSeries& series);

/// Throws Error(bad_data), naming `path`, where the text is not what series_csv writes.
MemberSeries parse_series(const std::string& text, const std::string& path);

/// The file of it beside a run.
inline constexpr const char* series_ending = ".series.csv";
std::string series_path(const std::string& run);

}  // namespace talus
