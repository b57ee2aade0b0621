#pragma once
/// Frames of a run that a user has marked, each with a note, kept in a small file beside the run.

#include <string>
#include <vector>

namespace talus::view {

struct Bookmark {
  double time = 0.0;  ///< s, of the frame
  double tilt = 0.0;  ///< rad, of the frame
  std::string note;   ///< one line; may be empty
};

/// "slope.h5.bookmarks.csv", also of a run that is still a folder.
std::string bookmarks_path(const std::string& run);

/// In the order of their times; none where there is no file. Throws LocatedError(bad_data) at a line that is
/// no bookmark, and as read_text does.
std::vector<Bookmark> read_bookmarks(const std::string& path);

/// A line for each: time (s), tilt (deg) and note, with all digits. Throws as write_text does.
void write_bookmarks(const std::string& path, const std::vector<Bookmark>& bookmarks);

/// Sets the note of the bookmark at that time, or adds one in its place; a line break becomes a blank.
void set_bookmark(std::vector<Bookmark>& bookmarks, Bookmark bookmark);

}  // namespace talus::view
