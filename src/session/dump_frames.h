#pragma once
/// The frames of a dump of LAMMPS or LIGGGHTS, or of extended XYZ. Private to bed_table.h.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenario/scenario.h"

namespace talus::session {

/// One frame: a table whose columns have names. Lengths as in the file.
struct DumpFrame {
  std::string label;           ///< "timestep 1000"; empty: none
  std::string names;           ///< of its columns, with blanks between; empty where there are none
  std::size_t names_line = 0;  ///< from 1
  std::string_view rows;       ///< from the first of its grains to the end of the text
  std::size_t count = 0;       ///< of its grains, as it says
  std::size_t found = 0;       ///< lines that are there
  bool has_box = false, periodic = false;    ///< along x
  std::optional<scenario::LengthUnit> unit;  ///< of ITEM: UNITS
  std::array<double, 3> low{}, high{};       ///< of the box
};

/// The frames in their order; none in a text of another form. Throws LocatedError(bad_data) at the first line
/// that does not belong to such a file, and for a box that is not at right angles to the axes.
std::vector<DumpFrame> dump_frames(std::string_view text, const std::string& name);

}  // namespace talus::session
