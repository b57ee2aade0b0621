#include "app/ghost_runs.h"

#include <filesystem>
#include <fmt/core.h>

#include "app/figure_runs.h"
#include "app/progress.h"
#include "base/errors.h"
#include "ensemble/averages_reader.h"
#include "io/run_file.h"
#include "session/run_identity.h"
#include "view/frame_values.h"

namespace talus::app {
namespace {

namespace fs = std::filesystem;

/// Throws if a run has no analysis; an ensemble always has the values of one.
void refuse_unanalysed(const std::string& path) {
  if (io::run_presence(path) == io::RunPresence::none || ensemble::holds_averages(path)) return;
  if (view::read_usable_analysis(io::RunFile::open(path))) return;
  throw Error(ExitCode::bad_data, fmt::format("{} has no stored analysis, which is needed for curves behind "
                                              "others; make one first: talus analyze {}",
                                              path, path));
}

view::GhostRun ghost_of(const runs::RunView& run) {
  view::GhostRun ghost;
  const analysis::FramesOfRise rise = runs::last_rise_of(run);
  for (const analysis::FrameRecord* frame : rise.frames) ghost.frames.push_back(*frame);
  for (std::size_t k = 0; run.file && k < rise.frames.size(); ++k)
    ghost.times.push_back(run.file->all_frame_times()[rise.first + k]);
  for (const analysis::RunThreshold& threshold : run.analysis.thresholds)
    ghost.factors.push_back(threshold.factor);
  ghost.theta_c = run.analysis.theta_c;
  ghost.mean_diameter = run.statics.mean_diameter;
  // Values of single grains need much memory, and no curve shows them.
  for (analysis::FrameRecord& frame : ghost.frames)
    for (analysis::FrameThreshold& at : frame.thresholds) {
      at.lc = {};
      at.cluster = {};
    }
  return ghost;
}

/// Throws if something was done to one of the runs that was not done to the others, which have no mean then.
void refuse_other_departures(const std::vector<runs::RunView>& runs) {
  const auto departures = [](const runs::RunView& run) {
    return run.file ? session::departures(*run.file, run.scenario) : std::vector<std::string>();
  };
  for (const runs::RunView& run : runs)
    if (const auto here = departures(run), first = departures(runs.front()); here != first)
      throw Error(
          ExitCode::bad_data,
          fmt::format("{} and {} are not runs of one kind: {} was done to only one of them; give one, or "
                      "runs of one ensemble",
                      runs.front().path, run.path, session::departures_text(here.empty() ? first : here)));
}

std::string name_of(const std::string& path) {
  const fs::path given = fs::path(path).lexically_normal();
  const std::string last = given.filename().string();
  if (last == "ensemble.h5" && given.has_parent_path()) return given.parent_path().filename().string();
  return last.empty() ? given.parent_path().filename().string() : last;
}

}  // namespace

view::Ghost read_ghost(const std::vector<std::string>& paths, MissingAnalysis missing) {
  if (missing == MissingAnalysis::refused)
    for (const std::string& path : paths) refuse_unanalysed(path);
  view::Ghost ghost;
  const std::vector<runs::RunView> runs =
      read_figure_input(paths, {}, {.progress = count_shown("analysis", false)}).runs;
  refuse_other_departures(runs);
  for (const runs::RunView& run : runs) ghost.runs.push_back(ghost_of(run));
  ghost.name = name_of(paths.front());
  if (paths.size() > 1) ghost.name += fmt::format(" and {} more", paths.size() - 1);
  return ghost;
}

}  // namespace talus::app
