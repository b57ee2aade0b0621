#pragma once
/// Frames of a dump of LAMMPS or LIGGGHTS, or of extended XYZ. Private to bed_table.h.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "session/bed_table.h"

namespace talus::session {

/// A frame, which is a table with named columns. Lengths as in the file.
struct DumpFrame {
  std::string label;           ///< "timestep 1000"; empty: none
  std::string names;           ///< names of its columns, separated by blanks; empty if it has none
  std::size_t names_line = 0;  ///< line of the names, from 1
  std::string_view rows;       ///< text from the row of its first grain to the end
  std::size_t count = 0;       ///< stated number of its grains
  std::size_t found = 0;       ///< number of rows found
  bool has_box = false;
  BoxEnds ends = BoxEnds::unknown;
  std::string units;                    ///< word after ITEM: UNITS, e.g. "si"; empty: none
  std::array<double, 3> low{}, high{};  ///< bounds of the box
  /// Message about its first fault, with its place, which concerns only those who read this frame; empty if
  /// it has none. A box that is not at right angles to the axes is one.
  std::string fault;
  std::size_t fault_line = 0;
};

/// Removes the first line from a text and returns it, after lines that are only a comment, which are counted
/// in `line` as well.
std::string_view take_row(std::string_view& rest, std::size_t& line);

/// Returns the frames in order; none for a text in another format. Throws LocatedError(bad_data) for a line
/// before the first frame that does not belong to such a file.
std::vector<DumpFrame> dump_frames(std::string_view text, const std::string& name);

}  // namespace talus::session
