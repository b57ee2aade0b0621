#include "io/manifest.h"

#include <algorithm>
#include <filesystem>
#include <fmt/core.h>

#include "base/errors.h"
#include "base/hash.h"
#include "base/paths.h"
#include "base/text_stream.h"
#include "io/durable_file.h"
#include "io/seal.h"

namespace talus::io {
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

std::string body_text(const Manifest& manifest) {
  std::string lines = fmt::format(
      "{}\n{}{}header {}\ncheckpoint {}\n", first_line, manifest.replaces ? "replaces the packed file\n" : "",
      manifest.packed_seal != 0 ? fmt::format("packed {}\n", hash_text(manifest.packed_seal)) : "",
      text_of(manifest.header), text_of(manifest.checkpoint));
  for (const StoredSegment& segment : manifest.segments)
    lines += fmt::format("segment {} {} {} {} {}\n", text_of(segment.file), segment.frames, segment.contacts,
                         segment.observables, segment.steps);
  return lines;
}

Manifest parse(const std::string& text) {
  Manifest manifest;
  std::istringstream lines = text_stream(text);
  for (std::string line; std::getline(lines, line);) {
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

/// Whether a name belongs to a file of the folder, such as header.h5 or checkpoint_000001.h5, whose number
/// can be incremented.
bool is_name_of_store(const std::string& name) {
  const auto digits = std::ranges::count_if(name, [](char c) { return c >= '0' && c <= '9'; });
  return name.ends_with(".h5") && digits <= 16 && name.find('/') == std::string::npos;
}

void check_names(const Manifest& manifest, const std::string& path) {
  for (const StoredFile& file : files_of(manifest))
    if (!is_name_of_store(file.name))
      throw Error(ExitCode::bad_data,
                  fmt::format("{}: names '{}', which is not a file of a run folder", path, file.name));
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
  const std::string body = body_text(manifest);
  return fmt::format("{}hash {}\n", body, hash_text(hash_bytes(std::as_bytes(std::span(body)))));
}

Manifest parse_manifest(const std::string& text, const std::string& path) {
  const std::string found = text.substr(0, text.find('\n'));
  Manifest manifest = parse(text);
  if (manifest_text(manifest) == text) {
    check_names(manifest, path);
    return manifest;
  }
  if (found != first_line && found.starts_with("talus run folder "))
    throw Error(
        ExitCode::bad_data,
        fmt::format(
            "{}: begins with '{}', expected '{}': it is damaged, or was written by another version of Talus",
            path, found, first_line));
  throw Error(ExitCode::bad_data, path +
                                      ": is damaged (its hash does not match its lines); the run cannot be "
                                      "continued: restore the folder from a copy, or save what is undamaged: "
                                      "talus repair RUN.h5 -o NEW.h5");
}

Manifest read_manifest(const std::string& folder) {
  const std::string path = (std::filesystem::path(folder) / Manifest::file_name).string();
  const std::vector<std::byte> bytes = read_file(path);
  return parse_manifest({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path);
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
  const std::string path = (std::filesystem::path(folder) / file.name).string();
  if (!is_there(path))
    throw Error(ExitCode::bad_data,
                fmt::format("{}: is missing, although the manifest names it{}", path, hint));
  std::vector<std::byte> bytes = read_file(path);
  if (bytes.size() != file.size)
    throw Error(ExitCode::bad_data, fmt::format("{}: is damaged: it has {} bytes, the manifest says {}{}",
                                                path, bytes.size(), file.size, hint));
  if (const std::uint64_t hash = hash_bytes(bytes); hash != file.hash)
    throw Error(ExitCode::bad_data, fmt::format("{}: is damaged: its hash is {}, the manifest says {}{}",
                                                path, hash_text(hash), hash_text(file.hash), hint));
  return bytes;
}

}  // namespace talus::io
