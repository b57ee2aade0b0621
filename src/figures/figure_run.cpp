#include "figures/figure_run.h"

#include "core/hash.h"
#include "core/snapshot.h"
#include "core/trigonometry.h"
#include "ensemble/member_analysis.h"
#include "session/run_header.h"

namespace talus {

FigureRun run_of_file(const std::string& path, RunFile file, Analysis analysis) {
  FigureRun run{path, std::move(file), std::move(analysis), {}, {}, {}};
  const RunHeader& header = run.file->header();
  const Checkpoint& end = run.file->checkpoint();
  run.scenario = stored_scenario(header, path);
  run.scenario_text = header.scenario_resolved;
  run.state_hash = hash_text(state_hash(end.world));
  run.mean_diameter = header.statics.mean_diameter;
  run.theta_r = find_value(end.results, "theta_r").value_or(not_known);
  return run;
}

FigureRun run_of_values(const std::string& path, const MemberResult& member,
                        const std::string& scenario_text) {
  FigureRun run{path, std::nullopt, {}, parse_scenario(scenario_text, path), scenario_text, {}};
  run.scenario.seed = member.seed;
  run.state_hash = member.numbers.state_hash;
  run.mean_diameter = run.scenario.grains.mean_diameter;
  run.analysis = analysis_of(member, run.mean_diameter);
  run.theta_r = radians(number_called(member.numbers, "theta_r"));
  return run;
}

}  // namespace talus
