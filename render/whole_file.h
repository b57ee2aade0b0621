#pragma once
/// Whether a file that another program wrote is complete.

#include <string>

namespace talus {

/// Whether the file at `path` is complete by the rules of the format that its final name `name` ends in:
/// .png decodes, with all check sums; .mp4 and .webm are boxes that end where the file does, with their
/// tables; .gif is blocks up to its trailer; .pdf has a table of objects that are where it says; .svg has as
/// many ends as beginnings. Programs write such files from the beginning to the end, and what they write last
/// tells: a file that was cut off anywhere is not complete. Throws Error(internal) at another ending.
bool is_whole_file(const std::string& path, const std::string& name);

}  // namespace talus
