#include "page/deflated.h"

#include <zlib.h>

#include <new>

namespace talus {

std::vector<std::byte> deflated(std::span<const std::byte> bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<std::byte> result(size);
  // zlib's own types of bytes.
  const int state =
      compress2(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), Z_BEST_COMPRESSION);
  if (state != Z_OK) throw std::bad_alloc();  // what else compress2 reports is too small a buffer
  result.resize(size);
  return result;
}

}  // namespace talus
