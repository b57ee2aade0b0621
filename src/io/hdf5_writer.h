#pragma once
/// Builds an HDF5 file in memory, data set by data set of the schema. Private to src/io.
///
/// HDF5 never accesses the disk, because a failed write can leave a file that reads as zeros, or crash the
/// process at its end. write_durably writes the finished image.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "io/file_in_use.h"
#include "io/hdf5_handle.h"
#include "io/run_schema.h"

namespace talus::io::hdf5 {

/// Storage of large data sets: in compressed chunks, frame by frame, or as they are.
enum class Storage { compressed, as_it_is };

class Writer {
 public:
  /// Begins a file. `sizes` gives the letters of the shapes. `user_block` bytes (0, or a power of two from
  /// 512) are reserved at the start of the image.
  explicit Writer(Sizes sizes, std::size_t user_block = 0, Storage storage = Storage::compressed);
  /// Continues an existing file, whose name in messages is `name`; `image` begins with `user_block` bytes of
  /// any content. Throws Error(bad_data) if HDF5 cannot open it.
  Writer(Sizes sizes, std::size_t user_block, std::vector<std::byte> image, const std::string& name);
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer();

  /// Creates a data set with its unit; floats are initialised to NaN.
  void create(const DataSetField& field);

  /// Creates a data set and writes all its values and their hash. Throws Error(internal) if their number or
  /// type is wrong.
  template <typename T>
  void write(const DataSetField& field, std::span<const T> values) {
    write_bytes(field, std::as_bytes(values), memory_type<T>());
  }
  template <typename T>
  void write(const DataSetField& field, const std::vector<T>& values) {
    write(field, std::span<const T>(values));
  }
  /// Writes a data set of a schema of Talus.
  template <typename T>
  void write(const std::string& path, const std::vector<T>& values) {
    write(field_of(path), values);
  }
  template <typename T>
  void write_scalar(const std::string& path, T value) {
    write(field_of(path), std::span<const T>(&value, 1));
  }
  /// Writes a scalar string of fixed length, as UTF-8.
  void write_text(const DataSetField& field, const std::string& bytes);
  void write_text(const std::string& path, const std::string& bytes) { write_text(field_of(path), bytes); }

  /// Writes rows from `first_row` along the first dimension of a created data set; `values` are complete
  /// rows, as stored.
  void write_rows(const DataSetField& field, std::uint64_t first_row, std::span<const std::byte> values);

  void create_group(const std::string& path);
  /// Gives a data set a second name.
  void link(const std::string& path, const std::string& second_path);
  /// Set an attribute of a group: a list of integers, texts (all of one fixed length), or one text.
  void set_attribute(const std::string& path, const char* name, const std::vector<std::int32_t>& values);
  void set_attribute(const std::string& path, const char* name, const std::vector<std::string>& texts);
  void set_attribute(const std::string& path, const char* name, const std::string& text);
  /// Removes a data set, a link, or a group with its contents, if it exists.
  void remove(const std::string& path);
  /// Writes the meaning of a data set, at the same path in /help.
  void write_help(const std::string& path, const std::string& text);

  const Sizes& sizes() const { return sizes_; }

  /// Writes the list of all data sets of the run so far. Later data, which the run does not need, follow in
  /// the file, and are lost first if it is truncated.
  void write_contents();

  /// Completes the file and returns its bytes, with zeros in the user block.
  std::vector<std::byte> image();

 private:
  Handle object_at(const std::string& path);
  Handle put_text(const std::string& path, const std::string& text, const std::string& unit);
  void write_bytes(const DataSetField& field, std::span<const std::byte> values, hid_t type);

  Sizes sizes_;
  std::size_t user_block_;
  std::string name_;  ///< name of an existing file, which can be malformed; empty for a new one
  Storage storage_ = Storage::compressed;
  Handle file_;
  std::string contents_;                 ///< paths of the data sets, one per line
  std::map<std::string, DataSet> open_;  ///< kept open so that each chunk is compressed once, when it is full
};

}  // namespace talus::io::hdf5
