#pragma once
/// What is whole of a damaged run: of its packed file, or of the files of its folder. Private to this room.

#include "io/run_pieces.h"

namespace talus {

struct Salvage {
  RunPieces pieces;
  /// Of a folder: the pieces are those of the run up to a commit, with its state; it can be continued.
  bool goes_on = false;
  std::size_t frames = 0;             ///< that there were, as far as is known
  std::vector<LostPiece> not_needed;  ///< lost pieces of files that the run can go on without
};

/// Reads a packed file, or a folder that has files of a run. Throws Error(bad_data) where nothing can be
/// kept, Error(cannot_create) where a process is at work in the folder.
Salvage salvage_file(const std::string& path);
Salvage salvage_folder(const std::string& folder);

/// The same without choosing, and without the frames that are whole unless asked to keep them: all that is
/// damaged.
RunPieces inspect_file(const std::string& path, bool keep_frames = false);
RunPieces inspect_folder(const std::string& folder);

}  // namespace talus
