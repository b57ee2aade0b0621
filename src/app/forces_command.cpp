/// `talus forces`: how much of what is measured is the choice among admissible forces?

#include <cmath>
#include <cstdio>
#include <fmt/core.h>
#include <memory>

#include "app/choices.h"
#include "app/commands.h"
#include "app/terminal.h"
#include "core/errors.h"
#include "core/trigonometry.h"
#include "pictures/frame_choice.h"
#include "problems/admissible_forces.h"
#include "runs/analysis_parameters.h"
#include "scenario/json.h"

namespace talus {
namespace {

struct ForcesArguments {
  std::string run;
  std::vector<std::string> at = {"0", "10", "15", "18"};
  std::vector<std::string> settings;
  ForceSearch search;
  bool json = false;
};

FrameChoice choose_frames(const ForcesArguments& arguments, const RunFile& run) {
  if (run.frame_count() == 0)
    throw Error(ExitCode::bad_data,
                arguments.run + " has no frames yet: the first is that of the bed at rest");
  const double theta_c = find_value(run.checkpoint().results, "theta_c").value_or(not_known);
  return frames_at(run.frame_tilts(), arguments.at, theta_c);
}

json::Members json_quantity(const ForceQuantity& quantity) {
  return {{"quantity", json::quoted(quantity.name)},
          {"threshold_factor", quantity.factor > 0.0 ? json::number(quantity.factor) : "null"}};
}

template <typename Items, typename Text>
std::string json_list(const Items& items, const Text& text) {
  std::string list;
  for (std::size_t i = 0; i < items.size(); ++i) list += (i > 0 ? ", " : "") + text(i);
  return fmt::format("[{}]", list);
}

std::string json_set(const ForceSet& set) {
  using json::number;
  return json::object(
      {{"start", json::quoted(name_of(set.attempt))},
       {"iterations", number(set.report.iterations)},
       {"eta", number(set.report.residual.eta)},
       {"converged", json::truth(set.report.converged)},
       {"admissible", json::truth(set.admissible())},
       {"momentum_left", number(set.momentum_left)},
       {"unbalanced", number(set.unbalanced)},
       {"distance", number(set.distance)},
       {"values", json_list(set.values, [&](std::size_t q) { return number(set.values[q]); })}},
      2);
}

std::string json_spread(const FrameForces& forces, std::size_t q) {
  using json::number;
  const ForceSpread& spread = forces.spreads[q];
  json::Members members = json_quantity(forces.quantities[q]);
  members.insert(members.end(), {{"stored", number(forces.stored[q])},
                                 {"count", number(spread.count)},
                                 {"mean", number(spread.mean)},
                                 {"deviation", number(spread.deviation)},
                                 {"least", number(spread.least)},
                                 {"largest", number(spread.largest)}});
  return json::object(members, 2);
}

std::string json_frame(const FrameForces& forces, std::size_t k) {
  return json::object(
      {{"frame", json::number(k)},
       {"tilt_deg", json::number(degrees(forces.tilt))},
       {"contacts", json::number(forces.contacts)},
       {"others", json::number(forces.sets.size() - 1)},
       {"admissible", json::number(forces.admissible())},
       {"spreads", json_list(forces.spreads, [&](std::size_t q) { return json_spread(forces, q); })},
       {"solutions", json_list(forces.sets, [&](std::size_t s) { return json_set(forces.sets[s]); })}},
      1);
}

std::string title(const ForceQuantity& quantity) {
  return quantity.factor > 0.0 ? fmt::format("{} at {:g} Gamma_c", quantity.name, quantity.factor)
                               : quantity.name;
}

const char* verdict_of(const ForceSet& set) {
  if (set.admissible()) return "";
  return set.report.converged ? "  lets grains go, not counted" : "  not converged, not counted";
}

void print_sets(const FrameForces& forces) {
  print("  %-28s %10s %9s %9s %10s %9s %8s %8s %8s\n", "start", "iterations", "eta", "momentum", "unbalanced",
        "distance", "Gamma", "p_o", "lc_mean");
  for (const ForceSet& set : forces.sets)
    print("  %-28s %10d %9.1e %9.1e %10d %9.3f %8.4f %8.4f %8.3f%s\n", name_of(set.attempt).c_str(),
          set.report.iterations, set.report.residual.eta, set.momentum_left, set.unbalanced, set.distance,
          set.values[0], set.values[2], set.values[3], verdict_of(set));
}

void print_spreads(const FrameForces& forces) {
  print("  %-30s %10s %10s %10s %10s %10s\n", "quantity", "stored", "mean", "deviation", "least", "largest");
  for (std::size_t q = 0; q < forces.quantities.size(); ++q) {
    const ForceSpread& spread = forces.spreads[q];
    if (spread.count == 0) {
      print("  %-30s %10.5f       none\n", title(forces.quantities[q]).c_str(), forces.stored[q]);
      continue;
    }
    print("  %-30s %10.5f %10.5f %10.5f %10.5f %10.5f\n", title(forces.quantities[q]).c_str(),
          forces.stored[q], spread.mean, spread.deviation, spread.least, spread.largest);
  }
}

void print_frame(const FrameForces& forces, std::size_t k, const ForceSearch& search) {
  print("frame %zu at %.3f deg, %d contacts: %d of %d other sets of forces are admissible (eta %.1e)\n", k,
        degrees(forces.tilt), forces.contacts, forces.admissible(), search.solutions, search.tolerance);
  print_sets(forces);
  print("\n");
  print_spreads(forces);
}

void compare(const ForcesArguments& arguments) {
  const AnalysisParameters parameters = parse_analysis_settings(arguments.settings);
  const RunFile run = RunFile::open(arguments.run);
  const FrameChoice frames = choose_frames(arguments, run);
  if (arguments.json) print("[");
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const FrameForces forces = admissible_forces(run, frames[i], parameters, arguments.search);
    if (i > 0) print(arguments.json ? ",\n" : "\n");
    if (arguments.json)
      print_text(json_frame(forces, frames[i]));
    else
      print_frame(forces, frames[i], arguments.search);
    std::fflush(stdout);
  }
  if (arguments.json) print("]\n");
}

void add_search(CLI::App& command, ForceSearch& search) {
  command
      .add_option("--solutions", search.solutions,
                  "How many sets of forces to look for, beside the one from the stored forces")
      ->capture_default_str()
      ->check(in_range(1, 10000));
  command.add_option("--tol", search.tolerance, "Natural-map residual eta that all of them must reach")
      ->capture_default_str()
      ->check(in_range(1e-15, 1.0));
  command.add_option("--max-iterations", search.max_iterations, "Iterations, at most")
      ->capture_default_str()
      ->check(in_range(0, 1000000000));
  command.add_option("--seed", search.seed, "Seed of the random starts and orders")->capture_default_str();
}

}  // namespace

