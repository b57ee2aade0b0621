#pragma once
/// The analysis of one frame: all that is measured of it, into its record.

#include <span>
#include <vector>

#include "analysis/overload/clusters.h"
#include "analysis/overload/links.h"
#include "analysis/overload/percolation.h"
#include "analysis/parameters.h"
#include "analysis/record.h"
#include "core/bed_frame.h"
#include "core/snapshot.h"
#include "stress/overload.h"

namespace talus::analysis {

/// The frame with the gamma by which grains count. With `min_contacts` above 1, gamma of a free grain with
/// fewer force-carrying contacts is NaN, as if it carried nothing; its moment stays. Then gamma is that of
/// the neighbourhood of diameter `l_min` of each grain (with_gamma_of_neighbourhoods).
Frame with_analysed_gamma(Frame frame, const RunStatics& statics, const AnalysisParameters& parameters);

/// The pairs of grains that clusters are made of.
std::vector<Link> links_of(const BedFrame& bed, Joining joining);

/// What a record says of the overloaded grains as a whole, of their l_c, and of their clusters; without the
/// values of single grains.
void take_overloaded(const stress::OverloadCount& count, const RunStatics& statics, FrameThreshold& record);
void take_lengths(const CoarseGraining& lengths, FrameThreshold& record);
void take_clusters(const Clusters& clusters, const BedEdges& edges, FrameThreshold& record);

/// An analysis without frames: its thresholds, edges of bins and sections, and directions. `theta_c` in rad,
/// NaN where the slope has not failed; without it and without gamma_c there are no thresholds.
Analysis begin_analysis(const RunStatics& statics, const AnalysisParameters& parameters, double theta_c);

/// What a frame tells at each threshold of `analysis`: overloaded grains, their l_c and clusters. `frame` and
/// `analysis` as for analyse_frame, `volume` of the bed as of frame_volume, m^2.
std::vector<FrameThreshold> analyse_thresholds(const BedFrame& bed, const AnalysisParameters& parameters,
                                               const Analysis& analysis, double volume);

/// All that a frame tells by itself. `frame` is one of with_analysed_gamma, `analysis` one of begin_analysis,
/// made with the same parameters. What comes from the observables of a run is left open.
FrameRecord analyse_frame(const BedFrame& bed, const AnalysisParameters& parameters,
                          const Analysis& analysis);

}  // namespace talus::analysis
