#pragma once
/// Options that select frames of a run.

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/run_file.h"
#include "pictures/frame_choice.h"

namespace talus::app {

struct FrameOptions {
  std::vector<std::string> at;  ///< syntax of frames_at
  std::optional<double> every;  ///< deg; the last frame before failure is added
  bool flow = false;            ///< adds all frames after failure
};

/// Adds --at of commands that take several frames. `note`: additional text, such as the default.
CLI::Option* add_at_option(CLI::App& command, std::vector<std::string>& at, const std::string& note = "");

/// Adds --at and --every, which exclude each other, and --flow. `usual`: the frames selected without them.
void add_frame_options(CLI::App& command, FrameOptions& options, const std::string& usual);

/// Throws Error(bad_data) if --flow is given for a run without a flow. `path`: name of the run, for messages.
void require_flow(const io::RunFile& run, const std::string& path, const FrameOptions& options);

/// Returns the selected frames in ascending order; all frames of the tilt without a selection. "repose" is
/// the angle of repose of the run. Throws as frames_at does, and Error(bad_data) if the run has no frames, or
/// no flow although --flow is given.
pictures::FrameChoice chosen_frames(const io::RunFile& run, const std::string& path,
                                    const FrameOptions& options);

}  // namespace talus::app
