#include "app/analysis_report.h"
#include "io/analysis_schema.h"
#include "scenario/json.h"

namespace talus {
namespace {

bool is_of_grains(const Quantity& quantity) { return quantity.shape.find('N') != std::string::npos; }

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

std::string values_text(const Quantity& quantity, const Analysis& analysis) {
  const auto extents = dimensions(data_set_of(quantity), sizes_of(analysis));
  return std::visit(
      [&](const auto& array) { return nested(std::span(array), std::span<const std::uint64_t>(extents)); },
      values_of(quantity, analysis));
}

}  // namespace

std::string analysis_json(const RunView& run, std::span<const Quantity> table) {
  const Analysis& analysis = run.analysis;
  json::Members parameters;
  for (const auto& [name, value] : analysis.parameters) parameters.emplace_back(name, json::quoted(value));
  std::vector<double> tilts;
  for (const FrameRecord& frame : analysis.frames) tilts.push_back(frame.tilt);
  const std::uint64_t frames = tilts.size();
  json::Members members = {{"path", json::quoted(run.path)},
                           {"state", json::quoted(run.kept)},
                           {"key", json::quoted(analysis.key)},
                           {"mean_diameter", json::number(run.statics.mean_diameter)},
                           {"parameters", json::object(parameters, 1)},
                           {"tilt", nested(std::span<const double>(tilts), std::span(&frames, 1))}};
  for (const Quantity& quantity : table)
    if (is_present(quantity, analysis) && !is_of_grains(quantity))
      members.emplace_back(quantity.name, values_text(quantity, analysis));
  return json::object(members);
}

}  // namespace talus
