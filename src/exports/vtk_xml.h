#pragma once
/// Elements shared by the XML files of VTK.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/frame_quantities.h"
#include "exports/fields.h"

namespace talus::exports {

/// The description of an array.
struct VtkArray {
  std::string name;
  std::size_t components = 1;
  std::string_view unit = {};  ///< empty: none
};

/// Returns a binary DataArray of float, double, std::int32_t or std::int64_t.
template <typename Number>
std::string vtk_array(const VtkArray& head, const std::vector<Number>& values);

/// Returns a DataArray of a field in its number type, extended to three dimensions as VTK requires: vectors
/// end with a zero, tensors get a row and a column of zeros.
std::string vtk_field(const VtkArray& head, analysis::FieldShape shape, analysis::FieldNumber number,
                      const std::vector<double>& values);

/// Returns a file with a data set of a type, such as "PolyData", whose `attributes` begin with a blank, and a
/// piece of it; and with the time and the tilt of the frame.
std::string vtk_file(const analysis::GrainSource& frame, std::string_view type, const std::string& attributes,
                     const std::string& piece);

/// Returns the byte order of this machine, "LittleEndian" or "BigEndian".
std::string_view vtk_byte_order();

}  // namespace talus::exports
