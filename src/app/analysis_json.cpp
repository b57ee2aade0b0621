#include "app/analysis_report.h"
#include "app/json.h"
#include "io/analysis_schema.h"

namespace talus {
namespace {

/// Numbers in nested lists: `extents` are the sizes from the outer to the inner, none for a single number.
template <typename T>
std::string nested(std::span<const T> numbers, std::span<const std::uint64_t> extents) {
  if (extents.empty()) return json::number(numbers[0]);
  std::string text = "[";
  const std::size_t width = extents[0] > 0 ? numbers.size() / extents[0] : 0;
  for (std::size_t i = 0; i < extents[0]; ++i)
    text += (i > 0 ? ", " : "") + nested(numbers.subspan(i * width, width), extents.subspan(1));
  return text + "]";
}

std::string data_set_text(const AnalysisField& field, const Analysis& analysis) {
  const auto extents = dimensions(field.data_set, analysis.sizes);
  return std::visit(
      [&](const auto& array) { return nested(std::span(array), std::span<const std::uint64_t>(extents)); },
      find_data_set(analysis, analysis_name(field)));
}

}  // namespace

std::string analysis_json(const AnalysedRun& run) {
  const Analysis& analysis = run.analysis;
  json::Members parameters;
  for (const auto& [name, value] : analysis.parameters) parameters.emplace_back(name, json::quoted(value));
  const std::uint64_t frames = run.tilts.size();
  json::Members members = {{"path", json::quoted(run.path)},
                           {"state", json::quoted(run.state)},
                           {"key", json::quoted(analysis.key)},
                           {"mean_diameter", json::number(run.statics.mean_diameter)},
                           {"parameters", json::object(parameters, 1)},
                           {"tilt", nested(std::span<const double>(run.tilts), std::span(&frames, 1))}};
  for (const AnalysisField& field : analysis_schema())
    if (is_array(field) && is_present(field, analysis.sizes) &&
        field.data_set.shape.find('N') == std::string::npos)
      members.emplace_back(analysis_name(field), data_set_text(field, analysis));
  return json::object(members);
}

}  // namespace talus
