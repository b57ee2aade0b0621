#include "view/grain_quantities.h"

#include <fmt/core.h>

#include "analysis/quantities.h"

namespace talus::view {

std::string head_of(const analysis::GrainNumber& number) {
  const std::string unit = analysis::scaled_unit(number.quantity->unit);
  return unit == "1" ? number.name : fmt::format("{} ({})", number.name, unit);
}

const std::vector<ExpressionName>& grain_names() {
  static const std::vector<ExpressionName> names = [] {
    std::vector<ExpressionName> all;
    for (const analysis::GrainNumber& number : analysis::grain_numbers())
      all.push_back({number.name, number.quantity->flag});
    return all;
  }();
  return names;
}

std::vector<Index> grains_where(const Expression& condition, const analysis::GrainSource& source) {
  std::vector<std::vector<double>> columns;
  for (const std::string& name : condition.names)
    columns.push_back(analysis::values_of(analysis::grain_number(name), source));
  std::vector<Index> grains;
  std::vector<double> row(columns.size());
  for (Index i = 0; i < source.statics.free_count; ++i) {
    for (std::size_t k = 0; k < columns.size(); ++k) row[k] = columns[k][static_cast<std::size_t>(i)];
    if (holds(condition, row)) grains.push_back(i);
  }
  return grains;
}

}  // namespace talus::view
