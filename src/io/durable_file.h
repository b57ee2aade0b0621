#pragma once
/// Files that are complete or absent, even after a crash, and the seal by which damage is found.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/output_file.h"

namespace talus::io {

/// Reads an entire file. Throws Error(missing_input) or Error(io_error).
std::vector<std::byte> read_file(const std::string& path);
std::string read_text(const std::string& path);

/// Writes `bytes` as an OutputFile, commits it, and makes its name durable, so that a file called `path` is
/// always complete. Throws the errors of OutputFile.
void write_durably(const std::string& path, std::span<const std::byte> bytes);

/// Writes a text durably, converted to UTF-8 even if names in it have other bytes.
void write_text(const std::string& path, const std::string& text);

/// Creates a folder durably, unless it exists. Throws creation_error.
void make_folder(const std::string& path);

/// Removes a file if it exists. Throws Error(io_error).
void remove_file(const std::string& path);

// The beginning of a file: an HDF5 signature, or a seal. A seal reveals damage anywhere in the file before
// HDF5 reads it, because malformed data can crash HDF5. It is a text with the size and the hash of the file,
// in the bytes before the HDF5 part (its "user block"), which other HDF5 readers skip.

inline constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1a\n";

/// Size of a seal, bytes.
inline constexpr std::size_t seal_size = 512;
/// First lines of the seals of runs and of ensemble averages.
inline constexpr std::string_view run_seal = "talus run file 1\n", averages_seal = "talus averages file 2\n";

/// Returns a file with the seal of the rest in its first seal_size bytes.
std::vector<std::byte> sealed(std::vector<std::byte> file, std::string_view kind = run_seal);

/// Returns the file size according to the seal of a run; 0 without a seal.
std::uint64_t sealed_size(std::span<const std::byte> file);

/// Returns the hash of the seal of a packed file. The seal contains the hash of the rest, so different files
/// have different hashes.
std::uint64_t seal_hash(std::span<const std::byte> file);
/// Returns the hash of the file at `path`, of which only the seal is read. Throws Error(missing_input).
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
/// Whether a file begins like an ensemble.h5 of any version, undamaged or damaged.
bool begins_as_averages(const std::string& path);

}  // namespace talus::io
