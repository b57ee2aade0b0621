#pragma once
/// Work that must not be able to end this process: on bytes that nobody vouches for, by a library that they
/// may crash.

#include <cstddef>
#include <cstring>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace talus::io {

/// What a child process sends: bytes by their names.
using Parcels = std::map<std::string, std::vector<std::byte>>;

/// Parcels that `work` returns in a child process. The child has no more than 10 s of processor time and 1 s
/// for each MiB of `input`, the size of what it reads in bytes, and six times that by the clock; 2 GiB of
/// memory and 64 times `input` beside what this process has; and it writes no files. An Error that `work`
/// throws is thrown here; where the child ends in any other way, this throws Error(bad_data) with the name
/// `path`. Not while another thread holds what `work` needs.
Parcels in_child_process(const std::string& path, std::size_t input, const std::function<Parcels()>& work);

/// Parcels to one row of bytes and back. `decode` throws Error(bad_data), naming `path`, for what `encode`
/// never makes, as where HDF5 has damaged the memory of its process.
std::vector<std::byte> encode(const Parcels& parcels);
Parcels decode(std::span<const std::byte> bytes, const std::string& path);

/// Plain values as a parcel has them, as they are in memory, and back; of an incomplete value nothing.
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

}  // namespace talus::io
