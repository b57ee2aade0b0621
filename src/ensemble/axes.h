#pragma once
/// Keys of a scenario that vary over an ensemble, and their values.

#include <string>
#include <vector>

#include "scenario/scenario.h"

namespace talus::ensemble {

/// The settings of each value of an axis. "tilt.step=0.002,0.0005" gives {tilt.step=0.002} and
/// {tilt.step=0.0005}. Keys joined by colons change together: "tilt.rate:tilt.step=2:0.002,0.5:0.0005" gives
/// {tilt.rate=2, tilt.step=0.002} and {tilt.rate=0.5, tilt.step=0.0005}. A value of TOML is one value, as
/// `--set` takes it: a comma or colon in a string, an array, an inline table or a date does not end it.
/// Throws Error(usage) if the text has another form; keys and values are not looked at.
std::vector<std::vector<std::string>> parse_axis(const std::string& text);

/// "tilt.step" of "tilt.step=0.002".
std::string key_of_setting(const std::string& setting);

/// `settings` without those whose keys the variation sets.
std::vector<std::string> settings_without(std::vector<std::string> settings,
                                          const std::vector<std::string>& variation);

/// "tilt.rate=2,tilt.step=0.002": the values that a scenario has for the keys of a variation. They are not as
/// they were spelled: 1e-6 and 0.000001 are one variation.
std::string variation_name(const std::vector<std::string>& variation, const scenario::Scenario& scenario);

/// The name of a variation as that of a folder: the same where it is short and plain. Otherwise it is cut,
/// has of a path the last part, and ends with a hash of the whole name: "deposition.file=dense.csv~0f3c...".
std::string folder_name(const std::vector<std::string>& variation, const scenario::Scenario& scenario);

}  // namespace talus::ensemble
