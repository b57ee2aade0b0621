#include "io/run_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fmt/core.h>

#include "base/errors.h"
#include "base/hash.h"
#include "base/locked_file.h"
#include "base/text.h"
#include "io/durable_file.h"

namespace talus::io {

static std::string holder(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  std::array<std::byte, 512> text{};
  const std::size_t size = file.get() < 0 ? 0 : read_at_most(file, text, path);
  return size > 0 ? std::string(reinterpret_cast<const char*>(text.data()), size) : "another process";
}

[[noreturn]] static void refuse_held(const std::string& folder, const std::string& writer) {
  throw Error(ExitCode::cannot_create,
              "{} is being written by {}; wait for it to end, or choose another output with -o", folder,
              writer);
}

static Descriptor take_lock(const std::string& folder, const std::string& path) {
  std::optional<Descriptor> file = create_locked(path);
  if (!file) refuse_held(folder, holder(path));
  const std::string text = this_process();
  if (::pwrite(file->get(), text.data(), text.size(), 0) != static_cast<ssize_t>(text.size())) {
    const int error = errno;
    ::unlink(path.c_str());
    throw creation_error("write", path, error);
  }
  return std::move(*file);
}

std::string this_process() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return fmt::format("process {} on host {}", ::getpid(), host.data());
}

WriterLock::WriterLock(const std::string& folder)
    : folder_(folder), path_(path_in(folder, file_name)), file_(take_lock(folder, path_)) {}

WriterLock::~WriterLock() {
  if (file_.get() >= 0) ::flock(file_.get(), LOCK_UN);
}

bool WriterLock::is_held() const { return is_named(path_, file_); }

void WriterLock::remove() {
  if (is_held()) ::unlink(path_.c_str());
  file_.close();
}

void WriterLock::require() const {
  if (is_held()) return;
  throw Error(ExitCode::cannot_create,
              folder_ +
                  " was removed or replaced while it was being written, or another process has taken the run "
                  "over; nothing more is written there: start the run again");
}

std::string writer_of(const std::string& folder) {
  const std::string path = path_in(folder, WriterLock::file_name);
  return is_locked(path).value_or(false) ? holder(path) : "";
}

void require_no_writer(const std::string& folder) {
  if (const std::string writer = writer_of(folder); !writer.empty()) refuse_held(folder, writer);
}

namespace {

constexpr const char* hint = "; save what is undamaged with: talus repair RUN.h5 -o NEW.h5";
constexpr const char* first_line = "talus run folder 1";

std::string text_of(const StoredFile& file) {
  return fmt::format("{} {} {}", file.name, file.size, hash_text(file.hash));
}

std::istream& operator>>(std::istream& words, StoredFile& file) {
  return words >> std::dec >> file.name >> file.size >> std::hex >> file.hash >> std::dec;
}

std::istream& operator>>(std::istream& words, StoredSegment& segment) {
  return words >> segment.file >> segment.frames >> segment.contacts >> segment.observables >> segment.steps;
}

Manifest parse(const std::string& text) {
  Manifest manifest;
  for (const std::string& line : lines_of(text)) {
    std::istringstream words = text_stream(line);
    std::string kind;
    words >> kind;
    if (kind == "replaces") manifest.replaces = true;
    if (kind == "packed") words >> std::hex >> manifest.packed_seal;
    if (kind == "header") words >> manifest.header;
    if (kind == "checkpoint") words >> manifest.checkpoint;
    if (kind == "segment") words >> manifest.segments.emplace_back();
  }
  return manifest;
}

/// Whether a name belongs to a file of the folder, such as checkpoint_000001.h5, whose number can grow.
bool is_name_of_store(const std::string& name) {
  const auto digits = std::ranges::count_if(name, [](char c) { return c >= '0' && c <= '9'; });
  return name.ends_with(".h5") && digits <= 16 && name.find('/') == std::string::npos;
}

}  // namespace

StoredFile describe(const std::string& name, std::span<const std::byte> bytes) {
  return {name, bytes.size(), hash_bytes(bytes)};
}

std::vector<StoredFile> files_of(const Manifest& manifest) {
  std::vector<StoredFile> files = {manifest.header};
  for (const StoredSegment& segment : manifest.segments) files.push_back(segment.file);
  files.push_back(manifest.checkpoint);
  return files;
}

std::string manifest_text(const Manifest& manifest) {
  std::string lines = fmt::format(
      "{}\n{}{}header {}\ncheckpoint {}\n", first_line, manifest.replaces ? "replaces the packed file\n" : "",
      manifest.packed_seal != 0 ? fmt::format("packed {}\n", hash_text(manifest.packed_seal)) : "",
      text_of(manifest.header), text_of(manifest.checkpoint));
  for (const StoredSegment& segment : manifest.segments)
    lines += fmt::format("segment {} {} {} {} {}\n", text_of(segment.file), segment.frames, segment.contacts,
                         segment.observables, segment.steps);
  return fmt::format("{}hash {}\n", lines, text_hash(lines));
}

Manifest parse_manifest(const std::string& text, const std::string& path) {
  const std::string found = text.substr(0, text.find('\n'));
  Manifest manifest = parse(text);
  if (manifest_text(manifest) == text) {
    for (const StoredFile& file : files_of(manifest))
      if (!is_name_of_store(file.name))
        throw Error(ExitCode::bad_data, "{}: names '{}', which is not a file of a run folder", path,
                    file.name);
    return manifest;
  }
  if (found != first_line && found.starts_with("talus run folder "))
    throw Error(
        ExitCode::bad_data,
        "{}: begins with '{}', expected '{}': it is damaged, or was written by another version of Talus",
        path, found, first_line);
  throw Error(ExitCode::bad_data, path +
                                      ": is damaged (its hash does not match its lines); the run cannot be "
                                      "continued: restore the folder from a copy, or save what is undamaged: "
                                      "talus repair RUN.h5 -o NEW.h5");
}

Manifest read_manifest(const std::string& folder) {
  const std::string path = path_in(folder, Manifest::file_name);
  return parse_manifest(read_text(path), path);
}

bool hides_packed(const std::string& folder, const std::string& packed) {
  Manifest manifest;
  try {
    manifest = read_manifest(folder);
  } catch (const Error&) {
    return false;
  }
  try {
    if (manifest.packed_seal != 0) return manifest.packed_seal != seal_hash_of(packed);
    return manifest.replaces || !begins_as_run(packed);
  } catch (const Error&) {
    return true;  // the file cannot be read
  }
}

std::vector<std::byte> read_stored(const std::string& folder, const StoredFile& file) {
  const std::string path = path_in(folder, file.name);
  if (!is_there(path))
    throw Error(ExitCode::bad_data, "{}: is missing, although the manifest names it{}", path, hint);
  std::vector<std::byte> bytes = read_file(path);
  if (bytes.size() != file.size)
    throw Error(ExitCode::bad_data, "{}: is damaged: it has {} bytes, the manifest says {}{}", path,
                bytes.size(), file.size, hint);
  if (const std::uint64_t hash = hash_bytes(bytes); hash != file.hash)
    throw Error(ExitCode::bad_data, "{}: is damaged: its hash is {}, the manifest says {}{}", path,
                hash_text(hash), hash_text(file.hash), hint);
  return bytes;
}

}  // namespace talus::io
