/// Arrays on their way from a child process: records of a kind, a path, a count and the values.

#include <cstdint>

#include "core/errors.h"
#include "io/byte_code.h"
#include "io/foreign_file.h"

namespace talus {
namespace {

using Bytes = std::vector<std::byte>;

enum class MemberKind : std::uint64_t { group, reals, integers };

void append_name(Bytes& bytes, MemberKind kind, const std::string& path) {
  append_number(bytes, static_cast<std::uint64_t>(kind));
  append_counted(bytes, path);
}

}  // namespace

Bytes encode(const ForeignFile& file) {
  Bytes bytes;
  for (const std::string& group : file.groups) append_name(bytes, MemberKind::group, group);
  for (const auto& [path, values] : file.reals) {
    append_name(bytes, MemberKind::reals, path);
    append_counted(bytes, values);
  }
  for (const auto& [path, values] : file.integers) {
    append_name(bytes, MemberKind::integers, path);
    append_counted(bytes, values);
  }
  return bytes;
}

ForeignFile decode(std::span<const std::byte> bytes, const std::string& path) {
  ByteSource source(bytes);
  ForeignFile file;
  bool makes_sense = true;
  while (makes_sense && !source.at_end()) {
    const auto kind = static_cast<MemberKind>(source.number());
    const auto name = source.counted<std::string>();
    if (kind == MemberKind::group)
      file.groups.insert(name);
    else if (kind == MemberKind::reals)
      file.reals[name] = source.counted<std::vector<double>>();
    else if (kind == MemberKind::integers)
      file.integers[name] = source.counted<std::vector<Index>>();
    else
      makes_sense = false;
  }
  if (!makes_sense || !source.succeeded())
    throw Error(ExitCode::bad_data, path + ": cannot be read: HDF5 reads nonsense from it");
  return file;
}

}  // namespace talus
