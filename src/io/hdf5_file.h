#pragma once
/// HDF5 files, data set by data set: a Writer builds one in memory, a Reader reads one, by the rows of a
/// schema or by path and shape. HDF5 never writes to the disk, because a failed write can leave a file that
/// reads as zeros, or crash the process at its end: write_durably writes the finished image. In this process,
/// only verified bytes may be read; in a child process (child_process.h), any.

#include <hdf5.h>

#include <cerrno>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/run_schema.h"

namespace talus::io::hdf5 {

/// Owns one HDF5 identifier. After a failed allocation it stays open, because closing it can crash HDF5.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Handle() = default;
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Handle() {
    if (id_ >= 0 && errno != ENOMEM) close_(id_);
  }

  hid_t get() const { return id_; }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// Numbers of rows, columns, ... of a data set; empty for a scalar.
using Shape = std::vector<hsize_t>;

/// Configures HDF5. It must not print errors, which Talus reports itself; not load plugins into this process;
/// and not clean up when the process ends, because nothing is left to write, and after an error it can crash.
/// It also must not lock files: it reads only complete files, and on a file system without locks it could
/// read nothing. The environment overrides a program's settings of the library, so the lock setting is put
/// there, once, before the library reads it.
void set_library_policy();

/// Opens a file in memory. HDF5 copies the image and never writes to the given bytes. Throws
/// Error(out_of_memory), or Error(bad_data) if HDF5 cannot open it.
Handle open_image(std::vector<std::byte>& image, const std::string& name, unsigned access_flags);

/// A file in memory that is to be created or opened.
struct MemoryFile {
  std::string path;
  Handle access;
};

/// Returns the path and the properties of a file in memory. The path is unique, because HDF5 considers open
/// files of equal names the same file, and looks for a file of that name on disk; there can be none below
/// /dev/null. The file keeps to the format that every version reads and extends, which HDF5 2 does not do by
/// itself.
MemoryFile in_memory(const std::string& name);

/// Returns the little-endian type in the file. Not for text, whose type depends on its length.
hid_t file_type(ElementType type);

/// Follows a path from "/"; links to other files or places are not followed.
enum class PathTarget { nothing, an_object, a_link_elsewhere };
PathTarget find(hid_t file, const std::string& path);

/// Returns the hash of a data set that is written in one piece: of its path, so that redirected links are
/// detected, and of its values as stored; trailing zeros of texts are excluded. It is kept in an attribute.
std::uint64_t piece_hash(const std::string& path, std::span<const std::byte> values);
inline constexpr const char* hash_attribute = "hash";

hid_t create_space(const Shape& dims);
/// Selects a block of a space, unless it is a scalar; returns whether that succeeded.
bool select(hid_t space, const Shape& start, const Shape& block);

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

/// Calls refuse(problem) if a value is outside the range.
template <typename T, typename Refuse>
void check_range(const std::vector<T>& values, Range range, const Refuse& refuse) {
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!range.holds(static_cast<double>(values[k])))
      refuse(problem_of(static_cast<double>(values[k]), k, range));
}

/// Rows along the first dimension.
struct Rows {
  std::uint64_t first = 0, count = 0;
};

/// An open data set.
struct DataSet {
  Handle id, type;
  Shape dims;
  std::string path;
};

/// A reader that checks type, rank and shape of each data set against the schema before it allocates memory.
/// A letter in the shapes has one value per file. All throw Error(bad_data), naming file and data set.
class Reader {
 public:
  /// Opens a file; `name` is its name in messages, and `known` are sizes that it must match.
  static Reader from_memory(std::vector<std::byte> image, const std::string& name, const Sizes& known = {});
  static Reader from_file(const std::string& path);
  /// Returns a reader of the same file in which no letter has a value yet.
  Reader again() const;

  /// Reads a data set, or some of its rows; floats are converted to doubles.
  template <typename T>
  std::vector<T> read(const DataSetField& field, Range range = {}, std::optional<Rows> rows = {}) {
    std::vector<T> values = values_of<T>(open(field), rows);
    check_range(values, range, [&](const std::string& problem) { refuse(field.path, problem); });
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
    return values_of<T>(open_numbers(path, std::is_same_v<T, double>), {});
  }

  /// Whether a data set matches the hash of its values; one without a hash does not.
  bool is_as_written(const std::string& path);

