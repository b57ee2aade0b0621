#include "app/analysis_report.h"
#include "app/json.h"
#include "io/analysis_schema.h"

namespace talus::app {
namespace {

bool is_of_grains(const analysis::Quantity& quantity) {
  return quantity.shape.find('N') != std::string::npos;
}

/// Nests numbers into lists; `extents` are the sizes from the outermost to the innermost, empty for a single
/// number.
template <typename T>
Json nested(std::span<const T> numbers, std::span<const std::uint64_t> extents) {
  if (extents.empty()) return numbers[0];
  Json list = Json::array();
  const std::size_t width = extents[0] > 0 ? numbers.size() / extents[0] : 0;
  for (std::size_t i = 0; i < extents[0]; ++i)
    list.push_back(nested(numbers.subspan(i * width, width), extents.subspan(1)));
  return list;
}

Json values_json(const analysis::Quantity& quantity, const analysis::Analysis& analysis) {
  const auto extents = io::dimensions(io::data_set_of(quantity), io::sizes_of(analysis));
  return std::visit(
      [&](const auto& array) { return nested(std::span(array), std::span<const std::uint64_t>(extents)); },
      analysis::values_of(quantity, analysis));
}

}  // namespace

std::string analysis_json(const runs::RunView& run, std::span<const analysis::Quantity> table) {
  const analysis::Analysis& analysis = run.analysis;
  Json json = {{"path", run.path},
               {"state", run.kept},
               {"key", analysis.key},
               {"mean_diameter", run.statics.mean_diameter},
               {"parameters", object_of(analysis.parameters)},
               {"tilt", Json::array()}};
  for (const analysis::FrameRecord& frame : analysis.frames) json["tilt"].push_back(frame.tilt);
  for (const analysis::Quantity& quantity : table)
    if (io::is_present(quantity, analysis) && !is_of_grains(quantity))
      json[quantity.name] = values_json(quantity, analysis);
  return json_text(json);
}

}  // namespace talus::app
