#pragma once
/// HDF5 identifiers that close themselves. Private to this room, as everything that sees hdf5.h.

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

/// Owns one HDF5 identifier. Where an allocation has failed it stays open: HDF5 can crash when it closes what
/// it could not complete.
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

/// A data set that is open.
struct DataSet {
  Handle id, type;
  std::vector<hsize_t> dims;
  std::string path;
};

/// Keeps HDF5 from printing errors, which we report ourselves, from loading plugins into this process, and
/// from tidying up when the process ends: there is nothing left to write then, and after an error it can
/// crash. Nor does it lock files: what it reads has been written whole before, and a file system without
/// locks would let it read nothing. The environment overrules what a program asks of the library, so that is
/// what is set, once, before the library looks.
inline void set_library_policy() {
  static const int without_locks = ::setenv("HDF5_USE_FILE_LOCKING", "FALSE", 1);
  if (without_locks != 0) throw std::bad_alloc();
  errno = 0;
  H5dont_atexit();
  if (H5open() < 0 || errno == ENOMEM) throw std::bad_alloc();  // it can begin, and lack a part
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  H5PLset_loading_state(0);
}

/// To be asked after a call of HDF5 that failed on `name`, a file or a data set of it: where the system is
/// the cause, that is thrown (Error(out_of_memory), Error(io_error)). HDF5 does not tell it reliably, least
/// of all when it has no memory to note it; errno does, since set_library_policy. A malformed file can ask
/// for more memory than there is.
inline void throw_cause(const std::string& name) {
  constexpr int of_the_system[] = {EIO, ENOSPC, EDQUOT, EMFILE, ENFILE, ESTALE};
  const int cause = errno;
  if (cause == ENOMEM)
    throw Error(ExitCode::out_of_memory,
                name + ": out of memory while it was read; where there is enough, the file is malformed");
  if (std::ranges::find(of_the_system, cause) != std::end(of_the_system))
    throw system_error(ExitCode::io_error, "read", name, cause);
}

/// A name for a file in memory, another one at each call. HDF5 takes open files of equal names for the same
/// one, and looks for a file of that name on disk: below /dev/null there can be none.
inline std::string memory_name(const std::string& name) {
  static std::atomic<std::uint64_t> count = 0;
  return fmt::format("/dev/null/{} {}", name, ++count);
}

/// Passes on a file that is open. Throws Error(bad_data) where HDF5 could not open it, and as throw_cause
/// does.
inline Handle require_open(Handle file, const std::string& name) {
  if (file.get() < 0) throw_cause(name);
  if (file.get() < 0)
    throw Error(ExitCode::bad_data, name + ": HDF5 cannot open it: it is malformed, or of another format");
  return file;
}

/// Opens a file in memory. HDF5 copies the image and never writes to the bytes it is given. Throws
/// Error(out_of_memory), and as require_open does.
inline Handle open_image(std::vector<std::byte>& image, const std::string& name, unsigned access_flags) {
  set_library_policy();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  if (H5Pset_fapl_core(access.get(), 1 << 20, false) < 0 ||
      H5Pset_file_image(access.get(), image.data(), image.size()) < 0)
    throw Error(ExitCode::out_of_memory, name + ": no memory to open it");
  return require_open({H5Fopen(memory_name(name).c_str(), access_flags, access.get()), H5Fclose}, name);
}

/// What a path leads to.
enum class Found { nothing, an_object, a_link_elsewhere };

/// Follows a path from "/" on; no link to another file or place is followed.
inline Found find(hid_t file, const std::string& path) {
  for (std::size_t slash = path.find('/', 1);; slash = path.find('/', slash + 1)) {
    const std::string part = path.substr(0, slash);
    H5L_info_t link{};
    if (H5Lexists(file, part.c_str(), H5P_DEFAULT) <= 0) return Found::nothing;
    if (H5Lget_info(file, part.c_str(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD)
      return Found::a_link_elsewhere;
    if (slash == std::string::npos) return Found::an_object;
  }
}

/// Whether the values of a data set lie in its own file, and are no view of other data sets.
inline bool is_stored_within(hid_t set) {
  const Handle creation(H5Dget_create_plist(set), H5Pclose);
  const H5D_layout_t layout = H5Pget_layout(creation.get());
  return layout >= 0 && layout != H5D_VIRTUAL && H5Pget_external_count(creation.get()) == 0;
}

/// Whether a file of so many bytes can hold `count` values: deflate makes data at most 1032 times smaller,
/// and nothing that is read at once is above 4 GiB of doubles.
inline bool can_hold(hsize_t file_size, hsize_t count) {
  constexpr hsize_t most = hsize_t{1} << 29;
  return count <= most && count / 1032 <= file_size;
}

/// The attribute of a data set with the hash of its values.
inline constexpr const char* hash_attribute = "hash";

/// The hash of a data set that is written whole: of its path, so that no link leads to another unseen, and of
/// its values as they are stored; of a text without the zeros at its end.
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

/// The type in the file, little-endian everywhere. Not for text, whose type depends on its length.
inline hid_t file_type(ElementType type) {
  const hid_t types[] = {
      H5T_IEEE_F32LE, H5T_IEEE_F64LE, H5T_STD_I8LE, H5T_STD_I32LE, H5T_STD_I64LE, H5T_STD_U64LE, -1};
  return types[static_cast<std::size_t>(type)];
}

}  // namespace talus::io::hdf5
