#pragma once
/// The pictures of a run: their common properties, and data from preceding frames that each of them needs.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/types.h"
#include "io/run_file.h"
#include "pictures/cluster_colours.h"
#include "pictures/map_plan.h"

namespace talus::pictures {

/// The data of a trace.
struct TraceCurve {
  /// rad, or s since the first frame if the run goes by time; values in the unit of the observables
  std::vector<double> places, values;
};

/// The value that, together with the frames, determines all pictures of a run.
struct PictureSeries {
  std::string path;  ///< path of the run
  io::RunHeader run;
  bool goes_by_time = false;  ///< frames are identified by number and time (RunFile::goes_by_time)
  MapPlan plan;      ///< plan with theta_c set: NaN only if it is unknown, and no map or trace needs it
  MapExtent extent;  ///< part of the bed shown, the same in all pictures
  std::optional<std::size_t> since;  ///< frame from which displacements are measured; none: the preceding one
  SeenFrames seen_frames;
  std::vector<TraceCurve> curves;  ///< one for each trace of the plan
};

/// Sets theta_c of maps for which the user has not given it: that of the run (rad); if it is NaN, because the
/// slope has not failed, assumed_theta_c if a map or trace needs one.
void settle_theta_c(MapPlan& plan, double theta_c);

/// Returns a frame as the maps of the plan see it (mapped_frame, if one of them depends on gamma).
Frame as_mapped(const PictureSeries& series, Frame frame);

/// Adds the next frame of the run, as its maps see it. Does not change the extent and the curves.
void add_frame(PictureSeries& series, const Frame& mapped);
/// Adds a frame whose overloaded_clusters are known, if a map shows them.
void add_frame(PictureSeries& series, const Frame& mapped, const analysis::Clusters& clusters);

/// Returns the frame from which motion up to frame k is measured; none if no map shows motion, or at first.
std::optional<std::size_t> reference_of(const PictureSeries& series, std::size_t k);

/// Returns map `map` of the plan at frame k, with its traces. `frame` is as its maps see it; if it was not
/// added, its clusters are coloured as if it followed the last frame that was. `reference` is the frame from
/// which displacements are measured, null if nothing has moved yet.
render::FrameView picture(const PictureSeries& series, std::size_t k, const Frame& frame,
                          const Frame* reference, std::size_t map);

/// A run file being drawn: its series, and the frames that were read last.
struct DrawnRun {
  io::RunFile file;
  PictureSeries series;
  std::optional<std::size_t> current, before;  ///< indices of the frames in memory
  Frame frame, reference;

  /// Returns the angle of repose of the run, rad; NaN if the slope has not failed.
  double theta_c() const { return find_value(file.checkpoint().results, "theta_c").value_or(not_known); }
};

/// Opens a run and passes once through all of its frames, including those of the flow after failure, so that
/// all pictures have one size, and the colour of a cluster does not depend on the selected frames. Throws
/// Error(missing_input); Error(bad_data) if the run has no frames, or --since lies beyond the frames; and
/// Error(usage) if --crop leaves the bed.
DrawnRun open_drawn_run(const std::string& path, const MapPlan& plan, const CountDone& progress);

/// Fits pictures to these frames: the ranges of maps of motion (fits_frames), and the room for the turn of a
/// bed. Without it the ranges are fixed, and there is room for the turns of all frames.
void fit_to_frames(DrawnRun& run, std::span<const std::size_t> frames);

/// Returns map `map` of the plan at frame k. Fastest for ascending frames, one after another.
render::FrameView picture(DrawnRun& run, std::size_t k, std::size_t map);

}  // namespace talus::pictures
