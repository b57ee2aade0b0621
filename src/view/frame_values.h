#pragma once
/// Values per frame that curves, landmarks and cluster colours need: the frame's record, with one threshold.

#include <optional>
#include <vector>

#include "analysis/overload/clusters.h"
#include "analysis/overload/coarse_graining.h"
#include "analysis/record.h"
#include "io/run_file.h"
#include "pictures/cluster_colours.h"

namespace talus::view {

/// Returns how overloaded grains and their l_c are found in frames of mapped_frame under the rule.
analysis::CoarseGrainingRule coarse_graining_rule(const pictures::OverloadRule& rule,
                                                  const RunStatics& statics);

/// Returns the record of a frame of mapped_frame with its clusters: its tilt, and its values at the threshold
/// of the rule, without those of single grains.
analysis::FrameRecord overload_record(const BedFrame& bed, const analysis::Clusters& clusters,
                                      const pictures::OverloadRule& rule);

/// Reads the analysis stored with a run, if it belongs to this run and treats single frames as they are (no
/// averaging, min_contacts 1, l_c up to length_cut). Throws as read_analysis does.
std::optional<analysis::Analysis> read_usable_analysis(const io::RunFile& run);

/// Returns which threshold of the analysis is that of the rule, with the same l_min and joining, and with l_c
/// limited to the same length; nothing if none matches.
std::optional<std::size_t> find_threshold(const analysis::Analysis& analysis,
                                          const pictures::OverloadRule& rule);

/// Returns the same records for all frames of a stored analysis, at its threshold f.
std::vector<analysis::FrameRecord> stored_records(const analysis::Analysis& analysis, std::size_t f);

}  // namespace talus::view
