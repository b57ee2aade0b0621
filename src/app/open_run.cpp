#include "app/open_run.h"

#include <unistd.h>

#include <cstdlib>

#include "core/errors.h"
#include "session/run_header.h"

namespace talus {
namespace {

volatile std::sig_atomic_t stop_requested = 0;
volatile std::sig_atomic_t checkpoint_requested = 0;

/// The first signal asks the run to stop after its step; the second leaves at once (the store is whole at any
/// time).
void handle_stop(int) {
  if (stop_requested != 0) _exit(static_cast<int>(ExitCode::stopped));
  stop_requested = 1;
}

void handle_checkpoint(int) { checkpoint_requested = 1; }

void catch_signal(int signal, void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigaction(signal, &action, nullptr);
}

}  // namespace

OpenRun start_run(const RunRequest& request) {
  std::string text;
  const Scenario scenario = read_scenario(request.scenario, request.settings, &text);
  Session session(scenario);
  RunHeader header = run_header(session, {text, request.scenario, request.command_line, request.threads});
  RunStore store = RunStore::create(request.output, header, request.overwrite);
  store.commit({}, session.checkpoint(0.0));
  return {std::move(header), std::move(store), std::move(session)};
}

namespace {

/// A replay that has not reached the end of its run lacks the commands that are still to come.
void refuse_unfinished_replay(const RunRequest& request, const RunHeader& header, const World& world) {
  const std::optional<std::string> steps = find_value(header.provenance, "replay_steps");
  if (!steps || world.step >= std::atoll(steps->c_str())) return;
  const std::string run = find_value(header.provenance, "replay_of").value_or("RUN");
  throw Error(ExitCode::bad_data,
              request.output + " is a replay of " + run + " that was stopped after " +
                  std::to_string(world.step) + " of its " + *steps +
                  " steps, without the commands that follow; begin it again with: talus replay " + run +
                  " -o " + request.output + " --overwrite");
}

}  // namespace

OpenRun resume_run(const RunRequest& request) {
  RunHeader header;
  Checkpoint checkpoint;
  RunStore store = RunStore::resume(request.output, header, checkpoint);
  const Scenario scenario = stored_scenario(header, request.output + ":/parameters");
  if (!request.scenario.empty() && read_scenario(request.scenario, request.settings) != scenario)
    throw Error(ExitCode::bad_data,
                request.output + " was started with another scenario than " + request.scenario +
                    "; compare `talus info` of the run with `talus check` of the scenario");
  refuse_unfinished_replay(request, header, checkpoint.world);
  return {std::move(header), std::move(store), Session(scenario, std::move(checkpoint), request.output)};
}

const volatile std::sig_atomic_t* catch_stop_signals() {
  for (const int signal : {SIGINT, SIGTERM}) catch_signal(signal, handle_stop);
  return &stop_requested;
}

volatile std::sig_atomic_t* catch_checkpoint_signal() {
  catch_signal(SIGUSR1, handle_checkpoint);
  return &checkpoint_requested;
}

}  // namespace talus
