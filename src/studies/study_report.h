#pragma once
/// The result of a study as text.

#include <string>

#include "studies/study.h"

namespace talus::studies {

/// One row for each complete run: variation, seed, every quantity of study_fields in full digits (empty if
/// the run has none), state hash, version.
std::string study_csv(const StudyResult& result);

/// Tables of all variations in Markdown: means, their standard errors, differences from the baseline.
std::string study_markdown(const StudyResult& result);

}  // namespace talus::studies
