#pragma once
/// The options by which a command takes some of the frames of a run.

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/run_file.h"
#include "pictures/frame_choice.h"

namespace talus::app {

struct FrameOptions {
  std::vector<std::string> numbers;  ///< as in frames_listed
  std::vector<std::string> at;       ///< as in frames_at
  std::optional<double> every;       ///< deg; the last frame before failure is added
  bool flow = false;                 ///< also all frames after failure
};

/// --at, in one wording for all commands that take several frames. `note`: what it says more, such as the
/// default.
CLI::Option* add_at_option(CLI::App& command, std::vector<std::string>& at, const std::string& note = "");

/// --frames, --at, --every, of which one can be given, and --flow. `usual`: which frames without these.
void add_frame_options(CLI::App& command, FrameOptions& options, const std::string& usual);

/// Throws Error(bad_data) where --flow is asked for in a run that has none. `path` is that of the run, for
/// messages.
void require_flow(const io::RunFile& run, const std::string& path, const FrameOptions& options);

/// Ascending; all frames of the tilt where nothing is asked for. `theta_c` (rad): that of "repose", NaN where
/// it is not known. Throws as frames_listed and frames_at do, and Error(bad_data) where the run has no
/// frames, or no flow that is asked for.
pictures::FrameChoice chosen_frames(const io::RunFile& run, const std::string& path,
                                    const FrameOptions& options, double theta_c);
/// With the theta_c of the run.
pictures::FrameChoice chosen_frames(const io::RunFile& run, const std::string& path,
                                    const FrameOptions& options);

}  // namespace talus::app
