#pragma once
/// The pictures of a run: what all of them have in common, and what each needs of the frames before it.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/watch.h"
#include "io/run_file.h"
#include "pictures/cluster_colours.h"
#include "pictures/map_plan.h"

namespace talus::pictures {

/// When a frame was, without its grains.
struct FrameInstant {
  std::int64_t step = 0;
  double time = 0.0;  ///< s
  double tilt = 0.0;  ///< rad
};

/// What a trace shows.
struct TraceCurve {
  /// rad, or with a programme of the tilt s since the first frame; in the unit of the observables
  std::vector<double> places, values;
};

/// What is known of the frames of a run that were met, in their order.
struct MetFrames {
  std::vector<FrameInstant> instants;
  std::size_t highest = 0;  ///< the last frame of the tilt; those after it are of the flow
  OverloadRule rule;        ///< by which their clusters were told apart
  std::vector<std::vector<ClusterColour>> cluster_colours;  ///< empty where no map shows them
  ClusterColours tracker;
  std::vector<Vec2> begin;  ///< where the grains of the first one were, m
};

/// One value from which all pictures of a run follow, together with the frames themselves.
struct PictureSeries {
  std::string path;  ///< of the run
  io::RunHeader run;
  bool has_program = false;  ///< the tilt goes up and down: frames are told apart by number and time
  MapPlan asked;             ///< before theta_c of the run was known
  MapPlan plan;      ///< its theta_c is settled: NaN only where neither the run nor the user has said one
  MapExtent extent;  ///< what pictures show of the bed: all have one size
  std::optional<std::size_t> since;  ///< frame that displacements are measured from; none: the one before
  MetFrames met;
  std::vector<TraceCurve> curves;  ///< of each trace of the plan
};

/// A frame as the maps of the plan see it (mapped_frame, where one of them goes by gamma).
Frame as_mapped(const PictureSeries& series, Frame frame);

/// The next frame of the run, as its maps see it. Leaves the extent and the curves as they are.
void meet(PictureSeries& series, const Frame& mapped);
/// The same of a frame whose overloaded_clusters are known, where a map shows them.
void meet(PictureSeries& series, const Frame& mapped, const analysis::Clusters& clusters);

/// The frame that motion up to frame k is measured from; none where no map shows any, or nothing has moved
/// yet.
std::optional<std::size_t> reference_of(const PictureSeries& series, std::size_t k);

/// Map `map` of the plan at frame k, with its traces. `frame` is as its maps see it; where it was not met,
/// its clusters are coloured as if it followed the last that was. `reference`: where displacements are
/// measured from, null where nothing has moved yet.
render::FrameView picture(const PictureSeries& series, std::size_t k, const Frame& frame,
                          const Frame* reference, std::size_t map);

/// A run file that is drawn: its series, and the frames that were read last.
struct DrawnRun {
  io::RunFile file;
  PictureSeries series;
  std::optional<std::size_t> current, before;  ///< which frames are in memory
  Frame frame, reference;

  /// rad; NaN where it is not known.
  double theta_c() const { return series.plan.maps[0].theta_c; }
};

/// Opens a run and goes once through all of its frames, those of a flow after failure included, so that all
/// pictures of them have one size, and a cluster has its colour whichever of them are drawn. Throws
/// Error(missing_input), or Error(bad_data) where the run has no frames, theta_c is needed and not known, or
/// --since lies beyond them, Error(usage) where --crop leaves the bed.
DrawnRun open_drawn_run(const std::string& path, const MapPlan& plan, const CountDone& progress);

/// Makes pictures fit all these frames: the ranges of maps of motion (fits_frames), and the room for the turn
/// of a bed. Call it before the first picture or key; without, the ranges are fixed, and there is room for
/// the turns of all frames.
void fit_to_frames(DrawnRun& run, std::span<const std::size_t> frames);

/// Map `map` of the plan at frame k. Frames are fastest in ascending order, all maps of one after another.
render::FrameView picture(DrawnRun& run, std::size_t k, std::size_t map);

}  // namespace talus::pictures
