#pragma once
/// What one member of an ensemble gives to tables and averages, in the units of tables: the numbers of its
/// run, its series over the tilt, and its distributions, correlations and tensors in each frame.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "analysis/record.h"
#include "io/run_file.h"

namespace talus::ensemble {

struct NamedNumber {
  std::string name;  ///< "theta_c", "theta_d/lc_jump[1]": element 1, of those with several
  std::string unit;  ///< of tables: deg, D, ...
  double value = 0.0;
};

struct MemberNumbers {
  std::string state_hash;
  std::string version;   ///< of the Talus that computed it, with its git hash
  double seconds = 0.0;  ///< of its steps
  std::vector<NamedNumber> numbers;
};

struct NamedSeries {
  std::string name;            ///< "overloaded/fraction", "overloaded/fraction[1]": at threshold 1
  std::string unit;            ///< of tables: deg, D, ...
  std::vector<double> values;  ///< by frame; NaN where there is none
};

struct MemberSeries {
  std::vector<double> theta;  ///< deg, ascending
  std::vector<NamedSeries> series;
};

/// A list of so many numbers in each frame, or once.
struct NamedList {
  std::string name;        ///< "gamma/density", "clusters/directed_height[1]": at threshold 1
  std::string unit;        ///< of tables: deg, D, ...
  std::string definition;  ///< one sentence
  std::size_t width = 0;
  std::vector<double> values;  ///< frame by frame; NaN where there is none
};

struct MemberLists {
  std::vector<double> theta;    ///< deg, ascending
  std::vector<NamedList> bins;  ///< edges and middles of bins, once
  std::vector<NamedList> lists;
};

/// What a member that is done has given.
struct MemberResult {
  std::uint64_t seed = 0;
  MemberNumbers numbers;  ///< without any where its run is not analysed, as members are, by this version
  MemberSeries series;
  MemberLists lists = {};
  bool has_frames = true;  ///< its file has more than its analysis
};

/// All numbers of a complete run and its analysis (analysis/failure/place.h), then what the run found by
/// itself (theta_r).
MemberNumbers member_numbers(const io::RunFile& run, const analysis::Analysis& analysis);

/// The frames up to theta_c, or all of a slope that has not failed. Where the tilt goes up and down, those of
/// its last_rise; of a hold the first one.
std::vector<const analysis::FrameRecord*> frames_to_failure(const analysis::Analysis& analysis);

/// Of these frames, in the order of the table of quantities. `mean_diameter` (m) is the D of its lengths.
MemberSeries member_series(const analysis::Analysis& analysis, double mean_diameter);

/// Of these frames, in this order. Directions of axes are left out: known up to half a turn, they have no
/// mean.
MemberLists member_lists(const analysis::Analysis& analysis, double mean_diameter);

/// The names that members have numbers of, the first of each: "theta_d/dilation", not "theta_d/dilation[1]".
std::vector<std::string> numbers_of_run();

/// Whether it is one of these names, or a further one of it ("theta_d/dilation[1]").
bool is_number_of_run(const std::string& name);

/// NaN where there is no such number.
double number_called(const MemberNumbers& numbers, const std::string& name);

/// "theta_d/lc_jump[1]": element k of what has several; element 0 has the plain name.
std::string element_name(const std::string& name, std::size_t k);

}  // namespace talus::ensemble