  /// Whether a data set or a group exists at that path.
  bool has(const std::string& path) const;
  /// Returns the first dimension; 1 for a scalar.
  std::uint64_t row_count(const std::string& path);
  /// Returns the names of the data sets in a group, in the order in which they were written.
  std::vector<std::string> names(const std::string& group) const;
  /// Opens every object of the file and its attributes, and looks up where values are stored, without reading
  /// them. A malformed file can make HDF5 crash here, before it is used.
  void walk() const;
  /// Reads a text attribute of a group or a data set.
  std::string attribute(const std::string& path, const char* name) const;

  /// Throws Error(bad_data) about a data set of this file.
  [[noreturn]] void refuse(const std::string& path, const std::string& problem) const;

 private:
  Reader(Handle file, const std::string& name, Sizes sizes);
  template <typename T>
  std::vector<T> values_of(const DataSet& set, std::optional<Rows> rows) const {
    std::vector<T> values(block_size(set, rows));
    read_block(set, rows, file_type(element_type<T>()), values.data());
    return values;
  }
  void require(const std::string& path) const;
  DataSet open(const std::string& path) const;
  DataSet open(const DataSetField& field);
  DataSet open_numbers(const std::string& path, bool of_reals) const;
  void check_shape(const DataSetField& field, const Shape& dims);
  std::size_t block_size(const DataSet& set, std::optional<Rows> rows) const;
  void read_block(const DataSet& set, std::optional<Rows> rows, hid_t type, void* values) const;

  Handle file_;
  std::string name_;       ///< name in messages
  hsize_t file_size_ = 0;  ///< bytes
  Sizes sizes_;
};

class Writer {
 public:
  /// Begins a file. `sizes` gives the letters of the shapes. `user_block` bytes (0, or a power of two from
  /// 512) are reserved at the start of the image. Large data sets of a file with this block, which stays, are
  /// compressed.
  explicit Writer(Sizes sizes, std::size_t user_block = 0);
  /// Continues an existing file, whose name in messages is `name`; `image` begins with `user_block` bytes of
  /// any content. Throws Error(bad_data) if HDF5 cannot open it.
  Writer(Sizes sizes, std::size_t user_block, std::vector<std::byte> image, const std::string& name);
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// Creates a data set of a schema with its unit; floats are initialised to NaN.
  void create(const DataSetField& field);

  /// Creates a data set and writes all its values and their hash. Throws Error(internal).
  template <typename T>
  void write(const DataSetField& field, const std::vector<T>& values) {
    create(field);
    write_all(field.path, element_type<T>(), std::as_bytes(std::span(values)));
  }
  /// Writes a data set of a schema of Talus.
  template <typename T>
  void write(const std::string& path, const std::vector<T>& values) {
    write(field_of(path), values);
  }
  template <typename T>
  void write_scalar(const std::string& path, T value) {
    write(path, std::vector<T>{value});
  }
  /// Writes a scalar string of fixed length, as UTF-8.
  void write_text(const DataSetField& field, const std::string& bytes);
  void write_text(const std::string& path, const std::string& bytes) { write_text(field_of(path), bytes); }

  /// Writes rows from `first_row` along the first dimension of a created data set; `values` are whole rows.
  void write_rows(const std::string& path, std::uint64_t first_row, std::span<const std::byte> values);

  void create_group(const std::string& path);
  /// Gives a data set a second name.
  void link(const std::string& path, const std::string& second_path);
  /// Set an attribute of a group: a list of integers, texts (all of one fixed length), or one text.
  void set_attribute(const std::string& path, const char* name, const std::vector<std::int32_t>& values);
  void set_attribute(const std::string& path, const char* name, const std::vector<std::string>& texts);
  void set_attribute(const std::string& path, const char* name, const std::string& text);
  /// Removes a data set, a link, or a group with its contents, if it exists.
  void remove(const std::string& path);
  /// Writes the meaning of each data set of a schema, at the same path in /help.
  void write_help(const std::vector<DataSetField>& schema);

  const Sizes& sizes() const { return sizes_; }

  /// Writes the list of all data sets of the run so far. Later data, which the run does not need, follow in
  /// the file, and are lost first if it is truncated.
  void write_contents();

  /// Completes the file and returns its bytes, with zeros in the user block.
  std::vector<std::byte> image();

 private:
  void write_all(const std::string& path, ElementType type, std::span<const std::byte> values);
  Handle put_text(const std::string& path, const std::string& text, const std::string& unit);
  Handle object_at(const std::string& path);

  Handle file_;
  Sizes sizes_;
  std::size_t user_block_;
  std::string contents_;                 ///< paths of the data sets, one per line
  std::map<std::string, DataSet> open_;  ///< kept open so that each chunk is compressed once, when it is full
};

}  // namespace talus::io::hdf5
