#include "io/manifest.h"

#include <filesystem>
#include <sstream>

#include "core/errors.h"
#include "core/hash.h"
#include "io/durable_file.h"

namespace talus {
namespace {

constexpr const char* first_line = "talus run folder 1";

std::ostream& operator<<(std::ostream& words, const StoredFile& file) {
  return words << file.name << ' ' << file.size << ' ' << hash_text(file.hash);
}

std::istream& operator>>(std::istream& words, StoredFile& file) {
  return words >> std::dec >> file.name >> file.size >> std::hex >> file.hash >> std::dec;
}

std::istream& operator>>(std::istream& words, StoredSegment& segment) {
  return words >> segment.file >> segment.frames >> segment.contacts >> segment.observables >> segment.steps;
}

std::string body_text(const Manifest& manifest) {
  std::ostringstream lines;
  lines << first_line << '\n';
  lines << "header " << manifest.header << '\n';
  lines << "checkpoint " << manifest.checkpoint << '\n';
  for (const StoredSegment& segment : manifest.segments)
    lines << "segment " << segment.file << ' ' << segment.frames << ' ' << segment.contacts << ' '
          << segment.observables << ' ' << segment.steps << '\n';
  return lines.str();
}

Manifest parse(const std::string& text) {
  Manifest manifest;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "header") words >> manifest.header;
    if (kind == "checkpoint") words >> manifest.checkpoint;
    if (kind == "segment") words >> manifest.segments.emplace_back();
  }
  return manifest;
}

}  // namespace

StoredFile describe(const std::string& name, std::span<const std::byte> bytes) {
  return {name, bytes.size(), hash_bytes(bytes)};
}

std::string manifest_text(const Manifest& manifest) {
  const std::string body = body_text(manifest);
  return body + "hash " + hash_text(hash_bytes(std::as_bytes(std::span(body)))) + "\n";
}

Manifest read_manifest(const std::string& folder) {
  const std::string path = (std::filesystem::path(folder) / Manifest::file_name).string();
  const std::vector<std::byte> bytes = read_file(path);
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::string found = text.substr(0, text.find('\n'));
  Manifest manifest = parse(text);
  if (manifest_text(manifest) == text) return manifest;
  if (found != first_line && found.starts_with("talus run folder "))
    throw Error(ExitCode::bad_data, path + ": begins with '" + found + "', expected '" + first_line +
                                        "': it is damaged, or was written by another version of Talus");
  throw Error(ExitCode::bad_data, path +
                                      ": is damaged (its hash is not that of its lines); the run cannot be "
                                      "continued: restore the folder from a copy, or compute it again with "
                                      "--overwrite");
}

std::vector<std::byte> read_stored(const std::string& folder, const StoredFile& file) {
  const std::string path = (std::filesystem::path(folder) / file.name).string();
  if (!std::filesystem::exists(path))
    throw Error(ExitCode::bad_data, path + ": is missing, although the manifest names it");
  std::vector<std::byte> bytes = read_file(path);
  if (bytes.size() != file.size)
    throw Error(ExitCode::bad_data, path + ": is damaged: it has " + std::to_string(bytes.size()) +
                                        " bytes, the manifest says " + std::to_string(file.size));
  if (const std::uint64_t hash = hash_bytes(bytes); hash != file.hash)
    throw Error(ExitCode::bad_data, path + ": is damaged: its hash is " + hash_text(hash) +
                                        ", the manifest says " + hash_text(file.hash));
  return bytes;
}

}  // namespace talus
