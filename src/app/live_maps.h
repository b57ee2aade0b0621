#pragma once
/// Maps of a run that are drawn while it computes.

#include <memory>
#include <optional>
#include <string>

#include "app/background_tasks.h"
#include "app/map_options.h"
#include "app/mapped_run.h"
#include "core/errors.h"
#include "io/run_file.h"
#include "maps/cluster_colours.h"
#include "render/renderer.h"

namespace talus {

/// Where theta_c is not given: it is known when the slope has failed, which is too late. Degrees.
inline constexpr double assumed_theta_c = 20.0;

/// The settings of maps drawn before the slope has failed: with assumed_theta_c where theta_c is needed and
/// not given.
MapPlan plan_live_maps(const MapOptions& options);

/// Pictures of all frames of a run, in the order in which they come, drawn in a thread beside the run. A
/// frame is drawn as it will be read from the file, so that a resumed run draws the same.
class LiveMaps {
 public:
  /// Makes the folder and the context before anything is computed. A run that is not `resumed` finds no
  /// pictures of its maps there, unless `overwrite`. Throws Error(cannot_create), Error(unavailable).
  LiveMaps(MapPlan plan, std::string folder, bool resumed, bool overwrite);
  ~LiveMaps();

  /// The run that is drawn. `path` is its file; `step` its step of tilt, deg, by which names tell frames
  /// apart.
  void begin(const RunHeader& header, const std::string& path, double step);

  /// The frames that an earlier process has stored: colours go on from them, and pictures that are missing
  /// are drawn. Throws Error(cannot_create) where a picture of another run or other settings has their name.
  void meet(const RunFile& file);

  /// Has a new frame drawn; waits while several are waiting. The first failure is said on stderr and ends the
  /// drawing, not the run.
  void add(const Frame& frame);

  /// Waits for the last picture. Throws the first failure, once the run is safe.
  void finish();

 private:
  void draw_or_fail(Frame frame);
  void draw(Frame frame);
  void fail(ExitCode code, const std::string& message);
  std::string name_of(const Frame& frame, const MapLayers& layers) const;
  std::string key_of(const Frame& frame, const MapSettings& settings) const;

  MapPlan plan_;
  std::string folder_;
  bool overwrite_;
  RunHeader header_;
  std::string path_;
  int decimals_ = 2;  ///< of the angles in names

  // Of the thread that draws; others look at them when it has finished.
  std::unique_ptr<Renderer> renderer_;
  std::optional<MapExtent> extent_;
  std::optional<Frame> before_;
  FrameInstant highest_;  ///< the last frame of the tilt
  ClusterColours colours_;
  std::optional<Error> failure_;

  BackgroundTasks tasks_;
};

}  // namespace talus
