#pragma once
/// Files that are whole or absent, whatever happens to the process or the machine.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/output_file.h"

namespace talus::io {

/// The whole file. Throws Error(missing_input) where it cannot be opened, Error(io_error) where reading
/// fails.
std::vector<std::byte> read_file(const std::string& path);
std::string read_text(const std::string& path);

/// Writes `bytes` as an OutputFile, commits it, and makes its name durable: a file called `path` is always
/// whole. Throws as OutputFile does.
void write_durably(const std::string& path, std::span<const std::byte> bytes);

/// The same of a text, as UTF-8 whatever the bytes of the names in it.
void write_text(const std::string& path, const std::string& text);

/// Creates a folder durably; one that exists already is taken. Throws creation_error.
void make_folder(const std::string& path);

/// Removes a file if there is one. Throws Error(io_error).
void remove_file(const std::string& path);

}  // namespace talus::io
