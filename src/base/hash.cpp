#include "base/hash.h"

#include <xxhash.h>

#include <charconv>
#include <fmt/core.h>
#include <new>

namespace talus {

Hasher::Hasher() : state_(XXH3_createState()) {
  if (state_ == nullptr) throw std::bad_alloc();
  XXH3_64bits_reset(state_);
}

Hasher::~Hasher() { XXH3_freeState(state_); }

void Hasher::add_bytes(const void* data, std::size_t size) {
  if (size > 0) XXH3_64bits_update(state_, data, size);
}

std::uint64_t Hasher::value() const { return XXH3_64bits_digest(state_); }

std::uint64_t hash_bytes(std::span<const std::byte> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

std::string hash_text(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

std::string text_hash(std::string_view text) { return hash_text(hash_bytes(std::as_bytes(std::span(text)))); }

std::uint64_t parse_hash(const std::string& text) {
  std::uint64_t hash = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), hash, 16);
  return text.size() == 16 && error == std::errc() && end == text.data() + text.size() ? hash : 0;
}

}  // namespace talus
