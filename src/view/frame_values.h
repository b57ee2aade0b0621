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

namespace talus::view {

/// How overloaded grains and their l_c are found in frames of mapped_frame with the rule.
analysis::CoarseGrainingRule coarse_graining_rule(const pictures::OverloadRule& rule,
                                                  const RunStatics& statics);

/// The record of a frame of mapped_frame with its clusters: its tilt, and what it has at the threshold of the
/// rule, without the values of single grains.
analysis::FrameRecord overload_record(const BedFrame& bed, const analysis::Clusters& clusters,
                                      const pictures::OverloadRule& rule);

/// The analysis in the file of a run, if it has one that is of this run and of single frames as they are (no
/// averaging, min_contacts 1, l_c up to length_cut). Throws as read_analysis does.
std::optional<analysis::Analysis> read_usable_analysis(const io::RunFile& run);

/// Which of its thresholds is that of the rule, with the same l_min and joining, and l_c that ends there;
/// none where none is.
std::optional<std::size_t> find_threshold(const analysis::Analysis& analysis,
                                          const pictures::OverloadRule& rule);

/// The same records of all frames of an analysis, with its threshold f.
std::vector<analysis::FrameRecord> stored_records(const analysis::Analysis& analysis, std::size_t f);

}  // namespace talus::view