void add_forces_command(CLI::App& app) {
  auto arguments = std::make_shared<ForcesArguments>();
  CLI::App* command = app.add_subcommand(
      "forces", "Find other forces that carry the same bed, and compare what is measured with them");
  command->add_option("RUN", arguments->run, "Run file, or the name of a run that is not complete")
      ->required();
  command
      ->add_option("--at", arguments->at,
                   "Angles in degrees, and repose for the last frame before failure, with commas: "
                   "--at 0,10,repose")
      ->delimiter(',')
      ->capture_default_str()
      ->allow_extra_args(false);
  add_search(*command, arguments->search);
  command
      ->add_option("--set", arguments->settings,
                   "Change a parameter of the analysis, e.g. --set l_min=0 (see docs/analysis.md)")
      ->allow_extra_args(false);
  command->add_flag("--json", arguments->json, "As a JSON list with one object for each frame");
  command->footer(
      "The grains of each frame are held where they are, and forces that carry them are looked for from "
      "many\n"
      "first guesses. A set of forces that does not converge, or lets a grain go, is reported and not "
      "counted.\n"
      "The run file is not changed (see docs/admissible_forces.md).\n"
      "Example: talus forces runs/slope.h5 --at 0,10,15 --solutions 40");
  command->callback([arguments] { compare(*arguments); });
}

}  // namespace talus
