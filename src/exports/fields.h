#pragma once
/// The quantities of a frame (frame_quantities.h) as columns, in the order of their table, which all writers
/// follow; and the names that other programs use for some of them. Centres of grains are excluded, because
/// each format stores them in its own place.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/frame_quantities.h"

namespace talus::exports {

/// A quantity of a frame.
struct FieldColumn {
  const analysis::FrameQuantity& field;
  std::string ending;          ///< suffix of its threshold, if it has one: "_1_5" for 1.5
  std::vector<double> values;  ///< one entry per row

  std::string name() const { return std::string(field.name) + ending; }
};

/// Number of columns of grains, id and type, that precede the centre in tables.
inline constexpr std::size_t columns_before_centre = 2;

/// Returns the columns of all grains, floor included, in the order of their ids.
std::vector<FieldColumn> grain_columns(const analysis::GrainSource& frame);
/// Returns the columns of all contacts, in the order of their keys.
std::vector<FieldColumn> contact_columns(const analysis::GrainSource& frame);

/// Returns the names of a column's components in tables: "velocity_x", "velocity_y", "lc_1_5".
std::vector<std::string> component_names(const FieldColumn& column);

/// Returns the name in extended XYZ by which OVITO recognises the quantity.
std::string xyz_name(const FieldColumn& column);
/// Returns the names of the components in a LAMMPS dump, separated by blanks.
std::string lammps_names(const FieldColumn& column);

}  // namespace talus::exports
