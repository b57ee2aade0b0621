#pragma once
/// Maps of a run that are drawn while it computes.

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/errors.h"
#include "pictures/background_tasks.h"
#include "pictures/picture_series.h"
#include "render/renderer.h"

namespace talus::pictures {

/// The plan of maps drawn before the slope has failed: with assumed_theta_c where theta_c is needed and not
/// given, as that of the run comes too late. Throws as plan_maps does.
MapPlan plan_live_maps(const MapOptions& options);

/// Pictures of all frames of a run, in the order in which they come, drawn in a thread beside the run. A
/// frame is drawn as it will be read from the file, so that a resumed run draws the same.
class LiveMaps {
 public:
  using Warn = std::function<void(const std::string&)>;

  /// Makes the folder and the context before anything is computed. A run that is not `resumed` finds no
  /// pictures of its maps there, unless `overwrite`. `warn` is told of the first failure, from the thread
  /// that draws. Throws Error(cannot_create), Error(unavailable).
  LiveMaps(const MapPlan& plan, std::string folder, bool resumed, bool overwrite, Warn warn);
  ~LiveMaps();

  /// The run that is drawn. `path` is its file; `step` its step of tilt, deg, by which names tell frames
  /// apart.
  void begin(const io::RunHeader& header, const std::string& path, double step, bool has_program);

  /// The frames that an earlier process has stored: colours go on from them, and pictures that are missing
  /// are drawn. Throws Error(cannot_create) where a picture of another run or other settings has their name.
  void meet(const io::RunFile& file);

  /// Has a new frame drawn; waits while several are waiting. The first failure ends the drawing, not the run.
  void add(const Frame& frame);

  /// Whether a picture is being drawn now, or waits for it.
  bool drawing() const { return tasks_.busy(); }

  /// Waits for the last picture. Throws the first failure, once the run is safe.
  void finish();

 private:
  void draw_or_fail(Frame frame);
  void draw(Frame frame);
  void fail(ExitCode code, const std::string& message);

  std::string folder_;
  bool overwrite_;
  int decimals_ = 2;  ///< of the angles in names
  Warn warn_;

  // Of the thread that draws; others look at them when it has finished.
  PictureSeries series_;
  std::unique_ptr<render::Renderer> renderer_;
  std::optional<Frame> before_;
  std::optional<Error> failure_;

  BackgroundTasks tasks_;
};

}  // namespace talus::pictures
