#pragma once
/// Maps of a run, drawn while it is computed.

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/errors.h"
#include "pictures/background_tasks.h"
#include "pictures/picture_series.h"
#include "render/renderer.h"

namespace talus::pictures {

/// Returns the plan of maps drawn before the slope has failed. If theta_c is needed and not given, it is
/// assumed_theta_c, because that of the run is not known in time. Throws the errors of plan_maps.
MapPlan plan_live_maps(const MapOptions& options);

/// Draws all frames of a run, in the order in which they are computed, in a separate thread. A frame is drawn
/// as it will be read from the file, so that a resumed run draws the same pictures.
class LiveMaps {
 public:
  using Warn = std::function<void(const std::string&)>;

  /// Creates the folder and the context before anything is computed. If the run is not `resumed`, the folder
  /// must not contain pictures of its maps, unless `overwrite`. `warn` receives the first failure, in the
  /// drawing thread. Throws Error(cannot_create), Error(unavailable).
  LiveMaps(const MapPlan& plan, std::string folder, bool resumed, bool overwrite, Warn warn);
  ~LiveMaps();

  /// Sets the run to be drawn. `path` is its file; `step` is its step of tilt, deg, for the names.
  void begin(const io::RunHeader& header, const std::string& path, double step, bool goes_by_time);

  /// Adds the frames that an earlier process has stored: colours continue, and missing pictures are drawn.
  void add_frames(const io::RunFile& file);

  /// Draws a new frame in the background; blocks while several are waiting. A failure ends the drawing only.
  void add(const Frame& frame);

  /// Whether a picture is being drawn or waiting.
  bool drawing() const { return tasks_.busy(); }

  /// Waits for the last picture. Throws the first failure, when the run is already safe.
  void finish();

 private:
  void draw_or_fail(Frame frame);
  void draw(Frame frame);
  void fail(ExitCode code, const std::string& message);

  std::string folder_;
  bool resumed_;      ///< whether pictures that exist are kept
  int decimals_ = 2;  ///< decimals of the angles in names
  Warn warn_;

  // Owned by the drawing thread; other threads read these when it has finished.
  PictureSeries series_;
  std::unique_ptr<render::Renderer> renderer_;
  std::optional<Frame> before_;
  std::optional<Error> failure_;

  BackgroundTasks tasks_;
};

}  // namespace talus::pictures
