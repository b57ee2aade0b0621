#pragma once
/// Tables of the quantities of each grain and each contact of a frame: name, components, unit, definition,
/// what the quantity needs, its values, and how a map shows it. Maps, exports and the library use these
/// tables; tests compare docs/export.md and docs/python.md with them.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/record.h"
#include "core/snapshot.h"

namespace talus::analysis {

/// A frame and the data needed to compute the quantities of its grains.
struct GrainSource : BedFrame {     // the frame as stored, with the gamma of single grains
  const Frame* earlier = nullptr;   ///< reference frame of motion; null if it does not exist yet
  bool per_degree = true;           ///< whether maps show motion per degree of tilt
  std::size_t number = 0;           ///< number of the frame in the run, counted from 0
  std::span<const double> gamma{};  ///< gamma of the neighbourhood of each grain
  /// First frame of the run, the reference of displacements; null if it does not exist yet.
  const Frame* first = nullptr;
  std::span<const double> factors{};             ///< thresholds, in units of Gamma_c
  std::span<const FrameThreshold> thresholds{};  ///< l_c and clusters at each of them
  /// Degrees of tilt since the earlier frame, by which the deformation is divided; 1 for no division.
  double degrees = 1.0;
  double length = not_known;  ///< diameter over which fields are coarse-grained, m
};

/// Number of components: 1; x, y; or xx, xy, yx, yy.
enum class FieldShape { scalar = 1, vector = 2, tensor = 4 };

/// Type of the values. Numbers stored in single precision in the run file are written with no more digits.
enum class FieldNumber { integer, single, real };

/// Input that a quantity needs in addition to the frame.
enum class FrameNeed { nothing, threshold, earlier_frame, length };

/// Colour scale of the map of a grain quantity.
enum class ScaleRule {
  none,        ///< no map
  fixed,       ///< linear, from low to high
  by_depth,    ///< linear, from 0 to the depth of the bed in D times high, rounded up
  sizes,       ///< logarithmic; over the range in the drawn frames, or from low to high
  about_zero,  ///< symmetric about 0; over the range in the drawn frames, or up to high
};

/// The map of a grain quantity. Texts are rich text (render/frame_view.h); the unit is that of bed_unit.
struct MapRule {
  std::string_view name, help;  ///< name of the map, and one line of help
  /// Title ("Speed of grains"), label of the colour bar ("speed (√(gD))"), and short form.
  std::string_view title, bar, symbol;
  ScaleRule scale = ScaleRule::none;
  double low = 0.0, high = 1.0;
  bool outlines = false;       ///< only outlines are drawn for grains without a value
  std::string_view without{};  ///< description of these grains in the legend
  double low_per_degree = low, high_per_degree = high;  ///< range of a quantity per degree of tilt
  std::string_view sign{};  ///< convention of the sign: ", counter-clockwise positive"
};

/// A quantity of each grain or of each contact of a frame.
struct FrameQuantity {
  /// Name; tables append _x or _xx for each component. Empty for the centre (columns x and y).
  std::string_view name;
  FieldShape shape = FieldShape::scalar;
  FieldNumber number = FieldNumber::real;
  std::string_view unit;        ///< SI, or "1"
  std::string_view definition;  ///< one sentence
  /// Returns the values row by row, floor included, in the order of ids or keys. `threshold` is the number of
  /// the threshold, for a quantity that depends on one.
  std::vector<double> (*values)(const GrainSource& source, std::size_t threshold) = nullptr;
  FrameNeed need = FrameNeed::nothing;
  bool flag = false;  ///< whether the values are 1 or 0
  MapRule map{};
};

/// Return the tables of the quantities of grains and of contacts.
std::span<const FrameQuantity> grain_quantities();
std::span<const FrameQuantity> contact_quantities();

/// Returns the row of a quantity of a script, which must outlive it; it has no function of the values.
FrameQuantity row_of(const OwnQuantity& own);

/// Returns the number of components of a quantity: 1, 2 or 4.
inline std::size_t components(const FrameQuantity& quantity) {
  return static_cast<std::size_t>(quantity.shape);
}

/// Whether the quantity is known for a single frame, perhaps at a threshold. Exports write these quantities.
inline bool is_of_frame(const FrameQuantity& quantity) {
  return quantity.need == FrameNeed::nothing || quantity.need == FrameNeed::threshold;
}

/// The unit of maps that corresponds to a unit of the table: D, sqrt(g D), rho g D, degrees, ... "1" and
/// other units remain as they are.
struct BedUnit {
  std::string text;    ///< rich text, empty for "1"
  double value = 1.0;  ///< SI
};
BedUnit bed_unit(std::string_view unit, const RunStatics& statics);

/// Returns the names of the components in tables, such as "velocity_x" and "velocity_y".
std::vector<std::string> component_names(const FrameQuantity& quantity);

/// Returns the ending of the name of a quantity at a threshold: "_2" for the factor 2, "_1_5" for 1.5. OVITO
/// reads a dot in a name as the start of a component.
std::string threshold_ending(double factor);

/// Appends the shortest decimal that reads back as the same number, in single precision if the quantity has
/// no more digits; appends `nan` for NaN.
void append_number(std::string& text, double value, FieldNumber number, std::string_view nan = "nan");

}  // namespace talus::analysis
