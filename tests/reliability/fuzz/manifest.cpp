/// Any text as the manifest of a run folder and of an ensemble, unchanged and with a matching hash.

#include <cstdint>
#include <cstdlib>
#include <span>

#include "base/errors.h"
#include "base/hash.h"
#include "ensemble/ensemble_manifest.h"
#include "io/run_folder.h"

namespace {

void parse(const std::string& text) {
  try {
    if (talus::io::manifest_text(talus::io::parse_manifest(text, "manifest")) != text) std::abort();
  } catch (const talus::Error& error) {
    if (error.code() != talus::ExitCode::bad_data) std::abort();
  }
}

void parse_ensemble(const std::string& text) {
  try {
    if (talus::ensemble::manifest_text(talus::ensemble::parse_manifest(text, "manifest")) != text)
      std::abort();
  } catch (const talus::Error& error) {
    if (error.code() != talus::ExitCode::bad_data) std::abort();
  }
}

std::string hash_of(const std::string& text) {
  return talus::hash_text(talus::hash_bytes(std::as_bytes(std::span(text))));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  parse(text);
  parse(text + "hash " + hash_of(text) + "\n");
  const std::string begin = text + ",\n \"hash\": ";
  parse_ensemble(text);
  parse_ensemble(begin + "\"" + hash_of(begin) + "\"\n}\n");
  return 0;
}
