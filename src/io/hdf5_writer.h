#pragma once
/// Building an HDF5 file in memory, data set by data set of the schema. Private to this room.
///
/// HDF5 never touches the disk: a failed write of its own can leave a file that reads as zeros, or crash the
/// process at its end. The finished image is written by write_durably.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "io/hdf5_handle.h"
#include "io/run_schema.h"

namespace talus::hdf5 {

/// How the large data sets are stored: in compressed chunks, frame by frame, or as they are.
enum class Storage { compressed, as_it_is };

class Writer {
 public:
  /// `sizes` gives the letters of the shapes. `user_block` bytes (0, or a power of two from 512) are kept
  /// free at the start of the image.
  explicit Writer(Sizes sizes, std::size_t user_block = 0, Storage storage = Storage::compressed);
  /// Goes on with a file built before: `image` begins with `user_block` bytes of any content.
  Writer(Sizes sizes, std::size_t user_block, const std::vector<std::byte>& image);

  /// Creates a data set with its unit, filled with NaN where it holds floats.
  void create(const std::string& path);

  /// Writes a whole data set, created by this call, with the hash of its values. Throws Error(internal) where
  /// their number or their type is wrong.
  template <typename T>
  void write(const std::string& path, std::span<const T> values) {
    write_bytes(field_of(path), path, std::as_bytes(values), memory_type<T>());
  }
  template <typename T>
  void write(const std::string& path, const std::vector<T>& values) {
    write(path, std::span<const T>(values));
  }
  /// The same of a data set that no schema need have.
  template <typename T>
  void write(const DataSetField& field, const std::vector<T>& values) {
    write_bytes(field, field.path, std::as_bytes(std::span(values)), memory_type<T>());
  }
  template <typename T>
  void write_scalar(const std::string& path, T value) {
    write(path, std::span<const T>(&value, 1));
  }
  /// A scalar string of fixed length, as UTF-8.
  void write_text(const std::string& path, const std::string& bytes);

  /// Writes rows `first_row` ... along the first dimension of a created data set; values are whole rows.
  template <typename T>
  void write_rows(const std::string& path, std::uint64_t first_row, const std::vector<T>& values) {
    write_block(path, first_row, values.size(), memory_type<T>(), values.data());
  }
  /// The same of values as they are stored.
  void write_row_bytes(const std::string& path, std::uint64_t first_row, std::span<const std::byte> values);

  void create_group(const std::string& path);
  /// A second name for a data set.
  void link(const std::string& path, const std::string& second_path);
  /// Attributes of a group: a list of integers, texts (all in one fixed length), or one text.
  void set_attribute(const std::string& path, const char* name, const std::vector<std::int32_t>& values);
  void set_attribute(const std::string& path, const char* name, const std::vector<std::string>& texts);
  void set_attribute(const std::string& path, const char* name, const std::string& text);
  /// The meaning of a data set, under the same path in /help.
  void write_help(const std::string& path, const std::string& text);

  const Sizes& sizes() const { return sizes_; }

  /// The list of all data sets written so far. What is written after it, without need for the run, lies
  /// behind all that was, and is lost first where the file is cut.
  void write_contents();

  /// Completes the file, with its contents. Its bytes, with zeros in the user block.
  std::vector<std::byte> image();

 private:
  Handle put_text(const std::string& path, const std::string& text, const std::string& unit);
  void create(const DataSetField& field, const std::string& path);
  void write_bytes(const DataSetField& field, const std::string& path, std::span<const std::byte> values,
                   hid_t type);
  void write_block(const std::string& path, std::uint64_t first_row, std::size_t count, hid_t type,
                   const void* data);

  Sizes sizes_;
  std::size_t user_block_;
  Storage storage_ = Storage::compressed;
  bool has_contents_ = false;
  Handle file_;
  std::string contents_;                 ///< paths of the data sets, one a line
  std::map<std::string, DataSet> open_;  ///< kept open so that a chunk is compressed once, when it is full
};

}  // namespace talus::hdf5
