#pragma once
/// Reading an HDF5 file whose bytes have been verified, data set by data set of the schema. Private to this
/// room.

#include <cstddef>
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
  /// `name` is what messages call the file; `known` are sizes it must agree with.
  static Reader from_memory(const std::vector<std::byte>& image, const std::string& name, const Sizes& known);
  static Reader from_file(const std::string& path);

  /// Values of a whole data set, in doubles where it holds floats.
  template <typename T>
  std::vector<T> read(const std::string& path) {
    return read_rows<T>(path, 0, row_count(path));
  }
  template <typename T>
  T read_scalar(const std::string& path) {
    return read<T>(path).at(0);
  }
  /// Rows along the first dimension.
  template <typename T>
  std::vector<T> read_rows(const std::string& path, std::uint64_t first, std::uint64_t count) {
    const DataSet set = open(path);
    std::vector<T> values(block_size(set, path, first, count));
    read_block(set, path, first, count, memory_type<T>(), values.data());
    return values;
  }
  std::string read_text(const std::string& path);

  /// Whether there is a data set or a group of that path, in a group that there is.
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
  DataSet open(const std::string& path);
  void check_shape(const std::string& path, const std::vector<hsize_t>& dims);
  std::size_t block_size(const DataSet& set, const std::string& path, std::uint64_t first,
                         std::uint64_t count) const;
  void read_block(const DataSet& set, const std::string& path, std::uint64_t first, std::uint64_t count,
                  hid_t type, void* values) const;

  Handle file_;
  std::string name_;
  Sizes sizes_;
};

}  // namespace talus::hdf5
