#pragma once
/// HDF5 files of other programs, which no hash of ours covers. HDF5 sees them in a child process only; what
/// comes back are plain arrays, for the caller to check. Private to this room.

#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/types.h"
#include "io/run_schema.h"

namespace talus {

/// What is there of all that was asked for, by its path.
struct ForeignFile {
  std::set<std::string> groups;
  std::map<std::string, std::vector<double>> reals;
  std::map<std::string, std::vector<Index>> integers;
};

/// Reads the groups and data sets of `wanted` that the file at `path` has; a field without a type of ours
/// (text) asks for a group. Arrays are flat, whatever their shape; numbers of any size are converted. Throws
/// Error(missing_input) where the file cannot be opened, Error(bad_data) where it is no HDF5 file, or a data
/// set holds no such numbers, is larger than the file can hold, or lies in another file.
ForeignFile read_foreign(const std::string& path, const std::vector<DataSetField>& wanted);

/// The same to bytes and back. `decode` throws Error(bad_data), naming `path`, for what `encode` never makes.
std::vector<std::byte> encode(const ForeignFile& file);
ForeignFile decode(std::span<const std::byte> bytes, const std::string& path);

}  // namespace talus
