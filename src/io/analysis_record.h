#pragma once
/// The analysis of a run as plain arrays by name, the way it is stored under /analysis of a run file.

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/snapshot.h"
#include "io/analysis_schema.h"

namespace talus {

/// Values of one data set, row-major in the shape of its row of analysis_schema(): float64, float32, int32.
using AnalysisValues = std::variant<std::vector<double>, std::vector<float>, std::vector<Index>>;

/// `data_sets` are named by their path below /analysis/. Those that need a threshold are not there where none
/// is known (size F = 0).
struct Analysis {
  std::string key;   ///< the hash of all that it was made from
  Facts parameters;  ///< name and value as text, in the order of their table
  Sizes sizes;       ///< letters of the shapes: T, N, F and others (docs/analysis.md)
  std::map<std::string, AnalysisValues, std::less<>> data_sets;
};

/// All data sets that an analysis of these sizes has, filled with NaN, or with 0 where they hold integers.
Analysis make_analysis(const Sizes& sizes);

/// The array of a data set. Throws Error(internal) where there is none of that name.
AnalysisValues& find_data_set(Analysis& analysis, std::string_view name);
const AnalysisValues& find_data_set(const Analysis& analysis, std::string_view name);

/// Elements of one row of a data set: of what stands at one index of its first dimension.
std::size_t row_width(const Analysis& analysis, std::string_view name);

/// The values of a data set that holds T. Another T throws std::bad_variant_access.
template <typename T>
std::span<T> values(Analysis& analysis, std::string_view name) {
  return std::get<std::vector<T>>(find_data_set(analysis, name));
}
template <typename T>
std::span<const T> values(const Analysis& analysis, std::string_view name) {
  return std::get<std::vector<T>>(find_data_set(analysis, name));
}

/// Row k of a data set.
template <typename T, typename SomeAnalysis>
auto row(SomeAnalysis& analysis, std::string_view name, std::size_t k) {
  const std::size_t width = row_width(analysis, name);
  return values<T>(analysis, name).subspan(k * width, width);
}

}  // namespace talus
