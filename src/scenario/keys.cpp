#include "scenario/keys.h"

#include <cmath>
#include <fmt/core.h>
#include <limits>

#include "scenario/scripted_command.h"
#include "scenario/text.h"
#include "scenario/tilt_program.h"

namespace talus::scenario {
namespace {

using Keys = std::vector<ScenarioKey>;

NumberRange positive() { return above_to(0.0, std::numeric_limits<double>::infinity()); }

/// Returns the keys of a section, which is a part of the scenario.
template <typename Part>
Keys section(const std::string& name, Part Scenario::*part, const std::vector<Key<Part>>& keys) {
  Keys all;
  for (const Key<Part>& key : keys) all.emplace_back(part, key).section = name;
  return all;
}

Keys grains_keys() {
  using P = Scenario::GrainSizes;
  return section(
      "grains", &Scenario::grains,
      {
          {{"mean_diameter", "m", from_to(1e-5, 10.0), "mean diameter D of the grains"}, &P::mean_diameter},
          {{"size_ratio", "", from_to(1.0, 4.0),
            "largest over smallest diameter; diameters are uniform between them"},
           &P::size_ratio},
          {{"density", "kg/m^3", from_to(1e-3, 1e6), "density of the grains"}, &P::density},
      });
}

Keys contact_keys() {
  using P = Scenario::ContactLaw;
  return section(
      "contact", &Scenario::contact,
      {
          {{"friction", "", from_to(0.0, 10.0),
            "coefficient of friction between grains, and of grains on the floor"},
           &P::friction},
          {{"wall_friction", "", from_to(0.0, 10.0), "coefficient of friction of grains on the side walls"},
           &P::wall_friction},
          {{"rolling_friction", "", from_to(0.0, 10.0),
            "coefficient of rolling friction mu_r between grains, and of grains on the floor; 0: grains roll "
            "freely"},
           &P::rolling_friction},
          {{"restitution", "", from_to(0.0, 1.0),
            "normal coefficient of restitution: velocity after an impact over that before it"},
           &P::restitution},
          {{"tangential_restitution", "", from_to(-1.0, 1.0),
            "the same for the tangential velocity of a contact that sticks"},
           &P::tangential_restitution},
      });
}

Keys bed_keys() {
  using P = Scenario::Bed;
  return section(
      "bed", &Scenario::bed,
      {
          {{"boundary", "", Choices{{"periodic", "walls"}},
            "boundary along the bed: periodic, or two side walls"},
           &P::boundary},
          {{"length", "D", from_to(10.0, 1e5), "length L of the bed"}, &P::length},
          {{"depth", "D", from_to(1.0, 1e4), "depth H of the bed; it has L H / D^2 grains, rounded"},
           &P::depth},
          {{"floor", "", Choices{{"rough", "smooth"}}, "grains of diameter D glued side by side, or a plane"},
           &P::floor},
      });
}

Keys deposition_keys() {
  using P = Scenario::Deposition;
  return section(
      "deposition", &Scenario::deposition,
      {
          {{"method", "", Choices{{"pour", "geometric", "collapse", "file"}},
            "how the bed is made: its grains are poured one after another, set down geometrically, fall all "
            "at once, or are read from a file"},
           &P::method},
          {{"arrival_speed", "sqrt(g D)", from_to(0.0, 20.0), "pour: speed of a grain at its first contact"},
           &P::arrival_speed},
          {{"rate", "sqrt(g/D)", from_to(0.01, 10.0),
            "pour: number of layers, of L / D grains each, that arrive in a time of sqrt(D / g)"},
           &P::rate},
          {{"critical_angle", "deg", from_to(0.0, 90.0),
            "geometric: a grain stays where it lands on another one if the contact normal is within this "
            "angle of the vertical; 0: it always rolls"},
           &P::critical_angle},
          {{"sites", "", IntegerRange{1, 1000},
            "geometric: number of places tried for each grain, of which the lowest is kept"},
           &P::sites},
          {{"file", "", TextRange{"the path of a file", 4095},
            "file: a run, a dump of LAMMPS or LIGGGHTS, extended XYZ, or a table with x, y and radius of one "
            "grain in each line; relative to the working directory"},
           &P::file},
          {{"file_unit", "", Choices{{"D", "m", "cm", "mm", "um"}},
            "file: unit of the lengths in a table; a unit in its column names, as in \"x [mm]\", takes "
            "precedence over D"},
           &P::file_unit},
          {{"file_scale", "", above_to(0.0, 1e9),
            "file: factor on all lengths of a table or dump, which are then in file_unit"},
           &P::file_scale},
          {{"frame", "", IntegerRange{-1, 1'000'000'000},
            "file: number of the frame of a run or dump, from 0; -1: the last"},
           &P::frame},
          {{"relax", "", Switch{},
            "file: overlaps of up to 0.1 D, as between soft grains, are removed first"},
           &P::relax},
          {{"initial_solid_fraction", "", from_to(0.1, 0.7),
            "collapse: solid fraction of the loose arrangement; lower if the size ratio needs more room"},
           &P::initial_solid_fraction},
          {{"friction", "", from_to(0.0, 10.0, "contact"),
            "coefficient of friction between grains until the bed is at rest; \"contact\": that of "
            "contact.friction"},
           &P::friction},
          {{"wall_friction", "", from_to(0.0, 10.0, "contact"),
            "the same on the side walls; \"contact\": that of contact.wall_friction"},
           &P::wall_friction},
          {{"rest_velocity", "g h", above_to(0.0, 0.1),
            "the bed is at rest when its rms velocity stays below this"},
           &P::rest_velocity},
          {{"max_time", "s", above_to(0.0, 3600.0),
            "simulated time after the last arrival within which the bed must come to rest"},
           &P::max_time},
      });
}

Keys tilt_keys() {
  using P = Scenario::Tilt;
  return section(
      "tilt", &Scenario::tilt,
      {
          {{"rate", "deg/s", from_to(1e-4, 100.0), "how fast the bed is tilted"}, &P::rate},
          {{"step", "deg", from_to(1e-8, 1.0), "tilt in one time step h = step / rate"}, &P::step},
          {{"end_angle", "deg", above_to(0.0, 60.0, "repose"),
            "tilt, on either side, at which the run ends; \"repose\": when the slope has failed"},
           &P::end_angle},
          {{"program", "",
            PhraseList{"phrases", 1000, "none", program_phrase_forms(),
                       [](const std::string& phrase) { return program_phrase(phrase).has_value(); },
                       meant_phrase},
            "course of the tilt, phrase by phrase; \"none\": it grows at tilt.rate to tilt.end_angle"},
           &P::program},
          {{"after_failure", "", Choices{{"stop", "lower", "hold"}},
            "what follows failure: the run ends, or the tilt is lowered or held until the flow has stopped"},
           &P::after_failure},
          {{"lowering_rate", "deg/s", from_to(1e-4, 100.0), "how fast the tilt is lowered after failure"},
           &P::lowering_rate},
      });
}

Keys solver_keys() {
  using P = Scenario::SolverParameters;
  return section(
      "solver", &Scenario::solver,
      {
          {{"method", "", Choices{{"accelerated", "gauss-seidel"}},
            "Gauss-Seidel with momentum, or without: the slow reference"},
           &P::method},
          {{"tolerance", "", from_to(1e-12, 1e-2),
            "required natural-map residual of a step while the bed is at rest"},
           &P::tolerance},
          {{"moving_tolerance", "", from_to(1e-12, 1e-2),
            "the same at an rms velocity of g h or more; below that, in proportion to the velocity"},
           &P::moving_tolerance},
          {{"max_iterations", "", IntegerRange{1, 10'000'000},
            "number of iterations after which a step is accepted as it is"},
           &P::max_iterations},
          {{"allowed_overlap", "D", from_to(0.0, 0.01), "overlaps up to this are left as they are"},
           &P::allowed_overlap},
          {{"overlap_correction", "", from_to(0.0, 1.0),
            "largest share of the overlap beyond the allowed one that is removed in each step"},
           &P::overlap_correction},
      });
}

Keys output_keys() {
  using P = Scenario::Output;
  return section(
      "output", &Scenario::output,
      {
          {{"frame_every", "deg", above_to(0.0, 60.0), "tilt between stored frames (the whole bed)"},
           &P::frame_every},
          {{"observable_every", "deg", above_to(0.0, 60.0),
            "tilt between stored rows of observables (scalars of the bed)"},
           &P::observable_every},
          {{"checkpoint_every", "s", from_to(0.0, 86400.0),
            "wall time between checkpoints; 0: one after each step"},
           &P::checkpoint_every},
      });
}

Keys guards_keys() {
  using P = Scenario::Guards;
  return section(
      "guards", &Scenario::guards,
      {
          {{"action", "", Choices{{"stop", "warn"}},
            "what happens when a guard is broken: the run stops, or continues with a recorded warning"},
           &P::action},
          {{"velocity", "sqrt(g D)", positive(), "largest velocity of a grain"}, &P::velocity},
          {{"overlap", "D", positive(), "largest overlap of two grains"}, &P::overlap},
          {{"energy", "m g H", positive(), "largest mean kinetic energy of a grain"}, &P::energy},
          {{"unconverged", "", IntegerRange{1, 1'000'000'000},
            "largest number of consecutive steps that miss their tolerance"},
           &P::unconverged},
      });
}

constexpr double shortest_time_step = 1e-5;  // s
constexpr double longest_time_step = 1e-2;   // s
constexpr double longest_over_fall = 0.4;    // sqrt(D / g)

}  // namespace

const std::vector<ScenarioKey>& scenario_keys() {
  static const Keys keys = [] {
    Keys all = {{{"seed", "", IntegerRange{0, std::numeric_limits<std::int64_t>::max()},
                  "seed of the random deposition"},
                 &Scenario::seed}};
    for (const Keys& part : {grains_keys(), contact_keys(), bed_keys(), deposition_keys(), tilt_keys(),
                             solver_keys(), output_keys(), guards_keys()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return keys;
}

const ScenarioKey* find_key(std::string_view wanted) {
  const auto found = std::ranges::find(scenario_keys(), wanted, full_name);
  return found == scenario_keys().end() ? nullptr : &*found;
}

std::vector<std::string> key_names(const Scenario& scenario) {
  std::vector<std::string> names;
  for (const ScenarioKey& key : scenario_keys()) names.push_back(full_name(key));
  for (std::size_t k = 0; k < scenario.commands.size(); ++k)
    for (const CommandKey& key : command_keys(command_section(k))) names.push_back(full_name(key));
  return names;
}

std::string value_text(const Scenario& scenario, std::string_view name) {
  if (const ScenarioKey* key = find_key(name)) return plain_text(key->get(scenario));
  for (std::size_t k = 0; k < scenario.commands.size(); ++k)
    if (name.starts_with(command_section(k) + "."))
      for (const CommandKey& key : command_keys(command_section(k)))
        if (full_name(key) == name) return plain_text(key.get(scenario.commands[k]));
  return "none";
}

std::vector<BrokenRule> broken_rules(const Scenario& scenario) {
  std::vector<BrokenRule> broken;
  const double h = time_step(scenario);
  const double fall = std::sqrt(scenario.grains.mean_diameter / gravity);
  // A product such as 0.001 / 100 may differ from 1e-5 by rounding, and the ends of the range are included.
  constexpr double round_off = 1e-12;
  if (h < shortest_time_step * (1.0 - round_off) || h > longest_time_step * (1.0 + round_off))
    broken.push_back(
        {{"tilt.step", "tilt.rate"},
         fmt::format("a time step h = tilt.step / tilt.rate in [{}, {}] s; it is {} s",
                     short_text(shortest_time_step), short_text(longest_time_step), short_text(h))});
  else if (h > longest_over_fall * fall * (1.0 + round_off))
    broken.push_back({{"grains.mean_diameter", "tilt.step", "tilt.rate"},
                      fmt::format("a time step h = tilt.step / tilt.rate of at most {} sqrt(D / g), or "
                                  "grains would fall past each other; it is {} sqrt(D / g)",
                                  short_text(longest_over_fall), short_text(h / fall))});
  const double grains = scenario.bed.length * scenario.bed.depth;
  const bool from_file = scenario.deposition.method == DepositionMethod::file;
  if (grains > max_grains && !from_file)
    broken.push_back({{"bed.length", "bed.depth"},
                      fmt::format("at most {} grains, bed.length * bed.depth; they are {}",
                                  short_text(max_grains), short_text(grains))});
  if (from_file && scenario.deposition.file.empty())
    broken.push_back({{"deposition.method", "deposition.file"},
                      "deposition.file, the path of a run or of a table, with it; it is not given"});
  if (!from_file && !scenario.deposition.file.empty())
    broken.push_back(
        {{"deposition.file", "deposition.method"}, "deposition.method = \"file\" with it, or no file"});
  if (scenario.tilt.end_angle && *scenario.tilt.end_angle < scenario.tilt.step)
    broken.push_back({{"tilt.end_angle", "tilt.step"},
                      fmt::format("tilt.end_angle >= tilt.step; they are {} and {} deg",
                                  short_text(*scenario.tilt.end_angle), short_text(scenario.tilt.step))});
  // Steps can only be counted with a valid time step.
  if (broken.empty())
    if (std::string fault = program_fault(scenario); !fault.empty())
      broken.push_back({{"tilt.program", "tilt.end_angle"}, std::move(fault)});
  if (scenario.solver.moving_tolerance < scenario.solver.tolerance)
    broken.push_back(
        {{"solver.moving_tolerance", "solver.tolerance"},
         fmt::format("solver.moving_tolerance >= solver.tolerance; they are {} and {}",
                     short_text(scenario.solver.moving_tolerance), short_text(scenario.solver.tolerance))});
  const auto at_least_a_step = [&](const std::string& key, double every) {
    if (every < scenario.tilt.step)
      broken.push_back({{key, "tilt.step"},
                        fmt::format("{} >= tilt.step; they are {} and {} deg", key, short_text(every),
                                    short_text(scenario.tilt.step))});
  };
  at_least_a_step("output.frame_every", scenario.output.frame_every);
  at_least_a_step("output.observable_every", scenario.output.observable_every);
  return broken;
}

}  // namespace talus::scenario
