/// `talus forces`: quantifies how measured quantities depend on the choice among admissible forces.

#include <cmath>
#include <cstdio>
#include <fmt/core.h>
#include <memory>

#include "app/choices.h"
#include "app/commands.h"
#include "app/frame_options.h"
#include "app/json.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/text.h"
#include "base/text_table.h"
#include "core/trigonometry.h"
#include "pictures/frame_choice.h"
#include "problems/admissible_forces.h"
#include "runs/analysis_parameters.h"

namespace talus::app {
namespace {

struct ForcesArguments {
  std::string run;
  std::vector<std::string> at = {"0", "10", "15", "18"};
  std::vector<std::string> settings;
  problems::ForceSearch search;
  bool json = false;
};

pictures::FrameChoice choose_frames(const ForcesArguments& arguments, const io::RunFile& run) {
  if (run.frame_count() == 0)
    throw Error(ExitCode::bad_data,
                arguments.run + " has no frames yet; the first one shows the bed at rest");
  const double theta_c = find_value(run.checkpoint().results, "theta_c").value_or(not_known);
  return pictures::frames_at(run.frame_tilts(), arguments.at, theta_c);
}

Json json_set(const problems::ForceSet& set) {
  return {{"start", problems::name_of(set.attempt)},
          {"iterations", set.report.iterations},
          {"eta", set.report.residual.eta},
          {"converged", set.report.converged},
          {"admissible", set.admissible()},
          {"momentum_left", set.momentum_left},
          {"unbalanced", set.unbalanced},
          {"distance", set.distance},
          {"values", set.values}};
}

Json json_spread(const problems::FrameForces& forces, std::size_t q) {
  const problems::ForceQuantity& quantity = forces.quantities[q];
  const problems::ForceSpread& spread = forces.spreads[q];
  return {{"quantity", quantity.name},
          {"threshold_factor", quantity.factor > 0.0 ? Json(quantity.factor) : Json()},
          {"stored", forces.stored[q]},
          {"count", spread.count},
          {"mean", spread.mean},
          {"deviation", spread.deviation},
          {"least", spread.least},
          {"largest", spread.largest}};
}

Json json_frame(const problems::FrameForces& forces, std::size_t k) {
  Json json = {{"frame", k},
               {"tilt_deg", degrees(forces.tilt)},
               {"contacts", forces.contacts},
               {"others", forces.sets.size() - 1},
               {"admissible", forces.admissible()},
               {"spreads", Json::array()},
               {"solutions", Json::array()}};
  for (std::size_t q = 0; q < forces.spreads.size(); ++q) json["spreads"].push_back(json_spread(forces, q));
  for (const problems::ForceSet& set : forces.sets) json["solutions"].push_back(json_set(set));
  return json;
}

std::string title(const problems::ForceQuantity& quantity) {
  return quantity.factor > 0.0 ? fmt::format("{} at {:g} Gamma_c", quantity.name, quantity.factor)
                               : quantity.name;
}

const char* verdict_of(const problems::ForceSet& set) {
  if (set.admissible()) return "";
  return set.report.converged ? "leaves grains unsupported, not counted" : "not converged, not counted";
}

std::string sets_text(const problems::FrameForces& forces) {
  TextTable table{{{"start"}}, {}};
  for (const char* title :
       {"iterations", "eta", "momentum", "unbalanced", "distance", "Gamma", "p_o", "lc_mean"})
    table.columns.push_back({title, true});
  table.columns.push_back({""});
  for (const problems::ForceSet& set : forces.sets)
    table.rows.push_back({{problems::name_of(set.attempt)},
                          {std::to_string(set.report.iterations)},
                          {fmt::format("{:.1e}", set.report.residual.eta)},
                          {fmt::format("{:.1e}", set.momentum_left)},
                          {std::to_string(set.unbalanced)},
                          {fmt::format("{:.3f}", set.distance)},
                          {number_cell("{:.4f}", set.values[0])},
                          {number_cell("{:.4f}", set.values[2])},
                          {number_cell("{:.3f}", set.values[3])},
                          {verdict_of(set)}});
  return aligned_text(table, 2);
}

std::string spreads_text(const problems::FrameForces& forces) {
  TextTable table{{{"quantity"}}, {}};
  for (const char* title : {"stored", "mean", "deviation", "least", "largest"})
    table.columns.push_back({title, true});
  for (std::size_t q = 0; q < forces.quantities.size(); ++q) {
    const problems::ForceSpread& spread = forces.spreads[q];
    auto& row = table.rows.emplace_back();
    row = {{title(forces.quantities[q])}, {number_cell("{:.5f}", forces.stored[q])}};
    if (spread.count == 0)
      row.push_back({"none"});
    else
      for (const double value : {spread.mean, spread.deviation, spread.least, spread.largest})
        row.push_back({number_cell("{:.5f}", value)});
  }
  return aligned_text(table, 2);
}

void print_frame(const problems::FrameForces& forces, std::size_t k, const problems::ForceSearch& search) {
  print("frame %zu at %s deg, %d contacts: %d of %d other sets of forces are admissible (eta %.1e)\n", k,
        degrees_text(forces.tilt, 3).c_str(), forces.contacts, forces.admissible(), search.solutions,
        search.tolerance);
  print_text(fmt::format("{}\n{}", sets_text(forces), spreads_text(forces)));
}

void compare(const ForcesArguments& arguments) {
  const analysis::AnalysisParameters parameters = runs::parse_analysis_settings(arguments.settings);
  const io::RunFile run = io::RunFile::open(arguments.run);
  const pictures::FrameChoice frames = choose_frames(arguments, run);
  if (arguments.json) print("[");
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const problems::FrameForces forces =
        problems::admissible_forces(run, frames[i], parameters, arguments.search);
    if (i > 0) print(arguments.json ? ",\n" : "\n");
    if (arguments.json)
      print_text(json_text(json_frame(forces, frames[i])));
    else
      print_frame(forces, frames[i], arguments.search);
    std::fflush(stdout);
  }
  if (arguments.json) print("]\n");
}

void add_search(CLI::App& command, problems::ForceSearch& search) {
  command
      .add_option("--solutions", search.solutions,
                  "Number of sets of forces to look for, in addition to the solution from the stored forces")
      ->capture_default_str()
      ->check(in_range(1, 10000));
  command.add_option("--tol", search.tolerance, "Natural-map residual eta that every set must reach")
      ->capture_default_str()
      ->check(in_range(1e-15, 1.0));
  command.add_option("--max-iterations", search.max_iterations, "Maximum number of iterations")
      ->capture_default_str()
      ->check(in_range(0, 1000000000));
  command.add_option("--seed", search.seed, "Seed of the random starts and orders")->capture_default_str();
}

}  // namespace

void add_forces_command(CLI::App& app) {
  auto arguments = std::make_shared<ForcesArguments>();
  CLI::App* command = app.add_subcommand(
      "forces",
      "Find other admissible forces for the same bed, and compare the quantities measured with them");
  command->add_option("RUN", arguments->run, "Run file, or the name of an incomplete run")->required();
  add_at_option(*command, arguments->at)->capture_default_str();
  add_search(*command, arguments->search);
  command
      ->add_option("--set", arguments->settings,
                   "Change a parameter of the analysis, e.g. --set l_min=0 (see docs/analysis.md)")
      ->allow_extra_args(false);
  command->add_flag("--json", arguments->json, "Print a JSON list with one object for each frame");
  command->footer(
      "The grains of each frame are kept in place, and forces that carry them are\nsought from many initial "
      "guesses. A set of forces that does not converge, or\nleaves a grain unsupported, is reported but not "
      "counted.\nThe run file is not changed (see docs/analysis.md).");
  command->callback([arguments] { compare(*arguments); });
}

}  // namespace talus::app
