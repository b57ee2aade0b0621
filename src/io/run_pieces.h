#pragma once
/// The pieces of a file of a run, each compared with its hash: what is whole where the file is not. HDF5 sees
/// the file in child processes only. Private to this room.

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/stored_frame.h"

namespace talus {

/// A data set that is not by frame.
struct StoredArray {
  std::vector<std::uint64_t> dims;
  std::vector<std::byte> values;
};

/// A frame that is not whole.
struct LostFrame {
  std::size_t number = 0;
  double tilt = 0.0;  ///< rad, as the file has it; NaN where that is lost too
};

/// What of the whole was lost: a data set, or a file, and how.
struct LostPiece {
  std::string name;
  std::string how;
};

struct RunPieces {
  std::map<std::string, StoredArray> arrays;  ///< by path
  std::vector<std::string> order;             ///< their paths, in the order in which they were written
  std::vector<StoredFrame> frames;
  std::vector<LostFrame> lost_frames;
  std::vector<LostPiece> lost;
  /// Whether each piece is known to be as it was written. Files of before schema version 3 have no hashes:
  /// what can be read of them is taken for whole.
  bool verified = false;
  bool has_analyses = false;  ///< which are no part of the run: `talus analyze` added them

  bool is_whole() const { return lost.empty() && lost_frames.empty(); }
};

/// Reads the pieces of the file `bytes`, which messages call `path`. `vouched`: a hash of the whole file is
/// right. Whole frames are returned only if asked to `keep_frames`. Takes no more time than some tens of
/// seconds, and some seconds for each MiB.
RunPieces read_pieces(std::vector<std::byte> bytes, const std::string& path, bool vouched, bool keep_frames);

/// Adds or replaces an array.
void set_array(RunPieces& pieces, const std::string& path, StoredArray array);
/// Takes an array away, where there is one.
void drop_array(RunPieces& pieces, const std::string& path);

/// A text, and an array of doubles. Empty where there is none.
std::string text_of(const RunPieces& pieces, const std::string& path);
std::vector<double> reals_of(const RunPieces& pieces, const std::string& path);

}  // namespace talus
