#pragma once
/// Protection from crashes of HDF5. A parser of untrusted bytes runs in a child process, so that a crash in
/// its library cannot end this one.

#include <cstddef>
#include <cstring>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace talus::io {

/// The output of a child process: bytes by name.
using Parcels = std::map<std::string, std::vector<std::byte>>;

/// Runs `work` in a child process and returns its output. The child is limited to 10 s of processor time plus
/// 1 s for each MiB of `input`, the size of its input in bytes; to six times that in wall time; and to 2 GiB
/// of memory plus 64 times `input`, in addition to the memory of this process. It writes no files. An Error
/// that `work` throws is rethrown here; if the child ends in any other way, this throws Error(bad_data) with
/// the name `path`. HDF5 can be used in the child, whatever other
/// threads do; no other resource that a thread may hold.
Parcels in_child_process(const std::string& path, std::size_t input, const std::function<Parcels()>& work);

/// Returns whether a child, just forked, can use HDF5: with HDF5 2 not if a thread of its parent was inside.
bool may_use_hdf5();

/// Convert parcels to a sequence of bytes and back. `decode` throws Error(bad_data), naming `path`, for bytes
/// that `encode` never produces, such as after memory corruption by HDF5.
std::vector<std::byte> encode(const Parcels& parcels);
Parcels decode(std::span<const std::byte> bytes, const std::string& path);

/// Convert plain values to the bytes of a parcel and back; an incomplete value is dropped.
template <typename Values>
std::vector<std::byte> bytes_of(const Values& values) {
  const auto bytes = std::as_bytes(std::span(values));
  return {bytes.begin(), bytes.end()};
}
template <typename Values>
Values values_of(const std::vector<std::byte>& bytes) {
  Values values;
  values.resize(bytes.size() / sizeof(typename Values::value_type));
  const std::size_t size = values.size() * sizeof(typename Values::value_type);
  if (size > 0) std::memcpy(values.data(), bytes.data(), size);
  return values;
}

// Trial of a run in a child process, for programs that a crash of HDF5 must not end. Private to src/io,
// except for walk_before_opening.

/// Lets RunFile::open try each run in a child process before it opens it: some malformed files whose hash is
/// right make HDF5 crash. The library calls this; the program does not, and such a crash ends it. Returns
/// true.
bool walk_before_opening();

/// Walks through the files of a run, and opens it, in a child process, if walk_before_opening was called and
/// the files have not been tried before. `run`: its packed file or its folder. Throws Error(bad_data) if HDF5
/// crashes or hangs; errors in the run are left to the code that opens it, and without a child process there
/// is no trial.
void try_run(const std::string& run);

}  // namespace talus::io
