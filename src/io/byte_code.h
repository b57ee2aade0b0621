#pragma once
/// Plain values and arrays to bytes and back, for the way from a child process: counts of 64 bits, values as
/// they are in memory. Private to this room.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace talus {

inline void append_bytes(std::vector<std::byte>& bytes, const void* data, std::size_t size) {
  const std::size_t before = bytes.size();
  bytes.resize(before + size);
  if (size > 0) std::memcpy(bytes.data() + before, data, size);
}

inline void append_number(std::vector<std::byte>& bytes, std::uint64_t number) {
  append_bytes(bytes, &number, sizeof number);
}

template <typename Values>
void append_counted(std::vector<std::byte>& bytes, const Values& values) {
  append_number(bytes, values.size());
  append_bytes(bytes, values.data(), values.size() * sizeof(*values.data()));
}

/// Takes from the front what was appended; fails for good at the first thing that is not there, as where HDF5
/// has damaged the memory of its process.
class ByteSource {
 public:
  explicit ByteSource(std::span<const std::byte> bytes) : rest_(bytes) {}

  std::uint64_t number() {
    std::uint64_t value = 0;
    take(&value, sizeof value);
    return value;
  }

  template <typename Values>
  Values counted() {
    Values values;
    const std::uint64_t count = number();
    if (count > rest_.size() / sizeof(*values.data())) failed_ = true;
    if (failed_) return values;
    values.resize(count);
    take(values.data(), count * sizeof(*values.data()));
    return values;
  }

  bool at_end() const { return rest_.empty() || failed_; }
  bool succeeded() const { return rest_.empty() && !failed_; }

 private:
  void take(void* data, std::size_t size) {
    if (size > rest_.size()) failed_ = true;
    if (failed_ || size == 0) return;
    std::memcpy(data, rest_.data(), size);
    rest_ = rest_.subspan(size);
  }

  std::span<const std::byte> rest_;
  bool failed_ = false;
};

}  // namespace talus
