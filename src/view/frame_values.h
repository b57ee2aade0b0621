#pragma once
/// What curves, landmarks and cluster colours need of each frame: its record, with one threshold.

#include <optional>
#include <string>
#include <vector>

#include "analysis/overload/clusters.h"
#include "analysis/overload/coarse_graining.h"
#include "analysis/record.h"
#include "io/run_file.h"
#include "pictures/overload_rule.h"

namespace talus {

/// How overloaded grains and their l_c are found in frames of mapped_frame with the rule.
CoarseGrainingRule coarse_graining_rule(const OverloadRule& rule, const RunStatics& statics);

/// The record of a frame of mapped_frame with its clusters: its tilt, and what it has at the threshold of the
/// rule, without the values of single grains.
FrameRecord overload_record(const BedFrame& bed, const Clusters& clusters, const OverloadRule& rule);

/// The analysis in the file of a run, if it has one that is of this run and of single frames as they are (no
/// averaging, min_contacts 1, l_c up to length_cut). Throws as read_analysis does.
std::optional<Analysis> read_usable_analysis(const RunFile& run);

/// Which of its thresholds is that of the rule, with the same l_min and joining, and l_c that ends there;
/// none where none is.
std::optional<std::size_t> find_threshold(const Analysis& analysis, const OverloadRule& rule);

/// The same records of all frames of an analysis, with its threshold f.
std::vector<FrameRecord> stored_records(const Analysis& analysis, std::size_t f);

}  // namespace talus
