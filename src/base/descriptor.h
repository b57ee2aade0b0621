#pragma once
/// A file descriptor that closes itself.

#include <cstddef>
#include <span>
#include <string>

namespace talus {

class Descriptor {
 public:
  explicit Descriptor(int file) : file_(file) {}
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;
  ~Descriptor() { close(); }

  int get() const { return file_; }  ///< negative where opening failed, with the reason in errno
  /// Closes now; false if the system reports an error of an earlier write, with the reason in errno.
  bool close();

 private:
  int file_;
};

/// Fills `buffer` from the file, incompletely only at its end; returns the number of bytes read.
/// Throws Error(io_error), naming `path`.
std::size_t read_at_most(const Descriptor& file, std::span<std::byte> buffer, const std::string& path);

}  // namespace talus
