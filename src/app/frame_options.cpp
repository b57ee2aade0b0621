#include "app/frame_options.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numeric>

#include "app/choices.h"
#include "base/errors.h"

namespace talus::app {
namespace {

pictures::FrameChoice frames_of_tilt(const io::RunFile& run, const std::string& path,
                                     const FrameOptions& options, double theta_c) {
  const std::vector<double>& tilts = run.frame_tilts();
  if (!options.numbers.empty()) return pictures::frames_listed(options.numbers, run.all_frame_tilts().size());
  if (std::ranges::count(options.at, "repose") > 0 && !std::isfinite(theta_c))
    throw Error(
        ExitCode::bad_data,
        path +
            ": the slope has not failed, so --at repose is undefined; give an angle, or frame42 by number");
  if (!options.at.empty()) return pictures::frames_at(tilts, options.at, theta_c);
  pictures::FrameChoice choice;
  if (options.every) {
    choice = pictures::frames_every(tilts, *options.every);
    if (std::isfinite(theta_c)) choice.push_back(pictures::frame_at_repose(tilts, theta_c));
    return choice;
  }
  choice.resize(tilts.size());
  std::iota(choice.begin(), choice.end(), std::size_t{0});
  return choice;
}

}  // namespace

CLI::Option* add_at_option(CLI::App& command, std::vector<std::string>& at, const std::string& note) {
  return command
      .add_option("--at", at,
                  "Frames by angle in degrees, repose for the last frame before failure, and frame42 by "
                  "number, separated by commas: --at 0,5,10,15,repose" +
                      note)
      ->delimiter(',')
      ->allow_extra_args(false);
}

void add_frame_options(CLI::App& command, FrameOptions& options, const std::string& usual) {
  CLI::Option* const numbers =
      command
          .add_option("--frames", options.numbers,
                      fmt::format("Frames by number, counted from 0: --frames 0-10,20 [{}]", usual))
          ->delimiter(',')
          ->allow_extra_args(false);
  CLI::Option* const at = add_at_option(command, options.at)->excludes(numbers);
  command
      .add_option("--every", options.every, "Degrees between frames; the last frame before failure is added")
      ->check(in_range(1e-6, 90.0))
      ->excludes(numbers)
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
                                    const FrameOptions& options, double theta_c) {
  const std::size_t count = run.all_frame_tilts().size();
  if (count == 0)
    throw Error(ExitCode::bad_data, path + " has no frames yet; the first one shows the bed at rest");
  require_flow(run, path, options);
  pictures::FrameChoice choice = frames_of_tilt(run, path, options, theta_c);
  for (std::size_t k = run.frame_count(); options.flow && k < count; ++k) choice.push_back(k);
  std::ranges::sort(choice);
  choice.erase(std::unique(choice.begin(), choice.end()), choice.end());
  return choice;
}

pictures::FrameChoice chosen_frames(const io::RunFile& run, const std::string& path,
                                    const FrameOptions& options) {
  return chosen_frames(run, path, options,
                       find_value(run.checkpoint().results, "theta_c").value_or(not_known));
}

}  // namespace talus::app
