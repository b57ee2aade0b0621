#pragma once
/// Reading an HDF5 file whose bytes have been verified, data set by data set of the schema. Private to this
/// room.

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "io/hdf5_handle.h"
#include "io/run_schema.h"

namespace talus::hdf5 {

/// Type, rank and shape of each data set are checked against the schema before anything is allocated; a
/// letter of the shapes has one value in a file. Every function throws Error(bad_data) naming the file and
/// the data set.
class Reader {
 public:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  /// `name` is what messages call the file; `known` are sizes it must agree with.
  static Reader from_memory(std::vector<std::byte> image, const std::string& name, const Sizes& known);
  static Reader from_file(const std::string& path);

  /// Values of a whole data set, in doubles where it holds floats.
  template <typename T>
  std::vector<T> read(const std::string& path) {
    const DataSet set = open(path);
    return read_from<T>(set, path, 0, rows_of(set));
  }
  template <typename T>
  T read_scalar(const std::string& path) {
    return read<T>(path).at(0);
  }
  /// Rows along the first dimension.
  template <typename T>
  std::vector<T> read_rows(const std::string& path, std::uint64_t first, std::uint64_t count) {
    return read_from<T>(open(path), path, first, count);
  }
  /// The same of a data set whose values must be finite, and from `low` to `high`.
  std::vector<double> read_finite(const std::string& path, double low = -infinity, double high = infinity) {
    std::vector<double> values = read<double>(path);
    check(path, values, low, high);
    return values;
  }
  std::vector<double> read_finite_rows(const std::string& path, std::uint64_t first, std::uint64_t count,
                                       double low = -infinity, double high = infinity) {
    std::vector<double> values = read_rows<double>(path, first, count);
    check(path, values, low, high);
    return values;
  }
  double read_finite_scalar(const std::string& path, double low = -infinity, double high = infinity) {
    return read_finite(path, low, high).at(0);
  }
  std::string read_text(const std::string& path);

  /// A data set as it is stored: its shape, its values, and its hash where it has one. Texts are without the
  /// zeros at their end.
  struct Stored {
    std::vector<std::uint64_t> dims;
    std::vector<std::byte> values;
    std::optional<std::uint64_t> hash;
  };
  Stored read_stored(const std::string& path);
  std::vector<std::byte> read_row_bytes(const std::string& path, std::uint64_t first, std::uint64_t count);

  /// Whether there is a data set or a group of that path.
  bool has(const std::string& path) const;
  /// The first dimension; 1 for a scalar.
  std::uint64_t row_count(const std::string& path);
  /// Names of the data sets in a group, in the order in which they were written.
  std::vector<std::string> names(const std::string& group);

  /// Throws Error(bad_data) about a data set of this file.
  [[noreturn]] void refuse(const std::string& path, const std::string& problem) const;

 private:
  struct DataSet {
    Handle id;
    std::vector<hsize_t> dims;
  };
  Reader(Handle file, std::string name, Sizes sizes);
  template <typename T>
  std::vector<T> read_from(const DataSet& set, const std::string& path, std::uint64_t first,
                           std::uint64_t count) const {
    std::vector<T> values(block_size(set, path, first, count));
    read_block(set, path, first, count, memory_type<T>(), values.data());
    return values;
  }
  static std::uint64_t rows_of(const DataSet& set) { return set.dims.empty() ? 1 : set.dims[0]; }
  DataSet open(const std::string& path);
  void check_shape(const std::string& path, const std::vector<hsize_t>& dims);
  std::size_t block_size(const DataSet& set, const std::string& path, std::uint64_t first,
                         std::uint64_t count) const;
  void read_block(const DataSet& set, const std::string& path, std::uint64_t first, std::uint64_t count,
                  hid_t type, void* values) const;

  void check(const std::string& path, const std::vector<double>& values, double low, double high) const;

  Handle file_;
  hsize_t file_size_;  ///< bytes
  std::string name_;
  Sizes sizes_;
};

}  // namespace talus::hdf5
