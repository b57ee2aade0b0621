/// `talus reproduce`: runs, analyses and draws the paper's beds, and writes a report that compares them with
/// the paper.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fmt/core.h>
#include <memory>

#include "app/commands.h"
#include "app/ensemble_workers.h"
#include "app/figure_files.h"
#include "app/figure_runs.h"
#include "app/figure_text.h"
#include "app/gnuplot.h"
#include "app/jobs_option.h"
#include "app/progress.h"
#include "app/stop_signals.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/paths.h"
#include "base/text.h"
#include "figures/agreement_figure.h"
#include "figures/catalogue.h"
#include "io/durable_file.h"
#include "session/estimate.h"
#include "studies/reproduction_report.h"
#include "studies/reproduction_values.h"

namespace talus::app {
namespace {

namespace fs = std::filesystem;

struct ReproduceArguments {
  bool quick = false;
  std::string folder;
  std::string seeds;
  int jobs = default_jobs();
};

/// Completes readings of finished members that are missing or from another version.
void complete(const studies::ReproductionPlan& plan) {
  const std::vector<std::size_t> done = ensemble::done_members(plan);
  const CountDone progress = count_shown("analyses", false);
  for (std::size_t k = 0; k < done.size(); ++k) {
    progress(k, done.size());
    if (!studies::is_measured(plan.members[done[k]])) studies::complete_readings(plan.members[done[k]]);
  }
  progress(done.size(), done.size());
}

/// Reports the number of missing runs and their estimated time.
void announce(const studies::ReproductionPlan& plan, int jobs) {
  double seconds = 0.0;
  for (const ensemble::Member& member : plan.members) seconds += session::estimate(member.scenario).seconds;
  const std::vector<std::size_t> done = ensemble::done_members(plan);
  for (const std::size_t m : done) seconds -= session::estimate(plan.members[m].scenario).seconds;
  print_error("%zu of %zu runs to compute, about %s on %d processor%s; then their analyses, and figures\n",
              plan.members.size() - done.size(), plan.members.size(),
              session::duration_text(seconds / jobs).c_str(), jobs, jobs == 1 ? "" : "s");
}

std::vector<figures::RunGroup> open_groups(const studies::ReproductionPlan& plan) {
  std::vector<std::size_t> members = ensemble::done_members(plan);
  // Sorted by bed, so that groups follow the order of the plan: the paper's preparation first.
  std::ranges::stable_sort(members, {}, [&](std::size_t m) { return plan.members[m].variant; });
  std::vector<std::string> paths;
  for (const std::size_t m : members) paths.push_back(plan.members[m].path);
  return figures::group_runs(open_figure_runs(paths, analysis::AnalysisParameters(), {}));
}

/// Returns the `talus figures` command that makes the same figure.
std::string command_of(const figures::Figure& figure, const std::string& folder) {
  std::string text = "talus figures";
  for (const std::string& run : figure.runs) text += " " + run;
  return fmt::format("{} --only {} -o {}", text, figure.name, folder);
}

/// Returns the `talus reproduce` command that makes the chart.
std::string command_of(const studies::ReproductionPlan& plan, const std::string& folder) {
  return fmt::format("talus reproduce{} --seeds {} -o {}", plan.quick ? " --quick" : "",
                     joined(plan.seeds, ","), folder);
}

bool holds(const fs::path& file, const std::string& text) {
  return is_there(file.string()) && io::read_text(file.string()) == text;
}

/// Whether all files of a figure exist and were drawn from the same data in the same way.
bool is_drawn(const figures::Figure& figure, std::span<const figures::RunGroup> groups,
              const fs::path& folder, const FigureOptions& options) {
  const auto there = [&](const std::string& file) { return is_there((folder / file).string()); };
  return std::ranges::all_of(figure_files(figure), there) &&
         holds(folder / (figure.name + ".json"), provenance_json(figure, groups, options.command_line)) &&
         holds(folder / (figure.name + ".gp"), gnuplot_text(figure, options.size));
}

/// Draws a figure, unless it exists with the same provenance and script, and returns it as a picture of the
/// report.
studies::ReportPicture drawn(const figures::Figure& figure, std::span<const figures::RunGroup> groups,
                             const std::string& folder, const FigureOptions& options) {
  try {
    if (!is_drawn(figure, groups, folder, options)) write_figure(figure, groups, folder, options);
  } catch (const Error&) {
    stop_if_asked();  // Ctrl-C ends gnuplot too, which is no error of the figure
    throw;
  }
  return {fmt::format("figures/{}.png", figure.name), figure.title, figure.caption, figure.wide};
}

std::vector<studies::ReportPicture>& part_of(studies::ReproductionPictures& pictures,
                                             figures::Subject subject) {
  switch (subject) {
    case figures::Subject::packing:
      return pictures.packing;
    case figures::Subject::overload:
      return pictures.overload;
    case figures::Subject::walls:
      return pictures.walls;
    case figures::Subject::further:
      break;
  }
  return pictures.further;
}

/// Draws the chart of agreement, and all figures of the catalogue that the complete, analysed runs allow.
studies::ReproductionPictures draw_figures(const studies::ReproductionPlan& plan,
                                           const studies::ReproductionResult& result,
                                           const std::string& folder) {
  const std::vector<figures::RunGroup> groups = open_groups(plan);
  const std::string into = (fs::path(folder) / "figures").string();
  const auto catalogue = figures::figure_catalogue();
  studies::ReproductionPictures pictures;
  const CountDone progress = count_shown("figures", false);
  progress(0, catalogue.size() + 1);
  if (const auto chart = figures::agreement_figure(result))
    pictures.agreement.push_back(drawn(*chart, groups, into, {{}, command_of(plan, folder)}));
  for (std::size_t k = 0; k < catalogue.size(); ++k) {
    progress(k + 1, catalogue.size() + 1);
    stop_if_asked();
    if (const auto figure = catalogue[k].make(groups))
      part_of(pictures, catalogue[k].subject)
          .push_back(drawn(*figure, groups, into, {{}, command_of(*figure, into)}));
  }
  progress(catalogue.size() + 1, catalogue.size() + 1);
  return pictures;
}

void write_report(const studies::ReproductionResult& result, const studies::ReproductionPictures& pictures,
                  const fs::path& folder) {
  io::write_text(folder / "values.csv", studies::values_csv(result));
  io::write_text(folder / "report.html",
                 studies::report_html(studies::reproduction_report(result, pictures), folder));
  for (const std::string& item : studies::reproduction_summary(result)) print("- %s\n", item.c_str());
  print("The report is %s\n", (folder / "report.html").c_str());
}

void reproduce(const ReproduceArguments& arguments) {
  const std::string folder = !arguments.folder.empty() ? arguments.folder
                             : arguments.quick         ? "reproduction-quick"
                                                       : "reproduction";
  const std::string seeds = !arguments.seeds.empty() ? arguments.seeds : arguments.quick ? "1" : "1-2";
  const studies::ReproductionPlan plan = studies::plan_reproduction(arguments.quick, seeds, folder);
  require_gnuplot();
  if (arguments.jobs > 0) announce(plan, arguments.jobs);
  const EnsembleView view =
      compute_ensemble({.seeds = plan.seeds, .variants = plan.variants, .task = ensemble::ReadingsTask{}},
                       {folder, {}, "", arguments.jobs}, {});
  if (ensemble::done_members(plan).empty()) {
    refuse_failures(plan, "nothing can be reported");
    print_text(ensemble_text(view));  // other workers compute it
    return;
  }
  complete(plan);
  const studies::ReproductionResult result = studies::measure_members(plan);
  write_report(result, draw_figures(plan, result, folder), folder);
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
  command->add_option(
      "-o,--output", arguments->folder,
      "Folder of runs, figures and report; complete members are kept [reproduction, or reproduction-quick]");
  command->add_option("--seeds", arguments->seeds,
                      "Seeds of each bed, e.g. 1-4 or 1-3,8 [1-2; with --quick: 1]");
  add_jobs_option(*command, arguments->jobs);
  command->callback([arguments] { reproduce(*arguments); });
}

}  // namespace talus::app
