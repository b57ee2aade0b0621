#pragma once
/// Reads an HDF5 file, data set by data set of a schema. In this process, only verified bytes may be read; in
/// a child process, any. Private to src/io, and to code with its own file formats.

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "io/file_in_use.h"
#include "io/hdf5_handle.h"
#include "io/run_schema.h"

namespace talus::io::hdf5 {

/// The valid range of the numbers of a data set.
struct Range {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool is_finite = true;

  bool holds(double value) const {
    return !is_finite || (value >= low && value <= high && std::isfinite(value));
  }
};
inline constexpr Range any_number = {.is_finite = false};

/// Describes a value outside its range: "holds 9e-06 at index 30, expected 1e-05 to 10".
std::string problem_of(double value, std::size_t index, Range range);

/// Rows along the first dimension.
struct Rows {
  std::uint64_t first = 0, count = 0;
};

/// A reader that checks type, rank and shape of each data set against the schema before it allocates memory.
/// A letter in the shapes has one value per file. Every function throws Error(bad_data) naming the file and
/// the data set.
class Reader {
 public:
  /// Opens a file; `name` is its name in messages, and `known` are sizes that it must match.
  static Reader from_memory(std::vector<std::byte> image, const std::string& name, const Sizes& known = {});
  static Reader from_file(const std::string& path);
  Reader(Reader&& other) noexcept = default;
  Reader& operator=(Reader&& other) noexcept;
  ~Reader();
  /// Returns a reader of the same file in which no letter has a value yet.
  Reader again() const;

  /// Reads a data set, or some of its rows; floats are converted to doubles.
  template <typename T>
  std::vector<T> read(const DataSetField& field, Range range = {}, std::optional<Rows> rows = {}) {
    const FileInUse in_use(name_);
    std::vector<T> values = values_of<T>(open(field), rows);
    check(field.path, values, range);
    return values;
  }
  /// Reads a data set of a schema of Talus.
  template <typename T>
  std::vector<T> read(const std::string& path, Range range = {}, std::optional<Rows> rows = {}) {
    return read<T>(field_of(path), range, rows);
  }
  template <typename T>
  T read_scalar(const std::string& path, Range range = {}) {
    return read<T>(path, range).at(0);
  }
  std::string read_text(const std::string& path);
  /// Reads a data set of another program in any shape: integers, or numbers of any type.
  template <typename T>
  std::vector<T> read_numbers(const std::string& path) const {
    const FileInUse in_use(name_);
    return values_of<T>(open_numbers(path, std::is_same_v<T, double>), {});
  }

  /// Whether a data set matches the hash of its values; one without a hash does not.
  bool is_as_written(const std::string& path);

  /// Whether a data set or a group exists at that path.
  bool has(const std::string& path) const;
  /// Returns the first dimension; 1 for a scalar.
  std::uint64_t row_count(const std::string& path);
  /// Returns the names of the data sets in a group, in the order in which they were written.
  std::vector<std::string> names(const std::string& group) const { return names(group, H5O_TYPE_DATASET); }
  /// Returns the paths of the data sets below a group; those in subgroups come last.
  std::vector<std::string> data_sets(const std::string& group) const;
  /// Opens every object of the file and its attributes, and looks up where values are stored, without reading
  /// them. A malformed file can make HDF5 crash here, before it is used.
  void walk() const;
  /// Reads a text attribute of a group or a data set.
  std::string attribute(const std::string& path, const char* name) const;

  /// Throws Error(bad_data) about a data set of this file.
  [[noreturn]] void refuse(const std::string& path, const std::string& problem) const;
  /// Throws Error(bad_data) if a value is outside its range.
  template <typename T>
  void check(const std::string& path, const std::vector<T>& values, Range range) const {
    for (std::size_t k = 0; k < values.size(); ++k)
      if (!range.holds(static_cast<double>(values[k])))
        refuse_value(path, static_cast<double>(values[k]), k, range);
  }

 private:
  Reader(Handle file, std::string name, Sizes sizes);
  template <typename T>
  std::vector<T> values_of(const DataSet& set, std::optional<Rows> rows) const {
    std::vector<T> values(block_size(set, rows));
    read_block(set, rows, memory_type<T>(), values.data());
    return values;
  }
  std::vector<std::string> names(const std::string& group, H5O_type_t kind) const;
  void require(const std::string& path) const;
  DataSet open(const std::string& path) const;
  DataSet open(const DataSetField& field);
  DataSet open_numbers(const std::string& path, bool of_reals) const;
  void check_shape(const DataSetField& field, const std::vector<hsize_t>& dims);
  [[noreturn]] void refuse_value(const std::string& path, double value, std::size_t index, Range range) const;
  std::size_t block_size(const DataSet& set, std::optional<Rows> rows) const;
  void read_block(const DataSet& set, std::optional<Rows> rows, hid_t type, void* values) const;

  Handle file_;
  hsize_t file_size_;  ///< bytes
  std::string name_;
  Sizes sizes_;
};

}  // namespace talus::io::hdf5
