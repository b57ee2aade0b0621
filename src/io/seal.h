#pragma once
/// The beginning of a file: an HDF5 signature, or a seal. A seal reveals damage anywhere in the file before
/// HDF5 reads it, because malformed data can crash HDF5. It is a text with the size and the hash of the file,
/// in the bytes before the HDF5 part (its "user block"), which other HDF5 readers skip.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace talus::io {

inline constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1a\n";

/// Size of a seal, bytes.
inline constexpr std::size_t seal_size = 512;
/// First lines of the seals of runs and of ensemble averages.
inline constexpr std::string_view run_seal = "talus run file 1\n", averages_seal = "talus averages file 1\n";

/// Fills the first seal_size bytes with the seal of the rest.
void seal(std::vector<std::byte>& file, std::string_view kind = run_seal);

/// Returns the file size according to the seal of a run; 0 without a seal.
std::uint64_t sealed_size(std::span<const std::byte> file);

/// Returns the hash of the seal of a packed file. The seal contains the hash of the rest, so different files
/// have different hashes.
std::uint64_t seal_hash(std::span<const std::byte> file);
/// Returns the hash of the seal of the file at `path`, of which only the seal is read. Throws
/// Error(missing_input).
std::uint64_t seal_hash_of(const std::string& path);

/// Reads the entire file at `path` once. Throws Error(missing_input) if it cannot be read, and
/// Error(bad_data) if its seal is missing, of another kind, or wrong.
void verify_seal(const std::string& path, std::string_view kind = run_seal);

/// Whether the regular file at `path` begins with these bytes; false if it does not exist or this user may
/// not read it. Throws Error(missing_input) if it cannot be opened for another reason, and Error(io_error) if
/// its device fails.
bool begins_with(const std::string& path, std::string_view bytes);
/// Whether a file begins like the packed file of a run, undamaged or damaged.
bool begins_as_run(const std::string& path);

}  // namespace talus::io
