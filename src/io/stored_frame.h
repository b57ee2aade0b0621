#pragma once
/// A frame as it is stored, in the types of the file: what its hash is of, and what is copied when a damaged
/// run is repaired. Private to this room.

#include <functional>

#include "core/snapshot.h"
#include "io/hdf5_reader.h"
#include "io/hdf5_writer.h"

namespace talus {

struct StoredFrame {
  /// The rows of each data set that is by frame (is_by_frame), in the order of the schema; but no offset and
  /// no hash.
  std::vector<std::vector<std::byte>> rows;
  std::uint64_t contacts = 0;
};

StoredFrame as_stored_rows(const Frame& frame);

/// The value of /frames/hash: of the number of bytes and the bytes of each data set.
std::uint64_t frame_hash(const StoredFrame& frame);

/// Steps taken, and angle to the horizontal (rad), of a frame as it is stored.
std::int64_t step_of(const StoredFrame& frame);
double tilt_of(const StoredFrame& frame);

/// Whether a frame has the sizes of one of a bed of so many grains.
bool fits(const StoredFrame& frame, std::uint64_t grains);

/// Rows of /contacts that belong to a frame.
struct ContactRows {
  std::uint64_t first = 0, count = 0;
};
/// Throws Error(bad_data) where /contacts/offset cannot be.
ContactRows contact_rows(hdf5::Reader& reader, std::size_t row);

/// Frame `row` of the file. Throws as the reader does.
StoredFrame read_stored_frame(hdf5::Reader& reader, std::size_t row);

/// Writes frames one after another to the data sets of frames, which it creates, and their hashes and
/// offsets. Sizes: T, N, M. `frame_at(k)` is called once for each frame, in order.
void write_stored_frames(hdf5::Writer& writer, const std::function<StoredFrame(std::size_t)>& frame_at);

}  // namespace talus
