#include "session/run_header.h"

#include <unistd.h>

#include <cstdlib>
#include <ctime>
#include <fmt/core.h>

#include "base/errors.h"
#include "base/hash.h"
#include "base/version.h"
#include "base/visible_text.h"
#include "session/branch_start.h"
#include "session/frame_state.h"

namespace talus::session {
namespace {

constexpr const char* bed_fact = "bed_hash";

std::string bed_of(const Session& at_start) {
  const bool from_file = at_start.scenario().deposition.method == scenario::DepositionMethod::file;
  return from_file ? hash_text(state_hash(at_start.world())) : std::string();
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

std::string host_name() {
  char name[256] = "unknown";
  gethostname(name, sizeof name - 1);
  return name;
}

}  // namespace

RunOrigin with_bed(RunOrigin origin, const Session& at_start) {
  if (!origin.branch) origin.bed = bed_of(at_start);
  return origin;
}

std::string bed_of(const Facts& provenance) { return find_value(provenance, bed_fact).value_or(""); }

io::RunHeader run_header(const Session& session, const RunOrigin& origin) {
  io::RunHeader header;
  header.statics = run_statics(session.scenario(), session.world());
  header.friction = scenario::friction(session.scenario());
  header.deposition_friction = scenario::deposition_friction(session.scenario());
  header.scenario_given = origin.scenario_text;
  header.scenario_resolved = scenario::resolved_toml(session.scenario());
  header.seed = session.scenario().seed;
  header.provenance = {{"version", version},
                       {"git_hash", git_hash},
                       {"compiler", compiler},
                       {"flags", build_flags},
                       {"host", host_name()},
                       {"threads", std::to_string(origin.threads)},
                       {"start", utc_now()},
                       {"command", origin.command_line},
                       {"scenario_file", origin.scenario_file}};
  if (!origin.bed.empty()) header.provenance.emplace_back(bed_fact, origin.bed);
  if (origin.branch && !origin.branch->history.empty())
    header.provenance.emplace_back(io::history_fact, origin.branch->history);
  header.branch = origin.branch;
  return header;
}

void refuse_unfinished_replay(const io::RunHeader& header, const World& world, const std::string& path) {
  const std::optional<std::string> steps = find_value(header.provenance, "replay_steps");
  if (!steps || world.step >= std::atoll(steps->c_str())) return;
  const std::string run = find_value(header.provenance, "replay_of").value_or("RUN");
  throw Error(ExitCode::bad_data,
              fmt::format("{} is a replay of {} that was stopped after {} of its {} steps, without the "
                          "commands that follow; repeat it with: talus replay {} -o {} --overwrite",
                          path, run, world.step, *steps, run, path));
}

Session session_at_start(const io::RunHeader& header, const std::string& name) {
  const scenario::Scenario scenario = runs::stored_scenario(header, name + ":/parameters");
  if (!header.branch) {
    Session session(scenario);
    const std::string bed = bed_of(header.provenance);
    if (bed.empty() || bed == bed_of(session)) return session;
    throw Error(
        ExitCode::bad_data,
        fmt::format(
            "{} (deposition.file) no longer holds the bed from which {} was computed; undo the change",
            visible(scenario.deposition.file), name));
  }
  check_branch_start(*header.branch, scenario, name);
  Session session(scenario, start_of(header.branch->start), name, "/branch");
  session.record_start();
  return session;
}

}  // namespace talus::session
