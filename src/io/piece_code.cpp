#include "io/piece_code.h"

#include "io/byte_code.h"

namespace talus {

using Bytes = std::vector<std::byte>;

Bytes encode(const std::optional<hdf5::Reader::Stored>& array) {
  Bytes bytes;
  if (!array) return bytes;
  append_counted(bytes, array->dims);
  append_counted(bytes, array->values);
  append_number(bytes, array->hash ? 1 : 0);
  append_number(bytes, array->hash.value_or(0));
  return bytes;
}

Bytes encode(const StoredFrame& frame) {
  Bytes bytes;
  append_number(bytes, frame.contacts);
  for (const Bytes& rows : frame.rows) append_counted(bytes, rows);
  return bytes;
}

Bytes encode(const std::vector<std::string>& names) {
  Bytes bytes;
  for (const std::string& name : names) append_counted(bytes, name);
  return bytes;
}

std::optional<hdf5::Reader::Stored> decode_array(const Bytes& bytes) {
  ByteSource source(bytes);
  hdf5::Reader::Stored array;
  array.dims = source.counted<std::vector<std::uint64_t>>();
  array.values = source.counted<Bytes>();
  const bool hashed = source.number() == 1;
  const std::uint64_t hash = source.number();
  if (hashed) array.hash = hash;
  return source.succeeded() ? std::optional(std::move(array)) : std::nullopt;
}

std::optional<StoredFrame> decode_frame(const Bytes& bytes) {
  ByteSource source(bytes);
  StoredFrame frame;
  frame.contacts = source.number();
  while (!source.at_end()) frame.rows.push_back(source.counted<Bytes>());
  return source.succeeded() ? std::optional(std::move(frame)) : std::nullopt;
}

std::vector<std::string> decode_names(const Bytes& bytes) {
  ByteSource source(bytes);
  std::vector<std::string> names;
  while (!source.at_end()) names.push_back(source.counted<std::string>());
  return names;
}

}  // namespace talus
