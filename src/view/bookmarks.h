#pragma once
/// Frames of a run that the user has marked, each with a note. They are stored in a small file next to the
/// run.

#include <string>
#include <vector>

namespace talus::view {

struct Bookmark {
  double time = 0.0;  ///< s, time of the frame
  double tilt = 0.0;  ///< rad, tilt of the frame
  std::string note;   ///< one line; may be empty
};

/// Returns "slope.h5.bookmarks.csv" for "slope.h5", also if the run is still a folder.
std::string bookmarks_path(const std::string& run);

/// Reads the bookmarks in order of time; returns none if the file does not exist. Throws
/// LocatedError(bad_data) at a line that is not a bookmark, and the errors of read_text.
std::vector<Bookmark> read_bookmarks(const std::string& path);

/// Writes one line per bookmark with time (s), tilt (deg) and note, at full precision. Throws the errors of
/// write_text.
void write_bookmarks(const std::string& path, const std::vector<Bookmark>& bookmarks);

/// Sets the note of the bookmark at that time, or inserts a bookmark in order. Line breaks become spaces.
void set_bookmark(std::vector<Bookmark>& bookmarks, Bookmark bookmark);

}  // namespace talus::view
