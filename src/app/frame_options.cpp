#include "app/frame_options.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numeric>

#include "app/options.h"
#include "base/errors.h"

namespace talus::app {
namespace {

pictures::FrameChoice frames_of_tilt(const io::RunFile& run, const FrameOptions& options, double theta_c) {
  const std::vector<double>& tilts = run.frame_tilts();
  if (!options.at.empty())
    return pictures::frames_at(tilts, options.at, theta_c, run.all_frame_tilts().size());
  pictures::FrameChoice choice;
  if (options.every) {
    choice = pictures::frames_every(tilts, *options.every);
    if (std::isfinite(theta_c))
      choice.push_back(pictures::frame_at_repose(tilts, theta_c));
    else if (!tilts.empty())
      choice.push_back(tilts.size() - 1);
    return choice;
  }
  choice.resize(tilts.size());
  std::iota(choice.begin(), choice.end(), std::size_t{0});
  return choice;
}

}  // namespace

CLI::Option* add_at_option(CLI::App& command, std::vector<std::string>& at, const std::string& note) {
  return add_option(command, "--at", at, "DEG,...",
                    "Frames by angle in degrees, repose for the last frame before failure, and frame42 or "
                    "frame0-frame10 by number, separated by commas: --at 0,5,10,15,repose" +
                        note)
      ->delimiter(',')
      ->allow_extra_args(false);
}

void add_frame_options(CLI::App& command, FrameOptions& options, const std::string& usual) {
  CLI::Option* const at = add_at_option(command, options.at, fmt::format(" [{}]", usual));
  add_option(command, "--every", options.every, "DEG",
             "Degrees between frames; the last frame before failure is added")
      ->check(in_range(1e-6, 90.0))
      ->excludes(at);
  command.add_flag("--flow", options.flow,
                   "Include all frames of the flow after failure, if the run has followed it");
}

void require_flow(const io::RunFile& run, const std::string& path, const FrameOptions& options) {
  if (options.flow && run.all_frame_tilts().size() == run.frame_count())
    throw Error(ExitCode::bad_data, path +
                                        ": --flow: the flow after failure was not followed in this run; set "
                                        "tilt.after_failure = \"lower\" or \"hold\" to follow it");
}

pictures::FrameChoice chosen_frames(const io::RunFile& run, const std::string& path,
                                    const FrameOptions& options) {
  const std::size_t count = run.all_frame_tilts().size();
  if (count == 0)
    throw Error(ExitCode::bad_data, path + " has no frames yet; the first one shows the bed at rest");
  require_flow(run, path, options);
  const double theta_c = find_value(run.checkpoint().results, "theta_c").value_or(not_known);
  pictures::FrameChoice choice = frames_of_tilt(run, options, theta_c);
  for (std::size_t k = run.frame_count(); options.flow && k < count; ++k) choice.push_back(k);
  std::ranges::sort(choice);
  choice.erase(std::unique(choice.begin(), choice.end()), choice.end());
  return choice;
}

}  // namespace talus::app
