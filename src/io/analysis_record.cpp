#include "io/analysis_record.h"

#include <limits>

#include "core/errors.h"

namespace talus {
namespace {

AnalysisValues unset_values(const DataSetField& field, const Sizes& sizes) {
  std::size_t count = 1;
  for (const std::uint64_t extent : dimensions(field, sizes)) count *= extent;
  if (field.type == ElementType::int32) return std::vector<Index>(count);
  if (field.type == ElementType::float32)
    return std::vector<float>(count, std::numeric_limits<float>::quiet_NaN());
  return std::vector<double>(count, std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

Analysis make_analysis(const Sizes& sizes) {
  Analysis analysis;
  analysis.sizes = sizes;
  for (const AnalysisField& field : analysis_schema())
    if (is_array(field) && is_present(field, sizes))
      analysis.data_sets.emplace(analysis_name(field), unset_values(field.data_set, sizes));
  return analysis;
}

AnalysisValues& find_data_set(Analysis& analysis, std::string_view name) {
  const auto found = analysis.data_sets.find(name);
  if (found == analysis.data_sets.end())
    throw Error(ExitCode::internal, "the analysis has no data set " + std::string(name));
  return found->second;
}

const AnalysisValues& find_data_set(const Analysis& analysis, std::string_view name) {
  return find_data_set(const_cast<Analysis&>(analysis), name);  // which it does not change
}

std::size_t row_width(const Analysis& analysis, std::string_view name) {
  const auto extents = dimensions(field_of(analysis_path(name)), analysis.sizes);
  std::size_t width = 1;
  for (std::size_t d = 1; d < extents.size(); ++d) width *= extents[d];
  return width;
}

}  // namespace talus
