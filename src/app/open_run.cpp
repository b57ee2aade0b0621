#include "app/open_run.h"

#include <cstdlib>
#include <fmt/core.h>

#include "app/output_files.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/output_file.h"
#include "base/version.h"
#include "base/visible_text.h"
#include "session/estimate.h"
#include "session/run_header.h"

namespace talus::app {

OpenRun start_run(const RunRequest& request) {
  std::string text;
  const scenario::Scenario scenario = scenario::read_scenario(request.scenario, request.settings, &text);
  session::require_memory(scenario);
  session::Session session(scenario);
  const session::RunOrigin origin =
      session::with_bed({text, request.scenario, request.command_line, request.threads}, session);
  if (!request.bed.empty() && request.bed != origin.bed)
    throw Error(
        ExitCode::bad_data,
        fmt::format("{} (deposition.file) holds another bed than when the ensemble began with it; undo "
                    "the change, and talus ensemble retry computes this member",
                    visible(scenario.deposition.file)));
  io::RunHeader header = session::run_header(session, origin);
  header.provenance.insert(header.provenance.end(), request.facts.begin(), request.facts.end());
  output_target(request.output, output_of_scenario(request.scenario, scenario));
  prepare_folder_of(request.output);
  io::RunStore store = io::RunStore::create(request.output, header, request.overwrite);
  store.commit({}, session.checkpoint(0.0));
  return {std::move(header), std::move(store), std::move(session)};
}

void require_same_scenario(const RunRequest& request, const scenario::Scenario& stored) {
  if (request.scenario.empty()) return;
  const scenario::Scenario asked = scenario::read_scenario(request.scenario, request.settings);
  if (asked != stored)
    throw Error(ExitCode::bad_data,
                fmt::format("{} is a run of another scenario than {}: {}; name another run with -o, or begin "
                            "this one anew with --overwrite instead of --resume",
                            request.output, request.scenario, scenario::differences(stored, asked)));
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
        "talus: note: %s was begun by version %s and goes on with %s, which may give other bits and measure "
        "differently\n",
        request.output.c_str(), begun_by.c_str(), version_and_commit().c_str());
  return {std::move(header), std::move(store),
          session::Session(scenario, std::move(checkpoint), request.output)};
}

}  // namespace talus::app
