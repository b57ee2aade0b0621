#pragma once
/// Every data set of a run file: its path, type, shape, unit and meaning, in one table. Data sets are created
/// and checked from it, /help is written from it, and docs/file_format.md is compared with it by a test.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace talus::io {

/// Counts up with each change of the table, or of what a stored scenario means. A file of another version is
/// refused.
inline constexpr std::int32_t run_schema_version = 4;

enum class ElementType { float32, float64, int8, int32, int64, uint64, text };
std::string_view type_name(ElementType type);
/// Bytes of a value; 1 for text.
std::size_t size_of(ElementType type);

struct DataSetField {
  std::string path;  ///< `.../*` stands for data sets whose names the run itself chooses
  ElementType type;
  std::string shape;  ///< "T N 2": letters are sizes (docs/file_format.md); empty for a scalar
  std::string unit;   ///< SI, "1", or "SI" where it depends on the name
  std::string help;
};

const std::vector<DataSetField>& run_schema();

/// Whether a data set has one row, or some, for each frame: its rows are covered by the hashes of the frames,
/// and not by one of its own.
bool is_by_frame(const DataSetField& field);

/// The row of a data set, of a run or of its analysis, with this path. Throws Error(internal) where no table
/// has it.
DataSetField field_of(const std::string& path);

/// One dimension of a shape: the size of its letter (0 without one) plus a number.
struct Extent {
  char symbol = '\0';
  std::uint64_t plus = 0;
};
std::vector<Extent> extents(const DataSetField& field);

/// Values of the letters of the shapes.
using Sizes = std::map<char, std::uint64_t>;

/// The shape of a data set in numbers; empty for a scalar.
std::vector<std::uint64_t> dimensions(const DataSetField& field, const Sizes& sizes);

}  // namespace talus::io
