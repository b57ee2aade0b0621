#include "io/foreign_file.h"

#include <filesystem>
#include <fmt/core.h>
#include <system_error>

#include "core/errors.h"
#include "io/child_process.h"
#include "io/durable_file.h"
#include "io/hdf5_handle.h"

namespace talus {
namespace {

using hdf5::Handle;

/// The file as the child has it: open in memory.
class OpenFile {
 public:
  OpenFile(const std::string& path, std::vector<std::byte>& bytes) : path_(path), size_(bytes.size()) {
    file_ = hdf5::open_image(bytes, path, H5F_ACC_RDONLY);
    if (file_.get() < 0) throw Error(ExitCode::bad_data, path + ": is not an HDF5 file");
  }

  /// Whether it is there, in this file.
  bool has(const std::string& path) const {
    const hdf5::Found found = hdf5::find(file_.get(), path);
    if (found == hdf5::Found::a_link_elsewhere)
      refuse(path, "is a link to another place, which is not followed");
    return found == hdf5::Found::an_object;
  }

  /// All values of a data set of numbers.
  template <typename T>
  std::vector<T> read(const std::string& path) const {
    const Handle set = open(path, std::is_same_v<T, double>);
    std::vector<T> values(value_count(set, path));
    if (!values.empty() &&
        H5Dread(set.get(), hdf5::memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
      refuse(path, "cannot be read");
    return values;
  }

 private:
  [[noreturn]] void refuse(const std::string& path, const std::string& problem) const {
    throw Error(ExitCode::bad_data, fmt::format("{}: data set {} {}", path_, path, problem));
  }

  Handle open(const std::string& path, bool of_reals) const {
    Handle set(H5Dopen2(file_.get(), path.c_str(), H5P_DEFAULT), H5Dclose);
    if (set.get() < 0) refuse(path, "cannot be opened: it is not a data set");
    const Handle type(H5Dget_type(set.get()), H5Tclose);
    const H5T_class_t kind = H5Tget_class(type.get());
    if (kind != H5T_INTEGER && !(of_reals && kind == H5T_FLOAT))
      refuse(path, of_reals ? "does not hold numbers" : "does not hold integers");
    if (!hdf5::is_stored_within(set.get())) refuse(path, "has its values in another file");
    return set;
  }

  std::size_t value_count(const Handle& set, const std::string& path) const {
    const Handle space(H5Dget_space(set.get()), H5Sclose);
    const hssize_t count = H5Sget_simple_extent_npoints(space.get());
    if (count < 0 || !hdf5::can_hold(size_, static_cast<hsize_t>(count)))
      refuse(path, "has an impossible size");
    return static_cast<std::size_t>(count);
  }

  std::string path_;
  hsize_t size_;
  Handle file_;
};

ForeignFile read(const OpenFile& file, const std::vector<DataSetField>& wanted) {
  ForeignFile found;
  for (const DataSetField& field : wanted) {
    if (!file.has(field.path)) continue;
    if (field.type == ElementType::text)
      found.groups.insert(field.path);
    else if (field.type == ElementType::int32)
      found.integers[field.path] = file.read<Index>(field.path);
    else
      found.reals[field.path] = file.read<double>(field.path);
  }
  return found;
}

}  // namespace

ForeignFile read_foreign(const std::string& path, const std::vector<DataSetField>& wanted) {
  std::error_code unknown;
  if (std::filesystem::is_directory(path, unknown))
    throw Error(ExitCode::missing_input, path + " is a folder; expected an HDF5 file");
  std::vector<std::byte> bytes = read_file(path);
  if (bytes.empty()) throw Error(ExitCode::bad_data, path + ": is empty");
  const auto work = [&] { return encode(read(OpenFile(path, bytes), wanted)); };
  return decode(in_child_process(path, bytes.size(), work), path);
}

}  // namespace talus
