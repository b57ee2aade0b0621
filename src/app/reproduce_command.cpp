/// `talus reproduce`: runs and analyses the paper's beds. The module talus.reproduce of the Python package
/// draws them, and writes a report that compares them with the paper.

#include <cstdio>
#include <fmt/core.h>
#include <memory>

#include "app/commands.h"
#include "app/ensemble_workers.h"
#include "app/options.h"
#include "app/other_programs.h"
#include "app/progress.h"
#include "app/terminal.h"
#include "base/text.h"
#include "ensemble/member_state.h"
#include "ensemble/member_task.h"
#include "ensemble/plan.h"
#include "session/estimate.h"

namespace talus::app {
namespace {

struct ReproduceArguments : EnsembleWorkers {
  bool quick = false;
  std::string seeds;
};

/// Reports the number of missing runs and their estimated time.
void announce(const ensemble::EnsemblePlan& plan, int jobs) {
  double seconds = 0.0;
  for (const ensemble::Member& member : plan.members) seconds += session::estimate(member.scenario).seconds;
  const std::vector<std::size_t> done = ensemble::done_members(plan);
  for (const std::size_t m : done) seconds -= session::estimate(plan.members[m].scenario).seconds;
  print_error("{} of {} runs to compute, about {} on {} processor{}; then their analyses, and figures\n",
              plan.members.size() - done.size(), plan.members.size(), session::duration_text(seconds / jobs),
              jobs, jobs == 1 ? "" : "s");
}

/// Completes readings of finished members that are missing or from another version.
void complete(const ensemble::EnsemblePlan& plan) {
  const std::vector<std::size_t> done = ensemble::done_members(plan);
  const CountDone progress = count_shown("analyses", false);
  for (std::size_t k = 0; k < done.size(); ++k) {
    progress(k, done.size());
    ensemble::complete_readings(plan.members[done[k]]);
  }
  progress(done.size(), done.size());
}

/// Draws the figures, writes the report, and returns its summary.
std::string make_report(const ensemble::EnsemblePlan& plan, const ReproduceArguments& arguments) {
  std::vector<std::string> words = {"--seeds=" + joined(plan.seeds, ","),
                                    fmt::format("--jobs={}", arguments.jobs)};
  for (const ensemble::Variant& bed : plan.variants) words.push_back("--bed=" + bed.name);
  words.insert(words.end(), {"--", arguments.folder});
  return output_of_python_module("reproduce", words);
}

void reproduce(ReproduceArguments arguments) {
  if (arguments.folder.empty()) arguments.folder = arguments.quick ? "reproduction-quick" : "reproduction";
  if (arguments.seeds.empty()) arguments.seeds = arguments.quick ? "1" : "1-2";
  const ensemble::EnsemblePlan plan = ensemble::plan_ensemble(
      ensemble::parse_seeds(arguments.seeds), ensemble::paper_beds(arguments.quick), arguments.folder);
  output_of_python_module("reproduce", {"--help"});  // before runs that take hours: is everything installed?
  if (arguments.jobs > 0) announce(plan, arguments.jobs);
  const EnsembleView view = compute_ensemble(
      {.seeds = plan.seeds, .variants = plan.variants, .task = ensemble::ReadingsTask{}}, arguments, {});
  if (ensemble::done_members(plan).empty()) {
    refuse_failures(plan, "nothing can be reported");
    print_text(ensemble_text(view));  // other workers compute it
    return;
  }
  complete(plan);
  print_text(make_report(plan, arguments));
  refuse_failures(plan, "left out of the report");
}

}  // namespace

void add_reproduce_command(CLI::App& app) {
  auto arguments = std::make_shared<ReproduceArguments>();
  CLI::App* command = app.add_subcommand(
      "reproduce",
      "Run, analyse and draw the beds of the paper, and write a report that compares them with it");
  command->add_flag(
      "--quick", arguments->quick,
      "Use beds of half the depth, for a quick look; their lengths cannot be compared with the paper");
  add_option(
      *command, "-o,--output", arguments->folder, "FOLDER",
      "Folder of runs, figures and report; complete members are kept [reproduction, or reproduction-quick]");
  add_option(*command, "--seeds", arguments->seeds, "SEEDS",
             "Seeds of each bed, e.g. 1-4 or 1-3,8 [1-2; with --quick: 1]");
  add_jobs_option(*command, arguments->jobs);
  command->callback([arguments] { reproduce(*arguments); });
}

}  // namespace talus::app
