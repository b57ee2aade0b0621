#include "io/manifest.h"

#include <algorithm>
#include <filesystem>

#include "core/errors.h"
#include "core/hash.h"
#include "core/text_stream.h"
#include "io/durable_file.h"

namespace talus {
namespace {

constexpr const char* hint = "; keep what is whole of the run: talus repair RUN.h5 -o NEW.h5";
constexpr const char* first_line = "talus run folder 1";

std::string text_of(const StoredFile& file) {
  return file.name + ' ' + std::to_string(file.size) + ' ' + hash_text(file.hash);
}

std::istream& operator>>(std::istream& words, StoredFile& file) {
  return words >> std::dec >> file.name >> file.size >> std::hex >> file.hash >> std::dec;
}

std::istream& operator>>(std::istream& words, StoredSegment& segment) {
  return words >> segment.file >> segment.frames >> segment.contacts >> segment.observables >> segment.steps;
}

std::string body_text(const Manifest& manifest) {
  std::string lines = first_line;
  lines.append("\nheader ").append(text_of(manifest.header));
  lines.append("\ncheckpoint ").append(text_of(manifest.checkpoint)).append("\n");
  for (const StoredSegment& segment : manifest.segments) {
    lines.append("segment ").append(text_of(segment.file));
    for (const std::uint64_t count : {segment.frames, segment.contacts, segment.observables, segment.steps})
      lines.append(" ").append(std::to_string(count));
    lines.append("\n");
  }
  return lines;
}

Manifest parse(const std::string& text) {
  Manifest manifest;
  std::istringstream lines = text_stream(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words = text_stream(line);
    std::string kind;
    words >> kind;
    if (kind == "header") words >> manifest.header;
    if (kind == "checkpoint") words >> manifest.checkpoint;
    if (kind == "segment") words >> manifest.segments.emplace_back();
  }
  return manifest;
}

/// header.h5, checkpoint_000001.h5: of the folder itself, with a number that can be counted on from.
bool is_name_of_store(const std::string& name) {
  const auto digits = std::ranges::count_if(name, [](char c) { return c >= '0' && c <= '9'; });
  return name.ends_with(".h5") && digits <= 16 && name.find('/') == std::string::npos;
}

void check_names(const Manifest& manifest, const std::string& path) {
  std::vector<StoredFile> files = {manifest.header, manifest.checkpoint};
  for (const StoredSegment& segment : manifest.segments) files.push_back(segment.file);
  for (const StoredFile& file : files)
    if (!is_name_of_store(file.name))
      throw Error(ExitCode::bad_data, path + ": names '" + file.name + "', which is no file of a run folder");
}

}  // namespace

StoredFile describe(const std::string& name, std::span<const std::byte> bytes) {
  return {name, bytes.size(), hash_bytes(bytes)};
}

std::string manifest_text(const Manifest& manifest) {
  const std::string body = body_text(manifest);
  return body + "hash " + hash_text(hash_bytes(std::as_bytes(std::span(body)))) + "\n";
}

Manifest parse_manifest(const std::string& text, const std::string& path) {
  const std::string found = text.substr(0, text.find('\n'));
  Manifest manifest = parse(text);
  if (manifest_text(manifest) == text) {
    check_names(manifest, path);
    return manifest;
  }
  if (found != first_line && found.starts_with("talus run folder "))
    throw Error(ExitCode::bad_data, path + ": begins with '" + found + "', expected '" + first_line +
                                        "': it is damaged, or was written by another version of Talus");
  throw Error(ExitCode::bad_data,
              path +
                  ": is damaged (its hash is not that of its lines); the run cannot be "
                  "continued: restore the folder from a copy, or keep what is whole of it: "
                  "talus repair RUN.h5 -o NEW.h5");
}

Manifest read_manifest(const std::string& folder) {
  const std::string path = (std::filesystem::path(folder) / Manifest::file_name).string();
  const std::vector<std::byte> bytes = read_file(path);
  return parse_manifest({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path);
}

std::vector<std::byte> read_stored(const std::string& folder, const StoredFile& file) {
  const std::string path = (std::filesystem::path(folder) / file.name).string();
  if (!std::filesystem::exists(path))
    throw Error(ExitCode::bad_data, path + ": is missing, although the manifest names it" + hint);
  std::vector<std::byte> bytes = read_file(path);
  if (bytes.size() != file.size)
    throw Error(ExitCode::bad_data, path + ": is damaged: it has " + std::to_string(bytes.size()) +
                                        " bytes, the manifest says " + std::to_string(file.size) + hint);
  if (const std::uint64_t hash = hash_bytes(bytes); hash != file.hash)
    throw Error(ExitCode::bad_data, path + ": is damaged: its hash is " + hash_text(hash) +
                                        ", the manifest says " + hash_text(file.hash) + hint);
  return bytes;
}

}  // namespace talus
