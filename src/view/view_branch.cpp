/// A replay that goes on from one of its frames, and a run that goes back before a command.

#include <algorithm>
#include <filesystem>
#include <fmt/core.h>
#include <utility>

#include "core/errors.h"
#include "core/hash.h"
#include "session/frame_state.h"
#include "session/run_header.h"
#include "view/next_output.h"
#include "view/view_data.h"

namespace talus {

/// "slope-branch-1.h5" beside "slope.h5": the first that is not there yet.
std::string branch_output(const std::string& run) {
  const std::filesystem::path path(run);
  for (int k = 1;; ++k) {
    const std::string name = fmt::format("{}-branch-{}.h5", path.stem().string(), k);
    std::string next = (path.parent_path() / name).string();
    if (run_presence(next) == RunPresence::none) return next;
  }
}

void ViewModel::Data::take_all_recorded() {
  first_frame.reset();
  series.reset();
  recorded = std::make_shared<RecordedFrames>();
  recorded->add(live->recorded_frames(0));
  rows = live->observables(0);
  commands = live->commands();
  theta_c = live->status().theta_c;
  plot_rows();
  begin_series();
  find_events();
}

/// The file is read up to here, and no more while the branch is computed.
void ViewModel::Data::start_branch(std::size_t k) {
  end_series();
  const RunFile& run = frames->file();
  BranchOrigin origin;
  Scenario of_run;
  try {
    of_run = stored_scenario(run.header(), pictures.path + ":/parameters");
    origin = {pictures.path, static_cast<std::int64_t>(k), hash_text(state_hash(run.checkpoint().world)),
              checkpoint_at_frame(run, k)};
  } catch (const Error&) {
    begin_series();
    throw;
  }
  branch = std::move(origin);
  scenario = std::move(of_run);
  scenario_text = run.header().scenario_given;
  command_line = fmt::format("talus view {}", pictures.path);
  parent_tilts = run.all_frame_tilts();
  parent_theta_c = theta_c;
  replay.reset();
  frames.reset();
  analysis.reset();
  first_output.clear();
  start_live("", false);
}

void ViewModel::branch() {
  if (is_live()) return;
  const std::string run = path();
  data_->start_branch(frame_index());
  state.run_path = branch_output(run);
  state.announcement.clear();
}

std::optional<BranchLine> ViewModel::branch_line() const {
  if (!data_->branch) return std::nullopt;
  return BranchLine{data_->branch->run, static_cast<std::size_t>(data_->branch->frame), data_->parent_tilts};
}

void ViewModel::back() {
  if (!is_live()) return;
  const std::string next = data_->output.empty() ? "" : next_output(data_->first_output);
  follow();
  data_->end_series();
  try {
    data_->live->back(next);
  } catch (const Error&) {
    data_->begin_series();
    throw;
  }
  data_->output = next;
  data_->ended = false;
  state.announcement.clear();
  data_->newest = data_->live->frame();
  data_->take_all_recorded();
  data_->show(data_->newest);
}

}  // namespace talus
