#include "figures/shown_frames.h"

#include <charconv>
#include <fmt/core.h>

#include "base/errors.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "figures/failed_group.h"
#include "figures/run_means.h"
#include "pictures/frame_choice.h"

namespace talus::figures {
namespace {

ShownFrames named(const std::string& word) {
  if (word == "repose") return {word, "before failure", "in the last frame before failure", {}};
  if (word == "frame0") return {"start", "start of the tilt", "at the start of the tilt", {}};
  if (word.starts_with("frame")) return {word, "frame " + word.substr(5), "in frame " + word.substr(5), {}};
  return {word, fmt::format("{{/:Italic θ}} = {}°", word), fmt::format("at {} deg", word), {}};
}

/// Returns the frames of `word` in the runs that have it.
FramesAtAngle frames_at_word(const RunChoice& runs, const std::string& word) {
  FramesAtAngle found;
  for (const runs::RunView* run : runs) try {
      found.frames.push_back(frames_of_run(*run, {word}).front());
      found.runs.push_back(run);
    } catch (const Error& error) {
      if (error.code() != ExitCode::bad_data) throw;
    }
  if (found.runs.empty())
    throw Error(ExitCode::bad_data,
                fmt::format("--at {}: no run of {} has such a frame", word, runs.front()->path));
  return found;
}

FramesAtAngle usual_frames(const RunChoice& runs, const std::string& word) {
  double angle = 0.0;
  if (std::from_chars(word.data(), word.data() + word.size(), angle).ec == std::errc())
    return frames_at_angle(runs, radians(angle));
  return frames_at_word(runs, word);
}

}  // namespace

std::vector<ShownFrames> shown_frames(const RunChoice& runs, const FrameWords& at, const FrameWords& usual) {
  std::vector<ShownFrames> shown;
  for (const std::string& word : at.empty() ? usual : at) {
    shown.push_back(named(word));
    shown.back().at = at.empty() ? usual_frames(runs, word) : frames_at_word(runs, word);
  }
  return shown;
}

void set_shown_frames(Figure& figure, std::span<const ShownFrames> shown) {
  set_variable(figure, "shown", gnuplot_string(joined(shown, " ", &ShownFrames::name)));
  for (std::size_t k = 0; k < shown.size(); ++k)
    set_variable(figure, fmt::format("said_{}", k + 1), gnuplot_string(shown[k].label));
  figure.caption += fmt::format(" Shown {}.", joined(shown, ", ", &ShownFrames::text));
}

std::vector<std::size_t> frames_of_run(const runs::RunView& run, const FrameWords& at) {
  std::vector<double> tilts;
  for (const analysis::FrameRecord& frame : run.analysis.frames) tilts.push_back(frame.tilt);
  return pictures::frames_at(tilts, at, theta_c_of(run));
}

double mean_tilt(const FramesAtAngle& at) {
  double sum = 0.0;
  for (std::size_t r = 0; r < at.runs.size(); ++r) sum += at.runs[r]->analysis.frames.at(at.frames[r]).tilt;
  return sum / static_cast<double>(at.runs.size());
}

}  // namespace talus::figures
