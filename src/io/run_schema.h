#pragma once
/// Every data set of a run file in one table: path, type, shape, unit and meaning. Data sets are created and
/// checked by it, /help is written from it, and a test compares docs/file_format.md with it.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace talus::io {

/// Increases with each change of the table, or of the meaning of a stored scenario. Files of other versions
/// are rejected.
inline constexpr std::int32_t run_schema_version = 4;

enum class ElementType { float32, float64, int8, int32, int64, uint64, text };
std::string_view type_name(ElementType type);
/// Returns the bytes per value; 1 for text.
std::size_t size_of(ElementType type);

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

/// Returns the entry for the data set at this path, of a run or of its analysis. Throws Error(internal) if no
/// table has it.
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

}  // namespace talus::io
