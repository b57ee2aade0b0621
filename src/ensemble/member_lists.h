#pragma once
/// What one member of an ensemble gave over its tilt in lists: the distributions, correlations and tensors of
/// each frame, in a file beside its run.

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/record.h"

namespace talus {

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

/// Of the frames up to theta_c, or of all of a slope that has not failed, in the order of the table of
/// quantities. Directions of axes are left out: known up to half a turn, they have no mean. `mean_diameter`
/// (m) is the D of its lengths.
MemberLists member_lists(const Analysis& analysis, double mean_diameter);

/// Puts them where they came from, frame by frame; those that the table of quantities does not know are
/// passed over. `analysis` has the same frames and thresholds.
void set_lists(const MemberLists& lists, double mean_diameter, Analysis& analysis);

/// The file beside a run, HDF5, and what is in it. Throw as write_durably does, and Error(bad_data) where the
/// file is not what write_lists makes.
void write_lists(const std::string& path, const MemberLists& lists);
MemberLists read_lists(const std::string& path);
inline constexpr const char* lists_ending = ".lists.h5";
std::string lists_path(const std::string& run);

}  // namespace talus
