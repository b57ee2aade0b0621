#pragma once
/// Keys of a scenario that vary over an ensemble, and their values.

#include <string>
#include <vector>

#include "scenario/scenario.h"

namespace talus::ensemble {

/// Returns the settings for each value of an axis. "tilt.step=0.002,0.0005" gives {tilt.step=0.002} and
/// {tilt.step=0.0005}. Keys joined by colons change together: "tilt.rate:tilt.step=2:0.002,0.5:0.0005" gives
/// {tilt.rate=2, tilt.step=0.002} and {tilt.rate=0.5, tilt.step=0.0005}. A TOML value counts as one value, as
/// in `--set`: a comma or colon inside a string, an array, an inline table or a date does not end it. Throws
/// Error(usage) if the text has another form; keys and values are not checked.
std::vector<std::vector<std::string>> parse_axis(const std::string& text);

/// Returns the key of a setting: "tilt.step" for "tilt.step=0.002".
std::string key_of_setting(const std::string& setting);

/// Returns `settings` without those whose keys the variation sets.
std::vector<std::string> settings_without(std::vector<std::string> settings,
                                          const std::vector<std::string>& variation);

/// Returns the values that a scenario has for the keys of a variation: "tilt.rate=2,tilt.step=0.002". The
/// spelling is normalised: 1e-6 and 0.000001 are the same variation.
std::string variation_name(const std::vector<std::string>& variation, const scenario::Scenario& scenario);

/// Returns the folder name of a variation. Short plain names are kept. Other names are cut, keep only the
/// last part of a path, and end with a hash of the full name: "deposition.file=dense.csv~0f3c...".
std::string folder_name(const std::vector<std::string>& variation, const scenario::Scenario& scenario);

}  // namespace talus::ensemble
