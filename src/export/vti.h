#pragma once
/// Coarse-grained fields of frames on a grid, as XML ImageData of VTK, for ParaView.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/coarse_fields.h"
#include "analysis/frame_quantities.h"
#include "export/fields.h"

namespace talus {

/// A field of the bed as a continuum; docs/export.md is compared with their table by a test.
struct GridField {
  std::string_view name;
  FieldShape shape = FieldShape::scalar;
  std::string_view unit;        ///< SI, or "1"
  std::string_view definition;  ///< one sentence
  /// Appends its components at a point. `material`: density of the grains, kg/m^3.
  void (*append)(std::vector<double>& values, const CoarseField& at, double material) = nullptr;
};
std::span<const GridField> grid_fields();

/// Points in rows, from the lowest row up and along x in each, m. Around the bed they go on for the cutoff of
/// the coarse-graining function, beyond which nothing is: a sum over all of them, times dx dy, is an integral
/// over the bed. Around a period they go once.
struct FieldGrid {
  double x = 0.0, y = 0.0, dx = 1.0, dy = 1.0;
  int columns = 0, rows = 0;
};
/// `width`: diameter of the support of the coarse-graining function, m. Points are a tenth of it apart, or a
/// little less along x, as a whole number goes around the period.
FieldGrid field_grid(const GrainSource& frame, double width);

/// Throws Error(usage) where `width` is not in (0, length of the bed].
void check_field_width(const RunStatics& statics, double width);

/// Throws as check_field_width.
std::string fields_vti(const GrainSource& frame, double width);

}  // namespace talus
