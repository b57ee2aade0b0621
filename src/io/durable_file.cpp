#include "io/durable_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fmt/core.h>

#include "base/errors.h"
#include "base/hash.h"
#include "base/text.h"
#include "io/run_store.h"

namespace talus::io {

std::vector<std::byte> read_file(const std::string& path) {
  // Avoids blocking on a pipe without a writer.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (file.get() < 0 || ::fstat(file.get(), &status) != 0)
    throw system_error(ExitCode::missing_input, "open", path, errno);
  if (!S_ISREG(status.st_mode))
    throw Error(
        ExitCode::missing_input,
        path + (S_ISDIR(status.st_mode) ? " is a folder" : " is a pipe or a device") + "; expected a file");
  std::vector<std::byte> bytes(static_cast<std::size_t>(status.st_size));
  bytes.resize(read_at_most(file, bytes, path));
  return bytes;
}

void write_durably(const std::string& path, std::span<const std::byte> bytes) {
  OutputFile file(path);
  file.write(bytes);
  file.commit();
  sync_name(file.target());
}

std::string read_text(const std::string& path) {
  const std::vector<std::byte> bytes = read_file(path);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void write_text(const std::string& path, const std::string& text) {
  const std::string valid = utf8(text);
  write_durably(path, std::as_bytes(std::span(valid)));
}

void make_folder(const std::string& path) {
  if (::mkdir(path.c_str(), 0777) != 0 && errno != EEXIST)
    throw creation_error("create the folder", path, errno);
  sync_name(path);
}

void remove_file(const std::string& path) {
  if (::unlink(path.c_str()) != 0 && errno != ENOENT)
    throw system_error(ExitCode::io_error, "remove", path, errno);
}

namespace {

constexpr std::size_t read_size = std::size_t{1} << 20;

std::vector<std::byte> seal_of(std::string_view kind, std::uint64_t size, std::uint64_t hash) {
  const std::string text =
      fmt::format("{}size {}\nxxh3 of all after byte 512 {}\n", kind, size, hash_text(hash));
  std::vector<std::byte> block(seal_size);
  std::memcpy(block.data(), text.data(), text.size());
  return block;
}

/// A file opened at its beginning, and its first bytes.
struct FileBeginning {
  Descriptor file;
  std::vector<std::byte> bytes;
};

FileBeginning begin_of(const std::string& path, std::size_t size) {
  FileBeginning begin{Descriptor(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)),
                      std::vector<std::byte>(size)};
  if (begin.file.get() < 0) throw system_error(ExitCode::missing_input, "open", path, errno);
  begin.bytes.resize(read_at_most(begin.file, begin.bytes, path));
  return begin;
}

/// Throws because the averages of an ensemble were expected at `path`.
[[noreturn]] void refuse_no_averages(const std::string& path) {
  throw Error(ExitCode::bad_data,
              path +
                  ": is not the ensemble.h5 of an ensemble (it does not begin with 'talus averages file 2'), "
                  "or one of an earlier version of Talus; recreate it with: talus ensemble average FOLDER, "
                  "once the runs of an earlier version have been moved into a new ensemble");
}

bool starts_with(std::span<const std::byte> bytes, std::string_view text) {
  return bytes.size() >= text.size() && std::memcmp(bytes.data(), text.data(), text.size()) == 0;
}

}  // namespace

std::vector<std::byte> sealed(std::vector<std::byte> file, std::string_view kind) {
  const auto hash = hash_bytes(std::span(file).subspan(seal_size));
  std::ranges::copy(seal_of(kind, file.size(), hash), file.begin());
  return file;
}

bool begins_with(const std::string& path, std::string_view bytes) {
  if (!is_file(path)) return false;  // a pipe can be read only once
  if (::access(path.c_str(), R_OK) != 0 && errno == EACCES)
    return false;  // the code that needs it reports the error
  return starts_with(begin_of(path, bytes.size()).bytes, bytes);
}

bool begins_as_run(const std::string& path) { return begins_with(path, run_seal); }

bool begins_as_averages(const std::string& path) { return begins_with(path, "talus averages file "); }

std::uint64_t sealed_size(std::span<const std::byte> file) {
  const std::string begin(reinterpret_cast<const char*>(file.data()), std::min(file.size(), seal_size));
  const std::string words = fmt::format("{}size ", run_seal);
  return begin.starts_with(words) ? std::strtoull(begin.c_str() + words.size(), nullptr, 10) : 0;
}

std::uint64_t seal_hash(std::span<const std::byte> file) {
  return hash_bytes(file.first(std::min(file.size(), seal_size)));
}

std::uint64_t seal_hash_of(const std::string& path) { return seal_hash(begin_of(path, seal_size).bytes); }

void verify_seal(const std::string& path, std::string_view kind) {
  const FileBeginning begin = begin_of(path, seal_size);
  const bool is_run = kind == run_seal;
  if (!starts_with(begin.bytes, kind)) is_run ? refuse_no_run(path) : refuse_no_averages(path);
  Hasher hasher;
  std::uint64_t size = begin.bytes.size();
  std::vector<std::byte> buffer(read_size);
  while (const std::size_t count = read_at_most(begin.file, buffer, path)) {
    hasher.add_bytes(buffer.data(), count);
    size += count;
  }
  if (begin.bytes == seal_of(kind, size, hasher.value())) return;
  throw Error(ExitCode::bad_data,
              "{}: is damaged: its {} bytes have the hash {}, but its first lines say otherwise; "
              "restore it from a copy, or {}",
              path, size, hash_text(hasher.value()),
              is_run ? fmt::format("save what is undamaged with: talus repair {} -o NEW.h5", path)
                     : "recreate it with: talus ensemble average FOLDER");
}

}  // namespace talus::io
