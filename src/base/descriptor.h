#pragma once
/// A file descriptor that is closed by its destructor.

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

  int get() const { return file_; }  ///< negative if opening failed, with the reason in errno
  /// Closes the file; returns false, with the reason in errno, if the system reports an error of an earlier
  /// write.
  bool close();

 private:
  int file_;
};

/// Fills `buffer` from the file, incompletely only at the end of the file; returns the number of bytes read.
/// Throws Error(io_error), naming `path`.
std::size_t read_at_most(const Descriptor& file, std::span<std::byte> buffer, const std::string& path);

}  // namespace talus
