#include "app/figure_runs.h"

#include <cstdio>
#include <fmt/core.h>

#include "core/errors.h"
#include "core/visible_text.h"
#include "ensemble/ensemble_manifest.h"
#include "ensemble/member_state.h"
#include "session/run_header.h"

namespace talus {
namespace {

std::vector<std::string> members_done(const std::string& folder) {
  const EnsemblePlan plan = plan_of(read_ensemble(folder), folder);
  const std::vector<MemberState> states = look_at_members(plan);
  std::vector<std::string> runs;
  for (std::size_t m = 0; m < states.size(); ++m)
    if (states[m].stage == MemberStage::done) runs.push_back(plan.members[m].path);
  if (runs.empty())
    throw Error(ExitCode::missing_input,
                fmt::format("{}: no member of this ensemble is done yet; talus ensemble status {} tells how "
                            "far they are",
                            folder, folder));
  return runs;
}

}  // namespace

std::vector<std::string> runs_named(const std::vector<std::string>& paths) {
  std::vector<std::string> runs;
  for (const std::string& path : paths) {
    const std::vector<std::string> named =
        is_ensemble(path) ? members_done(path) : std::vector<std::string>{path};
    runs.insert(runs.end(), named.begin(), named.end());
  }
  return runs;
}

std::vector<FigureRun> open_figure_runs(const std::vector<std::string>& paths,
                                        const AnalysisParameters& parameters,
                                        const AnalysisOptions& options) {
  std::vector<FigureRun> runs;
  for (const std::string& path : paths) {
    // The analysis comes first: storing it replaces the file.
    AnalysedRun run = analysed_run(path, parameters, options);
    if (!run.is_kept && !options.quiet)
      std::fprintf(stderr, "talus: note: %s: %s\n", path.c_str(), visible(run.state).c_str());
    RunFile file = RunFile::open(path);
    const Scenario scenario = stored_scenario(file.header(), path);
    runs.push_back({path, std::move(file), std::move(run.analysis), scenario});
  }
  return runs;
}

}  // namespace talus
