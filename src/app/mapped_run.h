#pragma once
/// A run that is drawn: its frames one at a time, with what their maps need beside them.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/map_options.h"
#include "io/run_file.h"
#include "maps/cluster_colours.h"

namespace talus {

/// When a frame was, without its grains.
struct FrameInstant {
  std::int64_t step = 0;
  double time = 0.0;  ///< s
  double tilt = 0.0;  ///< rad
};

class MappedRun {
 public:
  /// Opens a run and goes once through all of its frames, so that all pictures of them have one size, and a
  /// cluster has its colour whichever of them are drawn. `progress`, called with the frames read and their
  /// number, may be empty. Throws Error(missing_input), or Error(bad_data) where the run has no frames,
  /// theta_c is needed and not known, or --crop or --since lies outside.
  MappedRun(const std::string& path, const MapPlan& plan,
            const std::function<void(std::size_t, std::size_t)>& progress);

  const std::string& path() const { return path_; }
  const RunFile& file() const { return file_; }
  const MapPlan& plan() const { return plan_; }
  double theta_c() const { return plan_.maps[0].theta_c; }  ///< rad; NaN where it is not known
  const MapExtent& extent() const { return extent_; }
  /// Of all frames, those of a flow after failure included; the first file().frame_count() of them are the
  /// tilt.
  const std::vector<FrameInstant>& instants() const { return instants_; }

  /// Of the maps `displacement` and `rotation`: the ranges that fit what is drawn, of all these frames.
  /// Before the first view or key; without, the ranges are fixed.
  void fit_motion(std::span<const std::size_t> frames);

  /// Map `map` of the plan at frame k, with its traces. Frames are fastest in ascending order, all maps of
  /// one after another.
  FrameView view(std::size_t k, std::size_t map);

  /// A hash of all that the picture `view(k, map)` depends on.
  std::string key(std::size_t k, std::size_t map) const;

  /// What was asked for, before theta_c of the run was known.
  const MapPlan& asked() const { return asked_; }

 private:
  struct Series {
    std::vector<double> tilts, values;
  };
  void take_theta_c();
  void take_crop();
  void take_reference();
  void meet_frames(const std::function<void(std::size_t, std::size_t)>& progress);
  void read_observables();
  void load(std::size_t k);
  Frame as_mapped(Frame frame) const;
  const Frame* reference() const;

  std::string path_;
  RunFile file_;
  MapPlan asked_, plan_;
  MapExtent extent_;
  std::vector<FrameInstant> instants_;
  std::vector<std::vector<ClusterColour>> cluster_colours_;  ///< of each frame; empty where not drawn
  std::vector<Series> series_;                               ///< of each trace
  std::optional<std::size_t> since_;                         ///< frame that displacements are measured from
  std::optional<std::size_t> current_, before_;              ///< frames in memory
  Frame frame_, reference_;
};

/// The same with progress on stderr, unless `quiet`.
MappedRun open_mapped_run(const std::string& path, const MapPlan& plan, bool quiet);

}  // namespace talus
