#pragma once
/// Damage at a named place of a run file.

#include <cstdint>
#include <string>

namespace talus::example {

/// Overwrites the first stored bytes of a data set, or of a row, with 0x55.
void spoil_data_set(const std::string& run, const std::string& path, unsigned row = 0);

/// Recomputes the seal of a file.
void seal_again(const std::string& run);

/// Writes another schema version into a file, and recomputes its seal if it has one.
void set_version(const std::string& run, std::int32_t version);

/// Exchanges the names of two data sets.
void swap_data_sets(const std::string& run, const std::string& one, const std::string& other);

}  // namespace talus::example
