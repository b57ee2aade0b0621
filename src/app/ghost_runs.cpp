#include "app/ghost_runs.h"

#include <filesystem>
#include <fmt/core.h>

#include "app/given_runs.h"
#include "app/output_files.h"
#include "app/progress.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/paths.h"
#include "ensemble/averages_reader.h"
#include "ensemble/ensemble_manifest.h"
#include "ensemble/member_reader.h"
#include "io/run_file.h"
#include "runs/run_view.h"
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

/// Reads a run, the finished members of an ensemble, or the values in an ensemble.h5; a run without a valid
/// analysis is analysed.
void add_runs(const std::string& path, std::vector<runs::RunView>& runs) {
  const runs::AnalysisOptions options{.progress = count_shown("analysis", false)};
  const auto add = [&](const std::string& run) {
    runs.push_back(runs::analysed_run(run, {}, options));
    if (!runs.back().is_kept) print_error("talus: note: %s: %s\n", run.c_str(), runs.back().kept.c_str());
  };
  const std::string averages = (fs::path(path) / "ensemble.h5").string();
  if (ensemble::is_ensemble(path)) {
    for (const ensemble::Member& member : done_members(path)) {
      add(member.path);
      ensemble::require_own_run(member, *runs.back().file);
    }
  } else if (const bool is_file = ensemble::holds_averages(path); is_file || is_there(averages)) {
    const std::string& file = is_file ? path : averages;
    for (const ensemble::StoredVariant& variant : ensemble::read_averages(file))
      for (std::size_t m = 0; m < variant.seeds.size(); ++m)
        runs.push_back(ensemble::view_of_values(file, variant, m));
  } else {
    add(path);
  }
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
  std::vector<runs::RunView> runs;
  for (const std::string& path : runs_among(paths, ensemble::holds_averages)) add_runs(path, runs);
  refuse_other_departures(runs);
  for (const runs::RunView& run : runs) ghost.runs.push_back(ghost_of(run));
  ghost.name = name_of(paths.front());
  if (paths.size() > 1) ghost.name += fmt::format(" and {} more", paths.size() - 1);
  return ghost;
}

}  // namespace talus::app
