#pragma once
/// HDF5 identifiers that close themselves. Private to src/io, like everything that includes hdf5.h.

#include <hdf5.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <fmt/core.h>
#include <iterator>
#include <new>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "base/hash.h"
#include "io/run_schema.h"

namespace talus::io::hdf5 {

/// Owns one HDF5 identifier. After a failed allocation it is left open, because HDF5 can crash when it closes
/// an incomplete object.
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

/// An open data set.
struct DataSet {
  Handle id, type;
  std::vector<hsize_t> dims;
  std::string path;
};

/// Configures HDF5. It must not print errors, which Talus reports itself; not load plugins into this process;
/// and not clean up when the process ends, because nothing is left to write, and after an error it can crash.
/// It also must not lock files: it reads only complete files, and on a file system without locks it could
/// read nothing. The environment overrides a program's settings of the library, so the lock setting is put
/// there, once, before the library reads it.
inline void set_library_policy() {
  static const int without_locks = ::setenv("HDF5_USE_FILE_LOCKING", "FALSE", 1);
  if (without_locks != 0) throw std::bad_alloc();
  errno = 0;
  H5dont_atexit();
  if (H5open() < 0 || errno == ENOMEM) throw std::bad_alloc();  // it can start incompletely
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  H5PLset_loading_state(0);
}

/// Throws Error(out_of_memory) or Error(io_error) if the system caused a failed HDF5 call on `name`, a file
/// or one of its data sets. HDF5 does not report the cause reliably, least of all without memory; errno does,
/// after set_library_policy. A malformed file can request more memory than exists.
inline void throw_cause(const std::string& name) {
  constexpr int of_the_system[] = {EIO, ENOSPC, EDQUOT, EMFILE, ENFILE, ESTALE};
  const int cause = errno;
  if (cause == ENOMEM)
    throw Error(
        ExitCode::out_of_memory,
        name + ": out of memory while it was read; if enough memory is available, the file is malformed");
  if (std::ranges::find(of_the_system, cause) != std::end(of_the_system))
    throw system_error(ExitCode::io_error, "read", name, cause);
}

/// Returns a unique name for a file in memory. HDF5 considers open files of equal names the same file, and
/// looks for a file of that name on disk; there can be none below /dev/null.
inline std::string memory_name(const std::string& name) {
  static std::atomic<std::uint64_t> count = 0;
  return fmt::format("/dev/null/{} {}", name, ++count);
}

/// Returns an open file. Throws Error(bad_data) if HDF5 could not open it, and the errors of throw_cause.
inline Handle require_open(Handle file, const std::string& name) {
  if (file.get() < 0) throw_cause(name);
  if (file.get() < 0)
    throw Error(ExitCode::bad_data, name + ": HDF5 cannot open it: it is malformed, or of another format");
  return file;
}

/// Returns the properties by which HDF5 opens or makes a file in memory: it grows by `growth` bytes at a
/// time, and keeps to the format that every version reads and extends, which HDF5 2 does not do by itself.
inline Handle in_memory(std::size_t growth) {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  if (H5Pset_fapl_core(access.get(), growth, false) < 0 ||
      H5Pset_libver_bounds(access.get(), H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST) < 0)
    throw std::bad_alloc();
  return access;
}

/// Opens a file in memory. HDF5 copies the image and never writes to the given bytes. Throws
/// Error(out_of_memory), and the errors of require_open.
inline Handle open_image(std::vector<std::byte>& image, const std::string& name, unsigned access_flags) {
  set_library_policy();
  const Handle access = in_memory(1 << 20);
  if (H5Pset_file_image(access.get(), image.data(), image.size()) < 0)
    throw Error(ExitCode::out_of_memory, name + ": no memory to open it");
  return require_open({H5Fopen(memory_name(name).c_str(), access_flags, access.get()), H5Fclose}, name);
}

/// Information about an object, without its timestamps and sizes; HDF5 1.12 has changed its type and the
/// calls.
#if H5_VERSION_GE(1, 12, 0)
using ObjectInfo = H5O_info2_t;
inline herr_t object_info(hid_t group, const char* name, ObjectInfo& info) {
  return H5Oget_info_by_name3(group, name, &info, H5O_INFO_BASIC, H5P_DEFAULT);
}
inline herr_t visit_objects(hid_t file, H5_iter_order_t order,
                            herr_t (*look)(hid_t, const char*, const ObjectInfo*, void*), void* data) {
  return H5Ovisit3(file, H5_INDEX_NAME, order, look, data, H5O_INFO_BASIC);
}
#else
using ObjectInfo = H5O_info_t;
inline herr_t object_info(hid_t group, const char* name, ObjectInfo& info) {
  return H5Oget_info_by_name(group, name, &info, H5P_DEFAULT);
}
inline herr_t visit_objects(hid_t file, H5_iter_order_t order,
                            herr_t (*look)(hid_t, const char*, const ObjectInfo*, void*), void* data) {
  return H5Ovisit(file, H5_INDEX_NAME, order, look, data);
}
#endif

/// The target of a path.
enum class PathTarget { nothing, an_object, a_link_elsewhere };

/// Follows a path from "/"; links to other files or places are not followed.
inline PathTarget find(hid_t file, const std::string& path) {
  for (std::size_t slash = path.find('/', 1);; slash = path.find('/', slash + 1)) {
    const std::string part = path.substr(0, slash);
    H5L_info_t link{};
    if (H5Lexists(file, part.c_str(), H5P_DEFAULT) <= 0) return PathTarget::nothing;
    if (H5Lget_info(file, part.c_str(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD)
      return PathTarget::a_link_elsewhere;
    if (slash == std::string::npos) return PathTarget::an_object;
  }
}

/// Whether the values of a data set are in its own file and not a view of other data sets.
inline bool is_stored_within(hid_t set) {
  const Handle creation(H5Dget_create_plist(set), H5Pclose);
  const H5D_layout_t layout = H5Pget_layout(creation.get());
  return layout >= 0 && layout != H5D_VIRTUAL && H5Pget_external_count(creation.get()) == 0;
}

/// Whether a file of `file_size` bytes can hold `count` values: deflate shrinks data at most by a factor of
/// 1032, and nothing that is read at once exceeds 4 GiB of doubles.
inline bool can_hold(hsize_t file_size, hsize_t count) {
  constexpr hsize_t most = hsize_t{1} << 29;
  return count <= most && count / 1032 <= file_size;
}

/// The attribute of a data set that contains the hash of its values.
inline constexpr const char* hash_attribute = "hash";

/// Returns the hash of a data set that is written in one piece: of its path, so that redirected links are
/// detected, and of its values as stored; trailing zeros of texts are excluded.
inline std::uint64_t piece_hash(const std::string& path, std::span<const std::byte> values) {
  Hasher hasher;
  hasher.add_array(path);
  hasher.add_array(values);
  return hasher.value();
}

template <typename T>
hid_t memory_type() {
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, std::int8_t>) return H5T_NATIVE_INT8;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::is_same_v<T, std::uint64_t>) return H5T_NATIVE_UINT64;
}

/// Returns the type in the file, which is always little-endian. Not for text, whose type depends on its
/// length.
inline hid_t file_type(ElementType type) {
  const hid_t types[] = {
      H5T_IEEE_F32LE, H5T_IEEE_F64LE, H5T_STD_I8LE, H5T_STD_I32LE, H5T_STD_I64LE, H5T_STD_U64LE, -1};
  return types[static_cast<std::size_t>(type)];
}

}  // namespace talus::io::hdf5
