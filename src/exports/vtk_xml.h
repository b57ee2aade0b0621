#pragma once
/// What the XML files of VTK have in common.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/frame_quantities.h"
#include "exports/fields.h"

namespace talus::exports {

/// What an array says of itself.
struct VtkArray {
  std::string name;
  std::size_t components = 1;
  std::string_view unit = {};  ///< empty: none
};

/// A DataArray, binary; of float, double, std::int32_t or std::int64_t.
template <typename Number>
std::string vtk_array(const VtkArray& head, const std::vector<Number>& values);

/// One of a field, in the numbers that it has. In three dimensions, as VTK wants it: vectors end with a zero,
/// tensors get a row and a column of zeros.
std::string vtk_field(const VtkArray& head, analysis::FieldShape shape, analysis::FieldNumber number,
                      const std::vector<double>& values);

/// A file with a data set of a type, "PolyData", whose `attributes` begin with a blank, and a piece of it;
/// and with the time and the tilt of the frame.
std::string vtk_file(const analysis::GrainSource& frame, std::string_view type, const std::string& attributes,
                     const std::string& piece);

/// "LittleEndian" or "BigEndian", as this machine is.
std::string_view vtk_byte_order();

}  // namespace talus::exports
