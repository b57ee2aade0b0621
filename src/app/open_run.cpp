#include "app/open_run.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "app/frame_options.h"
#include "app/run_files.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/hash.h"
#include "base/output_file.h"
#include "base/text.h"
#include "base/version.h"
#include "core/trigonometry.h"
#include "scenario/scripted_command.h"
#include "session/estimate.h"
#include "session/frame_state.h"
#include "session/run.h"
#include "session/run_header.h"

namespace talus::app {

namespace {

/// Returns the scenario of a branch, and its text in `text`.
scenario::Scenario scenario_of_branch(const RunRequest& request, const io::RunHeader& parent,
                                      std::string& text) {
  if (!request.scenario.empty()) return scenario::read_scenario(request.scenario, request.settings, &text);
  text = parent.scenario_given;
  return scenario::parse_scenario(parent.scenario_resolved, request.branch + ":/parameters",
                                  request.settings);
}

/// Throws if the scenario of the branch implies another past than that of its parent run.
void require_same_past(const RunRequest& request, const scenario::Scenario& parent,
                       const scenario::Scenario& branch, const session::Schedule& start) {
  scenario::Scenario past = branch;
  // The branch states them only if its other friction does not imply them.
  if (deposition_friction(past) == deposition_friction(parent)) {
    past.deposition.friction = parent.deposition.friction;
    past.deposition.wall_friction = parent.deposition.wall_friction;
  }
  past.contact = parent.contact;
  past.solver = parent.solver;
  past.output = parent.output;
  past.guards = parent.guards;
  past.tilt.end_angle = parent.tilt.end_angle;
  past.tilt.after_failure = parent.tilt.after_failure;
  past.tilt.lowering_rate = parent.tilt.lowering_rate;
  past.commands = parent.commands;
  const std::string differences = scenario::differences(parent, past);
  if (!differences.empty())
    throw Error(ExitCode::bad_data,
                "a branch of {} shares its past: expected the same bed, deposition and course of the tilt, "
                "but {}; use a command of the kind tilt_rate to change the tilt from there on",
                request.branch, differences);
  for (std::size_t k = 0; k < parent.commands.size(); ++k)
    if (session::is_reached(parent.commands[k], parent, start.script) &&
        std::ranges::find(branch.commands, parent.commands[k]) == branch.commands.end())
      throw Error(ExitCode::bad_data,
                  "{} of {} was carried out before the branch begins; expected it in the branch as well",
                  scenario::command_section(k), request.branch);
  for (std::size_t k = 0; k < branch.commands.size(); ++k) {
    const scenario::ScriptedCommand& command = branch.commands[k];
    if (session::is_reached(command, branch, start.script) &&
        std::ranges::find(parent.commands, command) == parent.commands.end())
      throw Error(ExitCode::bad_data, "{} is due {}, before the branch of {} begins; expected a later one",
                  scenario::command_section(k), scenario::moment_text(command), request.branch);
  }
}

/// Whether one of the settings of --set gives this key.
bool sets(const std::vector<std::string>& settings, std::string_view key) {
  return std::ranges::any_of(settings, [key](const std::string& setting) {
    std::string name = setting.substr(0, setting.find('='));
    std::erase(name, ' ');
    return name == key;
  });
}

/// Whether the scenario has a command for the friction that was carried out before a branch begins.
bool scripts_friction(const scenario::Scenario& scenario, const session::Schedule& start) {
  return std::ranges::any_of(scenario.commands, [&](const scenario::ScriptedCommand& command) {
    return command.kind == CommandKind::friction && session::is_reached(command, scenario, start.script);
  });
}

/// Settles the friction of a branch of a run in which a command has set it: what the user gives for the
/// branch is in force from its frame on, and without that the friction of the command becomes that of its
/// scenario. Throws if a scenario file does not say which of them is meant.
void settle_friction(const RunRequest& request, const scenario::Scenario& parent, session::Session& session,
                     io::Checkpoint& start, std::string& text) {
  const std::optional<double> commanded = session.schedule().friction;
  if (!commanded) return;
  const double given = session.scenario().contact.friction;
  if (sets(request.settings, "contact.friction") || given != parent.contact.friction) {
    std::erase_if(start.reals, [](const auto& real) { return real.first == "friction"; });
    scenario::Scenario scenario = session.scenario();
    if (const auto deposited = session.schedule().deposition_friction)
      scenario.deposition.friction = deposited;
    session = session::Session(scenario, start, request.branch, "/branch");
    return;
  }
  if (!request.scenario.empty() && !scripts_friction(session.scenario(), session.schedule()))
    throw Error(ExitCode::bad_data,
                "a command has set the friction of {} to {:g} before this frame, and {} has contact.friction "
                "= {:g}; say which holds in the branch with --set contact.friction=VALUE",
                request.branch, *commanded, request.scenario, given);
  session.adopt_friction();
  start = session::start_of(session.checkpoint(0.0));
  text = scenario::resolved_toml(session.scenario());
}

/// Returns what was done to the run before frame k, and how the user has changed the contacts for the branch.
std::string history_of(const io::RunFile& run, std::size_t k, scenario::Scenario parent,
                       const scenario::Scenario& branch) {
  const std::int64_t step = run.instant(k).step;
  std::vector<std::string> history = session::departures(run, parent, step);
  parent.contact.friction = run.commanded_friction(step).value_or(parent.contact.friction);
  scenario::Scenario changed = parent;
  changed.contact = branch.contact;
  if (changed.contact != parent.contact)
    history.push_back("a change: " + scenario::differences(parent, changed));
  return session::history_text(history);
}

/// Throws if the user gives a rate of the tilt for a branch of a run in which a command has set another.
void require_rate_in_force(const RunRequest& request, const session::Session& session) {
  if (!session.schedule().course) return;
  for (const char* key : {"tilt.rate", "tilt.step", "tilt.program"})
    if (sets(request.settings, key))
      throw Error(ExitCode::bad_data,
                  "--set {}: a command has set the rate of the tilt of {} to {:g} deg/s before this frame; "
                  "change it in the branch with a command of the kind tilt_rate",
                  key, request.branch, degrees(session.tilt_rate()));
}

}  // namespace

OpenRun start_branch(const RunRequest& request) {
  const io::RunFile run = io::RunFile::open(request.branch);
  const std::string parameters = request.branch + ":/parameters";
  const scenario::Scenario parent = runs::stored_scenario(run.header(), parameters);
  std::string text;
  scenario::Scenario scenario = scenario_of_branch(request, run.header(), text);
  scenario::keep_deposition_friction(parent, scenario);
  FrameOptions frame;
  frame.at = {request.at};
  const std::size_t k = pictures::single_frame(chosen_frames(run, request.branch, frame), request.at);
  io::BranchOrigin origin{
      request.branch, static_cast<std::int64_t>(k), hash_text(state_hash(run.checkpoint().world)), {}};
  try {
    origin.start = session::checkpoint_at_frame(run, k, &scenario);
  } catch (const Error& error) {
    throw Error(error.code(), "{}: {}", request.branch, error.what());
  }
  session::Session session(scenario, origin.start, request.branch, "/branch");
  require_same_past(request, parent, scenario, session.schedule());
  require_rate_in_force(request, session);
  settle_friction(request, parent, session, origin.start, text);
  scenario = session.scenario();
  origin.history = history_of(run, k, parent, scenario);
  if (const auto end = scenario.tilt.end_angle; end && std::abs(degrees(session.world().tilt)) >= *end)
    throw Error(ExitCode::bad_data, "the branch of {} begins at {} deg; expected a tilt.end_angle beyond it",
                request.branch, degrees_text(session.world().tilt, 2));
  session::check_branch_start(origin, scenario, request.branch);
  output_target(request.output, output_of_run(request.branch, request.overwrite));
  io::RunHeader header = session::run_header(
      session, {text, request.scenario, request.command_line, request.threads, std::move(origin)});
  io::RunStore store = io::RunStore::create(request.output, header, request.overwrite);
  session.record_start();
  session::Recorder(session, store).commit();
  return {std::move(header), std::move(store), std::move(session)};
}

OpenRun start_run(const RunRequest& request) {
  if (!request.branch.empty()) return start_branch(request);
  std::string text;
  const scenario::Scenario scenario = scenario::read_scenario(request.scenario, request.settings, &text);
  session::require_memory(scenario);
  session::Session session(scenario);
  const session::RunOrigin origin =
      session::with_bed({text, request.scenario, request.command_line, request.threads}, session);
  if (!request.bed.empty() && request.bed != origin.bed)
    throw Error(ExitCode::bad_data,
                "{} (deposition.file) no longer holds the bed with which the ensemble was started; undo the "
                "change, then compute this member with talus ensemble retry",
                visible(scenario.deposition.file));
  io::RunHeader header = session::run_header(session, origin);
  header.provenance.insert(header.provenance.end(), request.facts.begin(), request.facts.end());
  output_target(request.output, output_of_scenario(request.scenario, scenario));
  io::RunStore store = io::RunStore::create(request.output, header, request.overwrite);
  store.commit({}, session.checkpoint(0.0));
  return {std::move(header), std::move(store), std::move(session)};
}

void require_same_scenario(const RunRequest& request, const scenario::Scenario& stored) {
  if (request.scenario.empty()) return;
  const scenario::Scenario asked = scenario::read_scenario(request.scenario, request.settings);
  if (asked != stored)
    throw Error(ExitCode::bad_data,
                "{} is a run of another scenario, not of {}: {}; name another run with -o, or restart this "
                "one with --overwrite instead of --resume",
                request.output, request.scenario, scenario::differences(stored, asked));
}

OpenRun resume_run(const RunRequest& request) {
  io::RunHeader header;
  io::Checkpoint checkpoint;
  io::RunStore store = io::RunStore::resume(request.output, header, checkpoint);
  prepare_folder_of(request.output);
  const scenario::Scenario scenario = runs::stored_scenario(header, request.output + ":/parameters");
  require_same_scenario(request, scenario);
  session::refuse_unfinished_replay(header, checkpoint.world, request.output);
  if (const std::string begun_by = runs::version_of(header.provenance); begun_by != version_and_commit())
    print_error(
        "talus: note: {} was started by version {} and continues with {}, so results may differ in the last "
        "digits or in how they are measured\n",
        request.output, begun_by, version_and_commit());
  return {std::move(header), std::move(store),
          session::Session(scenario, std::move(checkpoint), request.output)};
}

}  // namespace talus::app
