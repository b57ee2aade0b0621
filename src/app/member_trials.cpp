#include "app/member_trials.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <string>

#include "app/python_module.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/hash.h"
#include "base/text_stream.h"
#include "base/visible_text.h"
#include "core/trigonometry.h"
#include "session/run_header.h"

namespace talus::app {
namespace {

/// Returns the tilt of a session in deg, rounded to the step.
double tilt_of(const session::Session& session) {
  const double step = session.scenario().tilt.step;
  return static_cast<double>(std::llround(degrees(session.world().tilt) / step)) * step;
}

/// Whether the session is at a tilt of the plan, before failure.
bool is_due(const session::Session& session, const ensemble::TrialsTask& plan) {
  if (session.phase() != session::Phase::tilt || session.angle_of_repose()) return false;
  const auto steps = [&](double angle) { return std::llround(angle / session.scenario().tilt.step); };
  const auto since_first = steps(tilt_of(session)) - steps(plan.first);
  return since_first >= 0 && since_first % std::max(1LL, steps(plan.every)) == 0;
}

/// A copy of the bed as a run that can be resumed, held at its tilt: neither commands, a guard nor a failure
/// ends it. Its file exists as long as the object.
class HeldBed {
 public:
  HeldBed(const session::Session& session, std::string path) : path_(std::move(path)) {
    session::Session held = session.copy();
    held.apply({0, CommandKind::tilt_rate, -1, 0.0});
    if (held.schedule().drag) held.apply({0, CommandKind::release});
    const io::Checkpoint state = held.checkpoint(0.0);
    scenario::Scenario scenario = session.scenario();
    scenario.commands.clear();
    scenario.guards.action = scenario::GuardAction::warn;
    scenario.tilt.program.clear();
    scenario.tilt.after_failure = scenario::AfterFailure::stop;
    scenario.tilt.end_angle = session::steepest_tilt;
    session::RunOrigin origin{scenario::resolved_toml(scenario), "", "", 1};
    origin.branch = io::BranchOrigin{"a program", 0, hash_text(state_hash(held.world())), state, ""};
    const io::RunHeader header = session::run_header(session::Session(scenario, state), origin);
    io::RunStore::create(path_, header, true).commit({}, state);
  }
  ~HeldBed() {
    std::error_code ignored;
    std::filesystem::remove_all(io::run_folder(path_), ignored);
  }
  HeldBed(const HeldBed&) = delete;
  HeldBed& operator=(const HeldBed&) = delete;

 private:
  std::string path_;
};

}  // namespace

void require_trials(const io::RunFile& run, const ensemble::TrialsTask& plan, const std::string& path) {
  const std::string found = find_value(run.header().provenance, trials_fact).value_or("none");
  if (found != ensemble::plan_text(plan))
    throw Error(ExitCode::bad_data,
                fmt::format("{} has the trials '{}', expected '{}'; use another folder, or remove the run",
                            path, visible_word(found, 120), ensemble::plan_text(plan)));
}

std::function<std::vector<TrialRow>(const session::Session&)> member_trials(const ensemble::TrialsTask& plan,
                                                                            const std::string& path) {
  const io::RunFile run = io::RunFile::open(path);
  require_trials(run, plan, path);
  const std::vector<TrialRow> known = run.trials();
  double reached = known.empty() ? -1.0 : at(known.back(), TrialField::tilt);
  return [plan, reached, bed = path + ".trials"](const session::Session& session) mutable {
    const double tilt = tilt_of(session);
    std::vector<TrialRow> rows;
    if (tilt <= reached || !is_due(session, plan)) return rows;  // a tilt may be held, or fall
    reached = tilt;
    const HeldBed held(session, bed);
    std::istringstream numbers =
        text_stream(output_of_python_module("perturb", {"trials", bed, ensemble::patch_text(plan.patch)}));
    std::string bracket;
    std::getline(numbers, bracket);
    print_error("%.3f deg: %s\n", tilt, bracket.c_str());
    TrialRow row{static_cast<double>(session.world().step), tilt};
    constexpr auto first = static_cast<std::size_t>(TrialField::velocity);
    for (std::size_t k = first; numbers >> row[k]; k = k + 1 < row.size() ? k + 1 : first)
      if (k + 1 == row.size()) rows.push_back(row);
    return rows;
  };
}

}  // namespace talus::app
