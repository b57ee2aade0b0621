#pragma once
/// How files begin: as HDF5, or with a seal, by which damage anywhere is found before HDF5 sees the file,
/// which malformed data can crash. A seal is a text with the size and the hash of the file, in the bytes
/// before the HDF5 part (its "user block"), which other readers of HDF5 pass over.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace talus::io {

inline constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1a\n";

/// Bytes of a seal.
inline constexpr std::size_t seal_size = 512;
/// How the seals of runs and of the averages of an ensemble begin.
inline constexpr std::string_view run_seal = "talus run file 1\n", averages_seal = "talus averages file 1\n";

/// Fills the first seal_size bytes with the seal of the rest.
void seal(std::vector<std::byte>& file, std::string_view kind = run_seal);

/// The size that the seal of a run gives it; 0 where it has none.
std::uint64_t sealed_size(std::span<const std::byte> file);

/// The hash of the seal of a packed file, which holds that of all that follows: other files, other hashes.
std::uint64_t seal_hash(std::span<const std::byte> file);
/// The same of the file at `path`, of which no more than the seal is read. Throws Error(missing_input).
std::uint64_t seal_hash_of(const std::string& path);

/// Reads the whole file at `path` once. Throws Error(missing_input) where it cannot be read and
/// Error(bad_data) where its seal is missing, of another kind, or wrong.
void verify_seal(const std::string& path, std::string_view kind = run_seal);

/// Whether the regular file at `path` begins with these bytes; false where there is none, or this user may
/// not read it. Throws Error(missing_input) where it cannot be opened for another reason, and Error(io_error)
/// where its device fails.
bool begins_with(const std::string& path, std::string_view bytes);
/// Whether it begins as the packed file of a run, sound or damaged.
bool begins_as_run(const std::string& path);

}  // namespace talus::io
