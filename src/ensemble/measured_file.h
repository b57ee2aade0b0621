#pragma once
/// Measured values as a small text file, so that an analysis that is stored nowhere else is made only once.

#include <optional>
#include <string>
#include <vector>

#include "ensemble/measured_values.h"

namespace talus {

/// CSV: the key in the first line, then a line for each threshold and quantity, in full digits. `thresholds`
/// has the values for each threshold of the analysis.
std::string measured_text(const std::string& analysis_key, const std::vector<MeasuredValues>& thresholds);

/// The values back; nothing where the text has another key, or is not what measured_text writes.
std::optional<std::vector<MeasuredValues>> parse_measured(const std::string& text,
                                                          const std::string& analysis_key);

}  // namespace talus
