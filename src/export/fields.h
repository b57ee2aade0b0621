#pragma once
/// What is exported of the grains and of the contacts of a frame, in one table each: what a field is called
/// in each format, its unit and its meaning, and where its values come from. All writers go by them, and
/// docs/export.md is compared with them by a test. Centres of grains are not among them: each format has a
/// place of its own for these.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "export/exported_frame.h"

namespace talus {

/// Components: 1; x, y; xx, xy, yx, yy.
enum class FieldShape { scalar = 1, vector = 2, tensor = 4 };

/// Which numbers a field has: what the run file stores in single precision has no more digits than that.
enum class FieldNumber { integer, single, real };

/// Values row by row, `threshold` being that of a field that depends on one.
using FieldValues = std::vector<double> (*)(const ExportedFrame& frame, std::size_t threshold);

struct Field {
  std::string_view name;    ///< in ParaView; in CSV and GraphML with _x or _xx for each component
  std::string_view xyz;     ///< in extended XYZ, by which OVITO knows it; empty: as `name`
  std::string_view lammps;  ///< columns of a LAMMPS dump, with blanks between; empty: as in CSV
  FieldShape shape = FieldShape::scalar;
  FieldNumber number = FieldNumber::real;
  std::string_view unit;        ///< SI, or "1"
  std::string_view definition;  ///< one sentence
  FieldValues values = nullptr;
  bool by_threshold = false;  ///< there is one for each threshold, with its factor at the end of the name
};

std::span<const Field> grain_fields();
std::span<const Field> contact_fields();

/// A field of a frame.
struct FieldColumn {
  const Field& field;
  std::string ending;          ///< "_1.5" as "_1_5": of its threshold, if it has one
  std::vector<double> values;  ///< row by row

  std::string name() const { return std::string(field.name) + ending; }
};

/// In tables these columns of grains, id and type, come before the centre.
inline constexpr std::size_t columns_before_centre = 2;

/// Of all grains, floor included, in the order of their ids.
std::vector<FieldColumn> grain_columns(const ExportedFrame& frame);
/// Of all contacts, in the order of their keys.
std::vector<FieldColumn> contact_columns(const ExportedFrame& frame);

/// Names of the components of a column in tables: "velocity_x", "velocity_y".
std::vector<std::string> component_names(const FieldColumn& column);

inline std::size_t components(const Field& field) { return static_cast<std::size_t>(field.shape); }

}  // namespace talus
