#pragma once
/// HDF5 files with invalid content: a correct container with damaged data sets.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/random.h"
#include "io/durable_file.h"

namespace talus::hostile {

using Bytes = std::vector<std::byte>;

/// Damage to a data set. It is removed, or recreated as the name says; or it stays, with another value
/// (`bits`, or one of a few critical values) at one index or at all.
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
  std::uint64_t index = 0;                ///< index of the value, modulo their number
  std::uint64_t bits = 0;                 ///< below 32: one of the critical values; else the value itself
  std::string elsewhere = "/etc/passwd";  ///< file to which an external link leads, with the same path
};

/// Returns the paths of all data sets of an HDF5 file in memory.
std::vector<std::string> data_sets(const Bytes& file);

/// Returns one or two random damages to data sets of `paths`; external links lead to `elsewhere`.
std::vector<Spoil> spoils_of_chance(Random& random, std::span<const std::string> paths,
                                    const std::string& elsewhere);

/// Returns the hash of the values of all data sets, as stored.
std::uint64_t values_hash(const Bytes& file);

/// Returns the file with the damage done, sealed again if it has a seal.
Bytes spoilt(const Bytes& file, std::span<const Spoil> spoils);

Bytes read_bytes(const std::string& path);
void write_bytes(const std::string& path, std::span<const std::byte> bytes);

}  // namespace talus::hostile
