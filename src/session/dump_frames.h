#pragma once
/// Frames of a dump of LAMMPS or LIGGGHTS, or of extended XYZ. Private to bed_table.h.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenario/scenario.h"

namespace talus::session {

/// A frame, which is a table with named columns. Lengths as in the file.
struct DumpFrame {
  std::string label;           ///< "timestep 1000"; empty: none
  std::string names;           ///< names of its columns, separated by blanks; empty if it has none
  std::size_t names_line = 0;  ///< line of the names, from 1
  std::string_view rows;       ///< text from the row of its first grain to the end
  std::size_t count = 0;       ///< stated number of its grains
  std::size_t found = 0;       ///< number of lines found
  bool has_box = false, periodic = false;    ///< periodic: along x
  std::optional<scenario::LengthUnit> unit;  ///< unit of ITEM: UNITS
  std::array<double, 3> low{}, high{};       ///< bounds of the box
};

/// Returns the frames in order; none for a text in another format. Throws LocatedError(bad_data) at the first
/// line that does not belong to such a file, and for a box that is not at right angles to the axes.
std::vector<DumpFrame> dump_frames(std::string_view text, const std::string& name);

}  // namespace talus::session
