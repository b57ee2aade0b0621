#pragma once
/// The analysis of one frame, stored in its record.

#include <span>
#include <vector>

#include "analysis/overload/clusters.h"
#include "analysis/overload/coarse_graining.h"
#include "analysis/record.h"
#include "core/snapshot.h"
#include "stress/stress.h"

namespace talus::analysis {

/// Returns the frame with the gamma that the analysis uses. If `min_contacts` is above 1, gamma of a free
/// grain with fewer force-carrying contacts is set to NaN, as for a grain that carries nothing; its moment is
/// kept. Each remaining gamma is then replaced by that of the neighbourhood of diameter `l_min` around the
/// grain (with_gamma_of_neighbourhoods).
Frame with_analysed_gamma(Frame frame, const RunStatics& statics, const AnalysisParameters& parameters);

/// Set the members of a record that describe the overloaded grains as a whole, their l_c, and their clusters;
/// the values of single grains are not set.
void measure_overloaded(const stress::OverloadCount& count, const RunStatics& statics,
                        FrameThreshold& record);
void measure_lengths(const CoarseGraining& lengths, FrameThreshold& record);
void measure_clusters(const Clusters& clusters, const BedEdges& edges, FrameThreshold& record);

/// Returns an analysis without frames: its thresholds, the edges of bins and sections, and the directions of
/// paths. `theta_c` is in rad, NaN if the slope has not failed. There are no thresholds if neither theta_c
/// nor gamma_c is known.
Analysis begin_analysis(const RunStatics& statics, const AnalysisParameters& parameters, double theta_c);

/// Returns the records of a frame at each threshold of `analysis`: overloaded grains, their l_c, and their
/// clusters. `bed` and `analysis` are as for analyse_frame; `volume` is that of frame_volume, m^2.
std::vector<FrameThreshold> analyse_thresholds(const BedFrame& bed, const AnalysisParameters& parameters,
                                               const Analysis& analysis, double volume);

/// Returns everything that can be measured in one frame. The frame of `bed` comes from with_analysed_gamma
/// and `analysis` from begin_analysis, both with the same parameters. Quantities taken from the observables
/// of the run, from the persistence diagram (topology.h) or from an earlier frame are left unset.
FrameRecord analyse_frame(const BedFrame& bed, const AnalysisParameters& parameters,
                          const Analysis& analysis);

}  // namespace talus::analysis
