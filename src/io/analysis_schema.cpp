#include "io/analysis_schema.h"

#include <fmt/core.h>

namespace talus::io {
namespace {

using enum ElementType;

ElementType type_of(const std::vector<double>&) { return float64; }
ElementType type_of(const std::vector<float>&) { return float32; }
ElementType type_of(const std::vector<Index>&) { return int32; }

}  // namespace

DataSetField data_set_of(const analysis::Quantity& quantity) {
  const ElementType type = std::visit([](const auto& none) { return type_of(none); },
                                      analysis::values_of(quantity, analysis::Analysis()));
  return {analysis_path(quantity.name), type, quantity.shape, quantity.unit, quantity.definition};
}

std::vector<DataSetField> analysis_schema(std::span<const analysis::Quantity> table) {
  std::vector<DataSetField> schema = {
      {"/analysis/version", int32, "", "1", "version of this table and of what it means"},
      {"/analysis/key", text, "", "1",
       "XXH3 of the state hash of the run, of all parameters and of the version, 16 hexadecimal digits: an "
       "analysis with another key is computed again"},
      {"/analysis/parameters/*", text, "", "1", "a parameter as it was given, or its default"}};
  for (const analysis::Quantity& quantity : table) schema.push_back(data_set_of(quantity));
  return schema;
}

std::string analysis_path(std::string_view name) { return fmt::format("/analysis/{}", name); }

Sizes sizes_of(const analysis::Analysis& analysis) {
  Sizes sizes = {{'T', analysis.frames.size()},
                 {'F', analysis.thresholds.size()},
                 {'X', analysis.section_edge.size() - 1},
                 {'Y', analysis.layer_edge.size() - 1},
                 {'B', analysis.gamma_edge.size() - 1}};
  if (!analysis.events.empty()) sizes['E'] = analysis.events.size();
  if (!analysis.thresholds.empty()) sizes['N'] = analysis.frames.front().thresholds.front().lc.size();
  return sizes;
}

bool is_present(const analysis::Quantity& quantity, const analysis::Analysis& analysis) {
  if (analysis::needs_threshold(quantity)) return !analysis.thresholds.empty();
  return !analysis::is_of_events(quantity) || !analysis.events.empty();
}

}  // namespace talus::io
