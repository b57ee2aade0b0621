#include "app/open_run.h"

#include <unistd.h>

#include <ctime>

#include "core/errors.h"
#include "core/version.h"

namespace talus {
namespace {

volatile std::sig_atomic_t stop_requested = 0;

/// The first signal asks the run to stop after its step; the second leaves at once (the store is whole at any
/// time).
void handle_stop(int) {
  if (stop_requested != 0) _exit(static_cast<int>(ExitCode::stopped));
  stop_requested = 1;
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

RunHeader make_header(const RunRequest& request, const Session& session, const std::string& text) {
  RunHeader header;
  header.statics = run_statics(session.scenario(), session.world());
  header.scenario_given = text;
  header.scenario_resolved = resolved_toml(session.scenario());
  header.seed = session.scenario().seed;
  header.provenance = {{"version", version},
                       {"git_hash", git_hash},
                       {"compiler", compiler},
                       {"flags", build_flags},
                       {"host", host_name()},
                       {"threads", std::to_string(request.threads)},
                       {"start", utc_now()},
                       {"command", request.command_line},
                       {"scenario_file", request.scenario}};
  return header;
}

}  // namespace

OpenRun start_run(const RunRequest& request) {
  std::string text;
  const Scenario scenario = read_scenario(request.scenario, request.settings, &text);
  Session session(scenario);
  RunHeader header = make_header(request, session, text);
  RunStore store = RunStore::create(request.output, header, request.overwrite);
  return {std::move(header), std::move(store), std::move(session)};
}

OpenRun resume_run(const RunRequest& request) {
  RunHeader header;
  Checkpoint checkpoint;
  RunStore store = RunStore::resume(request.output, header, checkpoint);
  if (!request.scenario.empty() &&
      resolved_toml(read_scenario(request.scenario, request.settings)) != header.scenario_resolved)
    throw Error(ExitCode::bad_data,
                request.output + " was started with another scenario than " + request.scenario +
                    "; compare `talus info` of the run with `talus check` of the scenario");
  const Scenario scenario = parse_scenario(header.scenario_resolved, request.output + ":/parameters");
  return {std::move(header), std::move(store), Session(scenario, std::move(checkpoint))};
}

const volatile std::sig_atomic_t* catch_stop_signals() {
  struct sigaction action = {};
  action.sa_handler = handle_stop;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  return &stop_requested;
}

}  // namespace talus
