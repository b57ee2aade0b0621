#pragma once
/// Files that are whole or absent, whatever happens to the process or the machine.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace talus {

/// The whole file. Throws Error(missing_input) where it cannot be opened, Error(io_error) where reading
/// fails.
std::vector<std::byte> read_file(const std::string& path);

/// Writes `bytes` to the name `temporary`, makes them durable, renames to `path` and makes the name durable:
/// a file called `path` is always whole. Both names must be on one file system. A temporary file that a kill
/// left is replaced. Throws Error(io_error), creation_error, and Error(cannot_create) where another process
/// writes to the same name.
void write_durably(const std::string& path, std::span<const std::byte> bytes, const std::string& temporary);

/// Creates a folder durably; one that exists already is taken. Throws creation_error.
void make_folder(const std::string& path);

/// Makes durable that a file or folder has this name, or has it no longer. Throws Error(io_error).
void sync_name(const std::string& path);

/// Removes a file if there is one. Throws Error(io_error).
void remove_file(const std::string& path);

/// The folder that holds `path`, "." for a bare name.
std::string parent_folder(const std::string& path);

}  // namespace talus
