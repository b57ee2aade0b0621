#pragma once
/// Pieces of a run file on their way from a child process. Private to this room.

#include <optional>
#include <string>
#include <vector>

#include "io/stored_frame.h"

namespace talus {

/// To bytes: a data set, or that there is none; a frame; names.
std::vector<std::byte> encode(const std::optional<hdf5::Reader::Stored>& array);
std::vector<std::byte> encode(const StoredFrame& frame);
std::vector<std::byte> encode(const std::vector<std::string>& names);

/// And back. Nothing for what `encode` never makes, as where HDF5 has damaged the memory of its process.
std::optional<hdf5::Reader::Stored> decode_array(const std::vector<std::byte>& bytes);
std::optional<StoredFrame> decode_frame(const std::vector<std::byte>& bytes);
std::vector<std::string> decode_names(const std::vector<std::byte>& bytes);

}  // namespace talus
