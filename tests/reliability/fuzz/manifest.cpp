/// Any text as the manifest of a run folder, unchanged and with a matching hash.

#include "io/manifest.h"

#include <cstdint>
#include <cstdlib>
#include <span>

#include "base/errors.h"
#include "base/hash.h"

namespace {

void parse(const std::string& text) {
  try {
    if (talus::io::manifest_text(talus::io::parse_manifest(text, "manifest")) != text) std::abort();
  } catch (const talus::Error& error) {
    if (error.code() != talus::ExitCode::bad_data) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const std::uint64_t hash = talus::hash_bytes(std::as_bytes(std::span(text)));
  parse(text);
  parse(text + "hash " + talus::hash_text(hash) + "\n");
  return 0;
}
