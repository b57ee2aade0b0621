#pragma once
/// 64-bit hashes of states and files (XXH3, equal on all platforms of the same byte order).

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

struct XXH3_state_s;

namespace talus {

/// A running hash of plain data.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;

  void add_bytes(const void* data, std::size_t size);

  template <typename T>
  requires std::is_arithmetic_v<T>
  void add(T value) { add_bytes(&value, sizeof value); }

  /// Adds an array and its number of elements, so that moving elements between two arrays changes the hash.
  template <typename Container>
  void add_array(const Container& values) {
    add<std::uint64_t>(values.size());
    add_bytes(values.data(), values.size() * sizeof(*values.data()));
  }

  std::uint64_t value() const;

 private:
  XXH3_state_s* state_;
};

std::uint64_t hash_bytes(std::span<const std::byte> bytes);

/// Returns a hash as 16 lower-case hexadecimal digits.
std::string hash_text(std::uint64_t hash);

/// Returns the hash of the bytes of a text in this form.
std::string text_hash(std::string_view text);

/// Returns the hash of a text made by hash_text; 0 for any other text.
std::uint64_t parse_hash(const std::string& text);

}  // namespace talus
