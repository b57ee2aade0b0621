#pragma once
/// What is known of each grain and of each contact of a frame, in one table each: name, components, unit,
/// meaning, what it needs, where the values come from, and how a map shows them. Maps, exports, and
/// conditions, tables and histograms of the window go by them; docs/export.md and docs/view.md are compared
/// with them by tests.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/record.h"
#include "core/bed_frame.h"

namespace talus::analysis {

/// A frame, and what its grains are judged with.
struct GrainSource : BedFrame {       // as it is stored, with the gamma of single grains
  std::size_t number = 0;             ///< in the run, counted from 0
  std::span<const double> gamma{};    ///< of the neighbourhood of each grain
  const Frame* first = nullptr;       ///< of the run, where displacements begin; null where there is none yet
  std::span<const double> factors{};  ///< of the thresholds, in Gamma_c
  std::span<const FrameThreshold> thresholds{};  ///< l_c and clusters at each of them
  const Frame* earlier = nullptr;  ///< from which deformation is measured; null where there is none yet
  double degrees = 1.0;            ///< of tilt since then, by which it is divided; 1: it is not
  double length = not_known;       ///< diameter over which fields are coarse-grained, m
};

/// Components: 1; x, y; xx, xy, yx, yy.
enum class FieldShape { scalar = 1, vector = 2, tensor = 4 };

/// Which numbers a quantity has: what the run file stores in single precision has no more digits than that.
enum class FieldNumber { integer, single, real };

/// What a quantity needs of its source besides the frame.
enum class FrameNeed { nothing, threshold, earlier_frame, length };

/// How the colours of a map follow a number of each grain.
enum class ScaleRule {
  none,        ///< there is no map of it
  fixed,       ///< from low to high
  by_depth,    ///< from 0 to the depth of the bed in D times high, rounded up
  sizes,       ///< logarithmic; of the frames that are drawn, or from low to high
  about_zero,  ///< to either side of 0; of the frames that are drawn, or up to high
};

/// A number of each grain as a map. Texts are rich texts (render/frame_view.h); the unit is that of bed_unit.
struct MapRule {
  std::string_view name, help;          ///< of the map, and a line for users
  std::string_view title, bar, symbol;  ///< "Speed of grains", what the bar measures, and in short
  ScaleRule scale = ScaleRule::none;
  double low = 0.0, high = 1.0;
  bool outlines = false;                                ///< grains without a value only show where they are
  std::string_view without{};                           ///< what these are, for the legend
  double low_per_degree = low, high_per_degree = high;  ///< of what is divided by degrees of tilt
  std::string_view sign{};                              ///< ", counter-clockwise positive"
};

struct FrameQuantity {
  std::string_view name;  ///< with _x or _xx for each component in tables; empty for the centre: x and y
  FieldShape shape = FieldShape::scalar;
  FieldNumber number = FieldNumber::real;
  std::string_view unit;        ///< SI, or "1"
  std::string_view definition;  ///< one sentence
  /// Row by row, floor included, in the order of ids or keys; `threshold` is that of a quantity that depends
  /// on one.
  std::vector<double> (*values)(const GrainSource& of, std::size_t threshold) = nullptr;
  FrameNeed need = FrameNeed::nothing;
  bool flag = false;  ///< 1 or 0
  MapRule map{};
};

std::span<const FrameQuantity> grain_quantities();
std::span<const FrameQuantity> contact_quantities();

inline std::size_t components(const FrameQuantity& quantity) {
  return static_cast<std::size_t>(quantity.shape);
}

/// Whether it is known of every frame by itself, perhaps at thresholds: what exports write.
inline bool is_of_frame(const FrameQuantity& quantity) {
  return quantity.need == FrameNeed::nothing || quantity.need == FrameNeed::threshold;
}

/// The unit of maps for a unit of the table: D, sqrt(g D), rho g D, degrees, ... "1" and units that are not
/// known stay as they are.
struct BedUnit {
  std::string text;    ///< rich text, empty for "1"
  double value = 1.0;  ///< SI
};
BedUnit bed_unit(std::string_view unit, const RunStatics& statics);

/// "velocity_x", "velocity_y": names of the components in tables.
std::vector<std::string> component_names(const FrameQuantity& quantity);

/// One number of each grain: a quantity, or a component of one.
struct GrainNumber {
  std::string name;
  const FrameQuantity* quantity = nullptr;
  std::size_t component = 0;
};

/// Of all quantities of grains, in their order.
const std::vector<GrainNumber>& grain_numbers();
/// The one of a name. Throws Error(internal) where there is none.
const GrainNumber& grain_number(std::string_view name);

/// Of all grains, by their ids, in the unit of tables (scaled, quantities.h); at the first threshold. NaN
/// where there is no value.
std::vector<double> values_of(const GrainNumber& number, const GrainSource& of);

/// Appends the shortest decimal that reads back as the same number, in single precision where the quantity
/// has no more; `nan` for a number that is none.
void append_number(std::string& text, double value, FieldNumber number, std::string_view nan = "nan");

}  // namespace talus::analysis
