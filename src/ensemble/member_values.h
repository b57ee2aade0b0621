#pragma once
/// The results of one ensemble member for tables and averages, in the units of tables: scalar results, series
/// over tilt, and the distributions, correlations and tensors of each frame.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "analysis/record.h"
#include "io/run_file.h"

namespace talus::ensemble {

struct NamedNumber {
  std::string name;  ///< for example "theta_c"; "theta_d/lc_jump[1]" is element 1 of several
  std::string unit;  ///< unit in tables: deg, D, ...
  double value = 0.0;
};

struct MemberNumbers {
  std::string state_hash;
  std::string version;   ///< version and git hash of the Talus that computed it
  double seconds = 0.0;  ///< wall time of its steps
  std::vector<NamedNumber> numbers;
};

struct NamedSeries {
  std::string name;  ///< for example "overloaded/fraction"; "overloaded/fraction[1]" is at threshold 1
  std::string unit;  ///< unit in tables: deg, D, ...
  std::vector<double> values;  ///< one per frame; NaN if there is none
};

struct MemberSeries {
  std::vector<double> theta;  ///< deg, ascending
  std::vector<NamedSeries> series;
};

/// A list of `width` numbers in each frame, or once.
struct NamedList {
  std::string name;        ///< for example "gamma/density"; "clusters/directed_height[1]" is at threshold 1
  std::string unit;        ///< unit in tables: deg, D, ...
  std::string definition;  ///< one sentence
  std::size_t width = 0;
  std::vector<double> values;  ///< frame by frame; NaN if there is none
};

struct MemberLists {
  std::vector<double> theta;    ///< deg, ascending
  std::vector<NamedList> bins;  ///< edges and centres of bins, stored once
  std::vector<NamedList> lists;
};

/// The results of a completed member.
struct MemberResult {
  std::uint64_t seed = 0;
  MemberNumbers numbers;  ///< without numbers if this version has not analysed its run
  MemberSeries series;
  MemberLists lists = {};
  bool has_frames = true;  ///< its file contains frames as well as the analysis
};

/// Returns all scalar results of a complete run and of its analysis (analysis/failure/place.h), and then
/// those that the run itself computes (theta_r).
MemberNumbers member_numbers(const io::RunFile& run, const analysis::Analysis& analysis);

/// Returns the frames up to theta_c, or all frames of a slope that has not failed. If the tilt goes up and
/// down, these are the frames of its last_rise; of a hold only the first frame is returned.
std::vector<const analysis::FrameRecord*> frames_to_failure(const analysis::Analysis& analysis);

/// Returns the series over frames_to_failure, in the order of the table of quantities. `mean_diameter` (m) is
/// the unit D of lengths.
MemberSeries member_series(const analysis::Analysis& analysis, double mean_diameter);

/// Returns the lists of frames_to_failure. Directions of axes are left out: they are defined only up to half
/// a turn and have no mean.
MemberLists member_lists(const analysis::Analysis& analysis, double mean_diameter);

/// Returns the names of all scalar results, only the first of several elements: "theta_d/dilation", not
/// "theta_d/dilation[1]".
std::vector<std::string> numbers_of_run();

/// Whether a name is one of numbers_of_run(), or a further element of it ("theta_d/dilation[1]").
bool is_number_of_run(const std::string& name);

/// Returns the scalar result of that name; NaN if there is none.
double number_called(const MemberNumbers& numbers, const std::string& name);

/// Returns the name of element k of a result with several, such as "theta_d/lc_jump[1]"; element 0 has the
/// plain name.
std::string element_name(const std::string& name, std::size_t k);

}  // namespace talus::ensemble
