#include "app/open_run.h"

#include <unistd.h>

#include "core/errors.h"
#include "session/run_header.h"

namespace talus {
namespace {

volatile std::sig_atomic_t stop_requested = 0;

/// The first signal asks the run to stop after its step; the second leaves at once (the store is whole at any
/// time).
void handle_stop(int) {
  if (stop_requested != 0) _exit(static_cast<int>(ExitCode::stopped));
  stop_requested = 1;
}

}  // namespace

OpenRun start_run(const RunRequest& request) {
  std::string text;
  const Scenario scenario = read_scenario(request.scenario, request.settings, &text);
  Session session(scenario);
  RunHeader header = run_header(session, {text, request.scenario, request.command_line, request.threads});
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
