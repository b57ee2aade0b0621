#pragma once
/// Output files that appear whole or not at all, and the rule of what they may replace.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/descriptor.h"

namespace talus {

/// What an output may replace.
struct OutputRule {
  bool overwrite = true;                 ///< a file that exists
  std::vector<std::string> inputs = {};  ///< files and folders that are read, and never replaced
};

/// The file that an output called `path` makes or replaces: `path` itself, or the file that it is a link to.
/// This is the only place that decides what may be replaced. Throws Error(cannot_create) where `path` is
/// anything but a regular file (a folder, a device, a FIFO, a socket, a link that leads nowhere), a file that
/// is write-protected or a file that may not be overwritten, and Error(usage) where it could be, but is one
/// of the inputs, or a file in one of them, under whatever name.
std::string output_target(const std::string& path, const OutputRule& rule = {});

/// Why a file that exists cannot be replaced: it is write-protected, or no file can be made in its folder.
/// Empty where neither is so. A file that nobody may write is protected from the superuser too, whom the
/// system would let write it.
std::string protection_of(const std::string& path);

/// A file under the temporary name `TARGET.talus.part` beside its target, which gets its final name by commit
/// and vanishes otherwise. A temporary file that a kill left is replaced when the same file is written again.
class OutputFile {
 public:
  /// Throws as output_target does, creation_error, and Error(cannot_create) where another process writes the
  /// same file.
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::string& temporary_path() const { return temporary_path_; }
  /// The path that is written, to which a link leads.
  const std::string& target() const { return target_; }
  /// Throws Error(io_error).
  void write(std::span<const std::byte> bytes);
  void write(std::span<const std::uint8_t> bytes) { write(std::as_bytes(bytes)); }
  /// Makes durable what was written, and sees that it is there. May be called before commit, which does it in
  /// any case. Throws Error(io_error).
  void flush();
  /// Gives the file its name. A file that it replaces hands on its mode and, as far as the system allows, its
  /// owner. Throws Error(io_error) and Error(cannot_create).
  void commit();

 private:
  std::string path_;
  std::string target_;
  std::string temporary_path_;
  Descriptor file_;
  std::uint64_t written_ = 0;  ///< bytes, by write
  bool committed_ = false;
};

/// A file in memory for another program to write, which may end well even if a disk is full: what it has
/// written here is whole if it ended well, and then goes through an OutputFile.
class MemoryFile {
 public:
  /// `name` is what messages call it. Throws Error(io_error).
  explicit MemoryFile(const std::string& name);
  /// The path by which other processes of this user open it while it lives.
  std::string path() const;
  /// Throws Error(io_error) if nothing was written, and as OutputFile::write.
  void copy_to(OutputFile& file) const;
  /// The same as bytes. Throws as copy_to.
  std::vector<std::uint8_t> bytes() const;

 private:
  std::string name_;
  Descriptor file_;
};

/// Gives a file that another program made at `made`, which is whole, the name `path`, as OutputFile::commit
/// does, on another file system too. Throws as OutputFile does.
void give_name(const std::string& made, const std::string& path);

/// The folder that holds `path`, "." for a bare name.
std::string parent_folder(const std::string& path);

/// Makes durable that a file or folder has this name, or has it no longer. Throws Error(io_error).
void sync_name(const std::string& path);

/// Makes a folder with its parents where it is missing, and removes from it what killed processes have left
/// (clear_leftovers). Throws Error(cannot_create), also where files cannot be made in it.
void prepare_folder(const std::string& folder);

/// Makes the folder that is to hold `path` where it is missing, or clears it, as prepare_folder does.
void prepare_folder_of(const std::string& path);

}  // namespace talus
