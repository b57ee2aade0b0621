#pragma once
/// Every data set of a run file in one table: path, type, shape, unit and meaning. Data sets are created and
/// checked by it, /help is written from it, and a test compares docs/file_format.md with it.

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/quantities.h"

namespace talus::io {

/// Increases with each change of the table, or of the meaning of a scenario. Other versions are rejected.
inline constexpr std::int32_t run_schema_version = 4;

enum class ElementType { float32, float64, int8, int32, int64, uint64, text };
std::string_view type_name(ElementType type);

/// Returns the type of an element in memory.
template <typename T>
constexpr ElementType element_type() {
  if constexpr (std::is_same_v<T, double>) return ElementType::float64;
  if constexpr (std::is_same_v<T, float>) return ElementType::float32;
  if constexpr (std::is_same_v<T, std::int8_t>) return ElementType::int8;
  if constexpr (std::is_same_v<T, std::int32_t>) return ElementType::int32;
  if constexpr (std::is_same_v<T, std::int64_t>) return ElementType::int64;
  if constexpr (std::is_same_v<T, std::uint64_t>) return ElementType::uint64;
}

struct DataSetField {
  std::string path;  ///< `.../*` represents data sets whose names the run chooses
  ElementType type;
  std::string shape;  ///< for example "T N 2": letters are sizes (docs/file_format.md); empty for a scalar
  std::string unit;   ///< SI, "1", or "SI" if it depends on the name
  std::string help;
};

const std::vector<DataSetField>& run_schema();

/// Whether a data set has one or more rows for each frame. Its rows are then covered by the hashes of the
/// frames instead of a separate hash.
bool is_by_frame(const DataSetField& field);

/// Returns the entry for the data set at this path, of a run or of its analysis. Throws Error(internal).
DataSetField field_of(const std::string& path);

/// One dimension of a shape: the size of its letter (0 without one) plus a number.
struct Extent {
  char symbol = '\0';
  std::uint64_t plus = 0;
};
std::vector<Extent> extents(const DataSetField& field);

/// Values of the letters of the shapes.
using Sizes = std::map<char, std::uint64_t>;

/// Returns the shape of a data set in numbers; empty for a scalar.
std::vector<std::uint64_t> dimensions(const DataSetField& field, const Sizes& sizes);

// The data sets in /analysis: a version, a key, parameters as texts, and the table of quantities.

/// Increases with each change of the table or of the computation; analyses of other versions are repeated.
inline constexpr std::int32_t analysis_version = 9;

/// Returns the data set of a quantity.
DataSetField data_set_of(const analysis::Quantity& quantity);

/// Returns all data sets, in the order in which they are written.
std::vector<DataSetField> analysis_schema(std::span<const analysis::Quantity> table = analysis::quantities());

/// Returns the letters of the shapes for an analysis of at least one frame.
Sizes sizes_of(const analysis::Analysis& analysis);

/// Whether an analysis contains the quantity; some need a threshold or events.
bool is_present(const analysis::Quantity& quantity, const analysis::Analysis& analysis);

}  // namespace talus::io
