#pragma once
/// Reading an HDF5 file, data set by data set of the schema: in this process one whose bytes have been
/// verified, in a child process any. Private to this room.

#include <cstddef>
#include <limits>
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
  /// The same file, of whose letters nothing is known yet.
  Reader again() const { return {Handle(H5Freopen(file_.get()), H5Fclose), name_, {}}; }

  /// Values of a whole data set, in doubles where it holds floats.
  template <typename T>
  std::vector<T> read(const std::string& path) {
    const DataSet set = open(path);
    return read_from<T>(set, path, 0, rows_of(set));
  }
  /// The same of a data set that no schema need have.
  template <typename T>
  std::vector<T> read(const DataSetField& field) {
    const DataSet set = open(field);
    return read_from<T>(set, field.path, 0, rows_of(set));
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

  /// Whether a data set agrees with the hash of its values; one that has none does not.
  bool is_as_written(const std::string& path);

  /// Whether there is a data set or a group of that path.
  bool has(const std::string& path) const;
  /// The first dimension; 1 for a scalar.
  std::uint64_t row_count(const std::string& path);
  /// Names of the data sets in a group, in the order in which they were written.
  std::vector<std::string> names(const std::string& group);

  /// Throws Error(bad_data) about a data set of this file.
  [[noreturn]] void refuse(const std::string& path, const std::string& problem) const;
  /// Throws it where a value is not finite, or not from `low` to `high`.
  void check(const std::string& path, const std::vector<double>& values, double low, double high) const;

 private:
  Reader(Handle file, std::string name, Sizes sizes);
  template <typename T>
  std::vector<T> read_from(const DataSet& set, const std::string& path, std::uint64_t first,
                           std::uint64_t count) const {
    std::vector<T> values(block_size(set, path, first, count));
    read_block(set, path, first, count, memory_type<T>(), values.data());
    return values;
  }
  static std::uint64_t rows_of(const DataSet& set) { return set.dims.empty() ? 1 : set.dims[0]; }
  DataSet open(const DataSetField& field, const std::string& path);
  DataSet open(const DataSetField& field) { return open(field, field.path); }
  DataSet open(const std::string& path) { return open(field_of(path), path); }
  void check_shape(const DataSetField& field, const std::string& path, const std::vector<hsize_t>& dims);
  std::size_t block_size(const DataSet& set, const std::string& path, std::uint64_t first,
                         std::uint64_t count) const;
  void read_block(const DataSet& set, const std::string& path, std::uint64_t first, std::uint64_t count,
                  hid_t type, void* values) const;

  Handle file_;
  hsize_t file_size_;  ///< bytes
  std::string name_;
  Sizes sizes_;
};

}  // namespace talus::hdf5
