#pragma once
/// HDF5 files that say what they should not: the right container, with data sets that are spoilt.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/random.h"
#include "io/seal.h"

namespace talus::hostile {

using Bytes = std::vector<std::byte>;

/// What is done to a data set. It is taken away, or made again with what the name says; or it is left as it
/// is, with another value (`bits`, or one of a few that ask for trouble) at one index or at all.
enum class Harm : std::uint8_t {
  missing,
  group_instead,
  as_float64,
  as_int64,
  as_text,
  as_text_of_variable_length,
  as_compound,
  one_rank_more,
  scalar,
  empty,
  one_row_more,
  huge,
  huge_attribute,
  values_in_another_file,
  external_link,
  one_value,
  all_values,
};
inline constexpr int harm_count = static_cast<int>(Harm::all_values) + 1;
std::string name_of(Harm harm);

struct Spoil {
  std::string path;
  Harm harm = Harm::missing;
  std::uint64_t index = 0;  ///< of the value, modulo how many there are
  std::uint64_t bits = 0;   ///< below 32: one of the values that ask for trouble; else the value itself
  std::string elsewhere = "/etc/passwd";  ///< the file that an external link leads to, to the same path
};

/// Paths of all data sets of an HDF5 file in memory.
std::vector<std::string> data_sets(const Bytes& file);

/// One or two harms to data sets of `paths`; external links lead to `elsewhere`.
std::vector<Spoil> spoils_of_chance(Random& random, std::span<const std::string> paths,
                                    const std::string& elsewhere);

/// The hash of the values of all data sets, as they are stored.
std::uint64_t values_hash(const Bytes& file);

/// The file with harm done; with its seal made right again where it has one.
Bytes spoilt(const Bytes& file, std::span<const Spoil> spoils);

/// The bytes with a seal over them.
Bytes sealed(Bytes file, std::string_view kind = io::run_seal);

Bytes read_bytes(const std::string& path);
void write_bytes(const std::string& path, std::span<const std::byte> bytes);

}  // namespace talus::hostile
