#pragma once
/// The quantities of a frame (frame_quantities.h) as columns, in the order of their table, which all writers
/// go by; and what other programs call some of them. Centres of grains are not among them: each format has a
/// place of its own for these.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/frame_quantities.h"

namespace talus::exports {

/// A quantity of a frame.
struct FieldColumn {
  const analysis::FrameQuantity& field;
  std::string ending;          ///< "_1.5" as "_1_5": of its threshold, if it has one
  std::vector<double> values;  ///< row by row

  std::string name() const { return std::string(field.name) + ending; }
};

/// In tables these columns of grains, id and type, come before the centre.
inline constexpr std::size_t columns_before_centre = 2;

/// Of all grains, floor included, in the order of their ids.
std::vector<FieldColumn> grain_columns(const analysis::GrainSource& frame);
/// Of all contacts, in the order of their keys.
std::vector<FieldColumn> contact_columns(const analysis::GrainSource& frame);

/// Names of the components of a column in tables: "velocity_x", "velocity_y", "lc_1_5".
std::vector<std::string> component_names(const FieldColumn& column);

/// The name in extended XYZ, by which OVITO knows it.
std::string xyz_name(const FieldColumn& column);
/// Those of the components in a LAMMPS dump, with blanks between.
std::string lammps_names(const FieldColumn& column);

}  // namespace talus::exports
