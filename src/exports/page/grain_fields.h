#pragma once
/// The values of each grain in each frame of a page, stored in 16 bits.

#include <string>
#include <vector>

#include "exports/page/page_run.h"
#include "exports/page/tables.h"
#include "pictures/layers.h"

namespace talus::exports {

/// A scalar of each grain: its name, and its codes by grain.
struct GrainField {
  std::string name;   ///< for example "gamma": name in the page, and of the map that shows it
  std::string label;  ///< rich text, for example "γ, l = 3 D"
  std::string unit;   ///< rich text, empty for a dimensionless number
  int digits = 3;     ///< significant digits shown
  Quantum quantum;
  CodeTable codes;
};

/// The fields of maps with a bar, of l_c, and of clusters (their numbers; no_code outside them).
class GrainFields {
 public:
  explicit GrainFields(const PageRun& run);
  /// Adds the values that a map shows of the grains of a frame; a layer without values is skipped.
  void add(const PageFrame& frame, pictures::MapKind kind, const pictures::MapLayer& layer);
  /// Adds positions, l_c and clusters.
  void add(const PageFrame& frame);

  const std::vector<GrainField>& fields() const { return fields_; }
  const CodeTable& x() const { return x_; }
  const CodeTable& y() const { return y_; }
  const PlaceQuantum& x_quantum() const { return x_quantum_; }
  const PlaceQuantum& y_quantum() const { return y_quantum_; }

 private:
  GrainField& field(const std::string& name);
  void set(GrainField& target, std::size_t column, std::size_t grain, double value);

  const PageRun& run_;
  PlaceQuantum x_quantum_, y_quantum_;
  CodeTable x_, y_;  ///< positions of all grains, floor included
  std::vector<GrainField> fields_;
};

}  // namespace talus::exports
