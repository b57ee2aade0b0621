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

namespace talus::io::hdf5 {

/// How the large data sets are stored: in compressed chunks, frame by frame, or as they are.
enum class Storage { compressed, as_it_is };

class Writer {
 public:
  /// `sizes` gives the letters of the shapes. `user_block` bytes (0, or a power of two from 512) are kept
  /// free at the start of the image.
  explicit Writer(Sizes sizes, std::size_t user_block = 0, Storage storage = Storage::compressed);
  /// Goes on with a file built before, which messages call `name`: `image` begins with `user_block` bytes of
  /// any content. Throws Error(bad_data) where HDF5 cannot open it.
  Writer(Sizes sizes, std::size_t user_block, std::vector<std::byte> image, const std::string& name);

  /// Creates a data set with its unit, filled with NaN where it holds floats.
  void create(const DataSetField& field);

  /// Writes a whole data set, created by this call, with the hash of its values. Throws Error(internal) where
  /// their number or their type is wrong.
  template <typename T>
  void write(const DataSetField& field, std::span<const T> values) {
    write_bytes(field, std::as_bytes(values), memory_type<T>());
  }
  template <typename T>
  void write(const DataSetField& field, const std::vector<T>& values) {
    write(field, std::span<const T>(values));
  }
  /// The same of one that a schema of Talus has.
  template <typename T>
  void write(const std::string& path, const std::vector<T>& values) {
    write(field_of(path), values);
  }
  template <typename T>
  void write_scalar(const std::string& path, T value) {
    write(field_of(path), std::span<const T>(&value, 1));
  }
  /// A scalar string of fixed length, as UTF-8.
  void write_text(const DataSetField& field, const std::string& bytes);
  void write_text(const std::string& path, const std::string& bytes) { write_text(field_of(path), bytes); }

  /// Writes rows `first_row` ... along the first dimension of a created data set; values are whole rows, as
  /// they are stored.
  void write_rows(const DataSetField& field, std::uint64_t first_row, std::span<const std::byte> values);

  void create_group(const std::string& path);
  /// A second name for a data set.
  void link(const std::string& path, const std::string& second_path);
  /// Attributes of a group: a list of integers, texts (all in one fixed length), or one text.
  void set_attribute(const std::string& path, const char* name, const std::vector<std::int32_t>& values);
  void set_attribute(const std::string& path, const char* name, const std::vector<std::string>& texts);
  void set_attribute(const std::string& path, const char* name, const std::string& text);
  /// Removes a data set, a link, or a group with all that is in it, if it is there.
  void remove(const std::string& path);
  /// The meaning of a data set, under the same path in /help.
  void write_help(const std::string& path, const std::string& text);

  const Sizes& sizes() const { return sizes_; }

  /// The list of all data sets written so far, of a run. What is written after it, without need for the run,
  /// lies behind all that was, and is lost first where the file is cut.
  void write_contents();

  /// Completes the file. Its bytes, with zeros in the user block.
  std::vector<std::byte> image();

 private:
  Handle object_at(const std::string& path);
  Handle put_text(const std::string& path, const std::string& text, const std::string& unit);
  void write_bytes(const DataSetField& field, std::span<const std::byte> values, hid_t type);

  Sizes sizes_;
  std::size_t user_block_;
  Storage storage_ = Storage::compressed;
  Handle file_;
  std::string contents_;                 ///< paths of the data sets, one a line
  std::map<std::string, DataSet> open_;  ///< kept open so that a chunk is compressed once, when it is full
};

}  // namespace talus::io::hdf5
