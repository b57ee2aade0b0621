#pragma once
/// What a page holds of each grain in each frame, in 16 bits.

#include <string>
#include <vector>

#include "exports/page/page_run.h"
#include "exports/page/tables.h"
#include "pictures/layers.h"

namespace talus::exports {

/// A number of each grain: how it is called, and its codes, grain by grain.
struct GrainField {
  std::string name;   ///< "gamma": in the page, and of the map that is coloured by it
  std::string label;  ///< rich text: "γ, l = 3 D"
  std::string unit;   ///< rich text, empty for a number
  int digits = 3;     ///< significant ones that are shown
  Quantum quantum;
  CodeTable codes;
};

/// Fields of the maps with a bar, of l_c, and of the clusters (their numbers; no_code outside of them).
class GrainFields {
 public:
  explicit GrainFields(const PageRun& run);
  /// What a map shows of the grains of a frame; one that has no values is left out.
  void add(const PageFrame& frame, pictures::MapKind kind, const pictures::MapLayer& layer);
  /// Places, l_c and clusters.
  void add(const PageFrame& frame);

  const std::vector<GrainField>& fields() const { return fields_; }
  const CodeTable& x() const { return x_; }
  const CodeTable& y() const { return y_; }
  const PlaceQuantum& x_quantum() const { return x_quantum_; }
  const PlaceQuantum& y_quantum() const { return y_quantum_; }

 private:
  GrainField& field(const std::string& name);
  void set(GrainField& of, std::size_t column, std::size_t grain, double value);

  const PageRun& run_;
  PlaceQuantum x_quantum_, y_quantum_;
  CodeTable x_, y_;  ///< of all grains, floor included
  std::vector<GrainField> fields_;
};

}  // namespace talus::exports
