#include "base/descriptor.h"

#include <unistd.h>

#include <cerrno>
#include <utility>

#include "base/errors.h"

namespace talus {

Descriptor::Descriptor(Descriptor&& other) noexcept : file_(std::exchange(other.file_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(file_, other.file_);
  return *this;
}

bool Descriptor::close() {
  const int file = std::exchange(file_, -1);
  return file < 0 || ::close(file) == 0;
}

std::size_t read_at_most(const Descriptor& file, std::span<std::byte> buffer, const std::string& path) {
  std::size_t done = 0;
  while (done < buffer.size()) {
    const ssize_t count = ::read(file.get(), buffer.data() + done, buffer.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw system_error(ExitCode::io_error, "read", path, errno);
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  return done;
}

}  // namespace talus
