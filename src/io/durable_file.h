#pragma once
/// Files that are complete or absent, even after a crash of the process or the machine.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/output_file.h"

namespace talus::io {

/// Reads an entire file. Throws Error(missing_input) if it cannot be opened, and Error(io_error) if reading
/// fails.
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

}  // namespace talus::io
