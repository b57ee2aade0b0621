#pragma once
/// Files and paths. Output files appear complete or not at all; the rule for the files that they may replace
/// is here as well.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

namespace talus {

// A file descriptor that is closed by its destructor.

class Descriptor {
 public:
  explicit Descriptor(int file) : file_(file) {}
  Descriptor(Descriptor&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(file_, other.file_);
    return *this;
  }
  ~Descriptor() { close(); }

  int get() const { return file_; }  ///< negative if opening failed, with the reason in errno
  /// Closes the file; returns false, with the reason in errno, if the system reports an error of an earlier
  /// write.
  bool close();

 private:
  int file_;
};

/// Fills `buffer` from the file, incompletely only at the end of the file; returns the number of bytes read.
/// Throws Error(io_error), naming `path`.
std::size_t read_at_most(const Descriptor& file, std::span<std::byte> buffer, const std::string& path);

// Queries of paths. None of them throws exceptions of std::filesystem: a loop of links, a name that is too
// long or a folder without permission gives a result, or an Error with a message.

/// Whether a path exists, is a regular file, or a folder, after following links; false if that cannot be
/// determined.
bool is_there(const std::string& path);
bool is_file(const std::string& path);
bool is_folder(const std::string& path);

/// Identifies a file and its contents, which stay the same with it.
struct FileMark {
  std::uint64_t device = 0, inode = 0, size = 0;
  std::int64_t seconds = 0, nanoseconds = 0;  ///< time of the last change
  bool operator==(const FileMark&) const = default;
  bool operator<(const FileMark& other) const {
    return std::tie(device, inode, size, seconds, nanoseconds) <
           std::tie(other.device, other.inode, other.size, other.seconds, other.nanoseconds);
  }
};
/// Returns the mark of a file; no value, with the reason in errno, if there is none.
std::optional<FileMark> mark_of_file(const std::string& path);

/// Returns the path of a name in a folder.
std::string path_in(const std::string& folder, std::string_view name);

/// Returns the path from the root, without following links; the path itself if the working folder is missing.
std::string absolute_path(const std::string& path);

/// Returns the absolute path without links, dots and doubled slashes, which is equal for all names of a file.
/// Parts that do not exist or cannot be followed are kept.
std::string resolved_path(const std::string& path);

/// Returns the names in a folder, in no order; none, with the reason in `error`, if it cannot be read.
std::vector<std::string> names_in(const std::string& folder, std::error_code& error);
/// Returns the names in a folder. Throws Error(io_error) if it cannot be read.
std::vector<std::string> names_in(const std::string& folder);

/// Rule for the files that an output may replace.
struct OutputRule {
  bool overwrite = true;                 ///< whether an existing file may be replaced
  std::vector<std::string> inputs = {};  ///< files and folders that are read, and never replaced
};

/// Returns the file that an output called `path` creates or replaces: `path` itself, or the target of a link.
/// No other function decides what may be replaced. Throws Error(cannot_create) if `path` exists and is not a
/// regular file (a folder, a device, a FIFO, a socket, a broken link), is write-protected, or may not be
/// overwritten. Throws Error(usage) if it may be overwritten but is one of the inputs, or a file in one of
/// them, under any name. If nothing may be overwritten and nothing is there, the process remembers this: the
/// output then replaces no file that another process has created under this name meanwhile.
std::string output_target(const std::string& path, const OutputRule& rule = {});

/// Returns why an existing file cannot be replaced: it is write-protected, or no file can be created in its
/// folder. Empty if it can be replaced. A file without any write permission is also protected from the
/// superuser, whom the system would permit to write it.
std::string protection_of(const std::string& path);

/// A file under the temporary name `TARGET.talus.part` next to its target. commit() gives it its final name;
/// otherwise it is removed. A temporary file left by a killed process is replaced when the same file is
/// written again.
class OutputFile {
 public:
  /// Throws the errors of output_target, creation_error, and Error(cannot_create) if another process writes
  /// the same file.
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::string& temporary_path() const { return temporary_path_; }
  /// Returns the path that is written, after following a link.
  const std::string& target() const { return target_; }
  /// Throws Error(io_error).
  void write(std::span<const std::byte> bytes);
  void write(std::span<const std::uint8_t> bytes) { write(std::as_bytes(bytes)); }
  /// Makes the written bytes durable (fsync) and verifies their number. commit() calls this function too.
  /// Throws Error(io_error).
  void flush();
  /// Gives the file its final name. It inherits the mode and, as far as the system permits, the owner of a
  /// file that it replaces. Throws Error(io_error) and Error(cannot_create), the latter also if a file has
  /// appeared under a name that output_target has found free.
  void commit();

 private:
  std::string path_;
  std::string target_;
  std::string temporary_path_;
  Descriptor file_;
  std::uint64_t written_ = 0;  ///< number of bytes passed to write()
  bool committed_ = false;
  bool is_listed_ = false;  ///< for remove_unfinished_files
};

/// Removes the temporary files of all OutputFile of this process; safe in a signal handler, which must end
/// the process afterwards.
void remove_unfinished_files();

/// A file in memory for another program to write. Some programs report success even if a disk is full; in
/// memory, success means that the output is complete. It is then copied to an OutputFile.
class MemoryFile {
 public:
  /// Creates the file; `name` appears in messages. Throws Error(io_error).
  explicit MemoryFile(const std::string& name);
  /// Returns the path by which other processes of this user can open the file while this object exists.
  std::string path() const;
  /// Copies the contents. Throws Error(io_error) if nothing was written, and the errors of OutputFile::write.
  void copy_to(OutputFile& file) const;
  /// Returns the contents. Throws Error(io_error) if nothing was written.
  std::vector<std::uint8_t> bytes() const;

 private:
  std::string name_;
  Descriptor file_;
};

/// Gives a complete file `made` by another program the name `path`, as OutputFile::commit does, even on
/// another file system. Throws the errors of OutputFile.
void publish_file(const std::string& made, const std::string& path);

/// Declares that an output of this process called `path` must not replace a file, as output_target does for
/// one that must not be overwritten and is not there. `advice` ends the message if a file has appeared.
void keep_free(const std::string& path,
               const std::string& advice = "give --overwrite to replace it, or another -o");
/// Revokes keep_free.
void allow_replacing(const std::string& path);

/// Returns the folder that contains `path`; "." for a bare name.
std::string parent_folder(const std::string& path);

/// Makes the creation or removal of this name durable (fsync of its folder). Throws Error(io_error).
void sync_name(const std::string& path);

/// Creates a folder and its parents if missing, and removes leftovers of killed processes from it
/// (clear_leftovers). Throws Error(cannot_create), also if no files can be created in it.
void prepare_folder(const std::string& folder);

/// Creates the folder that will contain `path` if missing, and removes leftovers, as prepare_folder does.
void prepare_folder_of(const std::string& path);

}  // namespace talus
