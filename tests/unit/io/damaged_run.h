#pragma once
/// Damage at a place of a run file that is known by its name.

#include <cstdint>
#include <string>

namespace talus::example {

/// Fills the first stored bytes of a data set with 0x55: of all of it, or of what is stored of a row.
void spoil_data_set(const std::string& run, const std::string& path, unsigned row = 0);

/// Puts the seal of a file right.
void seal_again(const std::string& run);

/// Puts another schema version into a file, and its seal right where it has one.
void set_version(const std::string& run, std::int32_t version);

/// Lets each of two names lead to the data set of the other.
void swap_data_sets(const std::string& run, const std::string& one, const std::string& other);

}  // namespace talus::example
