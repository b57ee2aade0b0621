#pragma once
/// A first look at HDF5 files by a child process. A seal or a manifest tells damage, not intent: a file can
/// be malformed and sealed again, and HDF5 crashes on some. Private to this room.

#include <cstddef>
#include <string>
#include <vector>

#include "io/manifest.h"

namespace talus {

/// Opens all that is in a packed run file, each group, data set and index of chunks, in a child process.
/// Throws Error(bad_data) where HDF5 does not survive it there. What only does not fit is left to those who
/// read it.
void probe_packed(const std::string& path);

/// The same for the files of a run folder, all in one child; `once` are those that a writer may replace at
/// any time, as they were read. Throws for damaged segments as read_stored does.
void probe_folder(const std::string& folder, std::vector<std::vector<std::byte>>& once,
                  const std::vector<StoredSegment>& segments);

}  // namespace talus
