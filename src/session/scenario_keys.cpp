#include "session/scenario_keys.h"

#include <cmath>
#include <limits>

#include "session/scenario_text.h"

namespace talus {
namespace {

using Keys = std::vector<ScenarioKey>;

NumberRange from_to(double low, double high) { return {low, high, true, {}}; }
NumberRange from_to_or(double low, double high, std::string word) {
  return {low, high, true, std::move(word)};
}
NumberRange above_to(double low, double high) { return {low, high, false, {}}; }
NumberRange positive() { return above_to(0.0, std::numeric_limits<double>::infinity()); }

// In each of these `field` is a generic function from a scenario to a reference to one of its fields.

template <typename Field>
ScenarioKey number(std::string section, std::string name, std::string unit, NumberRange range,
                   std::string help, Field field) {
  return {section,
          name,
          unit,
          range,
          help,
          [field](const Scenario& s) { return ScenarioValue(field(s)); },
          [field](Scenario& s, const ScenarioValue& value) { field(s) = std::get<double>(value); }};
}

template <typename Field>
ScenarioKey number_or_word(std::string section, std::string name, std::string unit, NumberRange range,
                           std::string help, Field field) {
  const std::string word = range.word;
  return {section,
          name,
          unit,
          range,
          help,
          [field, word](const Scenario& s) { return field(s) ? ScenarioValue(*field(s)) : word; },
          [field](Scenario& s, const ScenarioValue& value) {
            field(s).reset();
            if (const double* given = std::get_if<double>(&value)) field(s) = *given;
          }};
}

template <typename Field>
ScenarioKey integer(std::string section, std::string name, IntegerRange range, std::string help,
                    Field field) {
  return {section,
          name,
          {},
          range,
          help,
          [field](const Scenario& s) { return ScenarioValue(static_cast<std::int64_t>(field(s))); },
          [field](Scenario& s, const ScenarioValue& value) {
            field(s) =
                static_cast<std::remove_reference_t<decltype(field(s))>>(std::get<std::int64_t>(value));
          }};
}

template <typename Field>
ScenarioKey text(std::string section, std::string name, TextRange range, std::string help, Field field) {
  return {section,
          name,
          {},
          range,
          help,
          [field](const Scenario& s) { return ScenarioValue(field(s)); },
          [field](Scenario& s, const ScenarioValue& value) { field(s) = std::get<std::string>(value); }};
}

template <typename Field>
ScenarioKey choice(std::string section, std::string name, Choices choices, std::string help, Field field) {
  const std::vector<std::string> names = choices.names;
  return {section,
          name,
          {},
          choices,
          help,
          [field, names](const Scenario& s) {
            return ScenarioValue(names.at(static_cast<std::size_t>(field(s))));
          },
          [field, names](Scenario& s, const ScenarioValue& value) {
            using Enumeration = std::remove_reference_t<decltype(field(s))>;
            for (std::size_t i = 0; i < names.size(); ++i)
              if (names[i] == std::get<std::string>(value)) field(s) = static_cast<Enumeration>(i);
          }};
}

void add_bed_keys(Keys& keys) {
  keys.push_back(integer(
      "", "seed", {0, std::numeric_limits<std::int64_t>::max()}, "seed of the random deposition",
      [](auto& s) -> auto& { return s.seed; }));

  keys.push_back(number(
      "grains", "mean_diameter", "m", from_to(1e-5, 10.0), "mean diameter D of the grains",
      [](auto& s) -> auto& { return s.grains.mean_diameter; }));
  keys.push_back(number(
      "grains", "size_ratio", "", from_to(1.0, 4.0),
      "largest over smallest diameter; diameters are uniform between them",
      [](auto& s) -> auto& { return s.grains.size_ratio; }));
  keys.push_back(number(
      "grains", "density", "kg/m^3", positive(), "density of the grains",
      [](auto& s) -> auto& { return s.grains.density; }));

  keys.push_back(number(
      "contact", "friction", "", from_to(0.0, 10.0),
      "coefficient of friction between grains, and of grains on the floor",
      [](auto& s) -> auto& { return s.contact.friction; }));
  keys.push_back(number(
      "contact", "wall_friction", "", from_to(0.0, 10.0),
      "coefficient of friction of grains on the side walls",
      [](auto& s) -> auto& { return s.contact.wall_friction; }));
  keys.push_back(number(
      "contact", "restitution", "", from_to(0.0, 1.0),
      "normal restitution: velocity after over velocity before an impact",
      [](auto& s) -> auto& { return s.contact.restitution; }));
  keys.push_back(number(
      "contact", "tangential_restitution", "", from_to(-1.0, 1.0),
      "the same of the tangential velocity of a contact that sticks",
      [](auto& s) -> auto& { return s.contact.tangential_restitution; }));

  keys.push_back(choice(
      "bed", "boundary", {{"periodic", "walls"}},
      "what bounds the bed along its length: itself, or two side walls",
      [](auto& s) -> auto& { return s.bed.boundary; }));
  keys.push_back(number(
      "bed", "length", "D", from_to(10.0, 1e5), "length L of the bed",
      [](auto& s) -> auto& { return s.bed.length; }));
  keys.push_back(number(
      "bed", "depth", "D", from_to(1.0, 1e4), "depth H of the bed; it has L H / D^2 grains, rounded",
      [](auto& s) -> auto& { return s.bed.depth; }));
  keys.push_back(choice(
      "bed", "floor", {{"rough", "smooth"}}, "grains of diameter D glued side by side, or a plane",
      [](auto& s) -> auto& { return s.bed.floor; }));
}

void add_deposition_keys(Keys& keys) {
  keys.push_back(choice(
      "deposition", "method", {{"pour", "geometric", "collapse", "file"}},
      "how the grains get into the bed: poured one after another, set down one after another, all at once, "
      "or as a file has them",
      [](auto& s) -> auto& { return s.deposition.method; }));
  keys.push_back(number(
      "deposition", "arrival_speed", "sqrt(g D)", from_to(0.0, 20.0),
      "pour: speed of a grain when it first touches",
      [](auto& s) -> auto& { return s.deposition.arrival_speed; }));
  keys.push_back(number(
      "deposition", "rate", "sqrt(g/D)", from_to(0.01, 10.0),
      "pour: layers, of L / D grains each, that arrive in sqrt(D / g)",
      [](auto& s) -> auto& { return s.deposition.rate; }));
  keys.push_back(number(
      "deposition", "critical_angle", "deg", from_to(0.0, 90.0),
      "geometric: a grain stays where it has fallen on another one at a contact normal up to this from the "
      "vertical; 0: it always rolls",
      [](auto& s) -> auto& { return s.deposition.critical_angle; }));
  keys.push_back(integer(
      "deposition", "sites", {1, 1000}, "geometric: places tried for each grain, of which the lowest is kept",
      [](auto& s) -> auto& { return s.deposition.sites; }));
  keys.push_back(text(
      "deposition", "file", {"the path of a file", 4095},
      "file: a run, or a table with x, y and radius of a grain in each line, in D; relative to the working "
      "directory",
      [](auto& s) -> auto& { return s.deposition.file; }));
  keys.push_back(integer(
      "deposition", "frame", {0, 1'000'000'000}, "file: number of the frame of a run, from 0",
      [](auto& s) -> auto& { return s.deposition.frame; }));
  keys.push_back(number(
      "deposition", "initial_solid_fraction", "", from_to(0.1, 0.7),
      "collapse: solid fraction of the loose arrangement; less where the size ratio needs room",
      [](auto& s) -> auto& { return s.deposition.initial_solid_fraction; }));
  keys.push_back(number_or_word(
      "deposition", "friction", "", from_to_or(0.0, 10.0, "contact"),
      "coefficient of friction between grains until the bed is at rest; \"contact\": contact.friction",
      [](auto& s) -> auto& { return s.deposition.friction; }));
  keys.push_back(number_or_word(
      "deposition", "wall_friction", "", from_to_or(0.0, 10.0, "contact"),
      "the same on the side walls; \"contact\": contact.wall_friction",
      [](auto& s) -> auto& { return s.deposition.wall_friction; }));
  keys.push_back(number(
      "deposition", "rest_velocity", "g h", above_to(0.0, 0.1),
      "the bed is at rest when its rms velocity stays below this",
      [](auto& s) -> auto& { return s.deposition.rest_velocity; }));
  keys.push_back(number(
      "deposition", "max_time", "s", above_to(0.0, 3600.0),
      "simulated time after the last arrival in which the bed has to come to rest",
      [](auto& s) -> auto& { return s.deposition.max_time; }));
}

void add_tilt_keys(Keys& keys) {
  keys.push_back(number(
      "tilt", "rate", "deg/s", from_to(1e-4, 100.0), "how fast the bed is tilted",
      [](auto& s) -> auto& { return s.tilt.rate; }));
  keys.push_back(number(
      "tilt", "step", "deg", from_to(1e-8, 1.0), "tilt in one time step h = step / rate",
      [](auto& s) -> auto& { return s.tilt.step; }));
  NumberRange end = above_to(0.0, 60.0);
  end.word = "repose";
  keys.push_back(number_or_word(
      "tilt", "end_angle", "deg", end, "tilt at which the run ends; \"repose\": when the slope has failed",
      [](auto& s) -> auto& { return s.tilt.end_angle; }));
  keys.push_back(choice(
      "tilt", "after_failure", {{"stop", "lower", "hold"}},
      "what follows failure: the end of the run, or a tilt that is lowered or kept until the flow has "
      "stopped",
      [](auto& s) -> auto& { return s.tilt.after_failure; }));
  keys.push_back(number(
      "tilt", "lowering_rate", "deg/s", from_to(1e-4, 100.0), "how fast the tilt is lowered after failure",
      [](auto& s) -> auto& { return s.tilt.lowering_rate; }));
}

void add_computing_keys(Keys& keys) {
  keys.push_back(choice(
      "solver", "method", {{"accelerated", "gauss-seidel"}},
      "projected gradient with momentum, or the slow reference",
      [](auto& s) -> auto& { return s.solver.method; }));
  keys.push_back(number(
      "solver", "tolerance", "", from_to(1e-12, 1e-2),
      "natural-map residual to reach in a step of a bed at rest",
      [](auto& s) -> auto& { return s.solver.tolerance; }));
  keys.push_back(number(
      "solver", "moving_tolerance", "", from_to(1e-12, 1e-2),
      "the same at an rms velocity of g h or more; in proportion to the velocity below it",
      [](auto& s) -> auto& { return s.solver.moving_tolerance; }));
  keys.push_back(integer(
      "solver", "max_iterations", {1, 10'000'000},
      "passes over all contacts after which a step is left as it is",
      [](auto& s) -> auto& { return s.solver.max_iterations; }));
  keys.push_back(number(
      "solver", "allowed_overlap", "D", from_to(0.0, 0.01), "overlaps up to this stay as they are",
      [](auto& s) -> auto& { return s.solver.allowed_overlap; }));
  keys.push_back(number(
      "solver", "overlap_correction", "", from_to(0.0, 1.0),
      "share of what an overlap is above the allowed, taken back in each step",
      [](auto& s) -> auto& { return s.solver.overlap_correction; }));

  keys.push_back(number(
      "output", "frame_every", "deg", above_to(0.0, 60.0), "tilt between frames (the whole bed)",
      [](auto& s) -> auto& { return s.output.frame_every; }));
  keys.push_back(number(
      "output", "observable_every", "deg", above_to(0.0, 60.0),
      "tilt between rows of observables (scalars of the bed)",
      [](auto& s) -> auto& { return s.output.observable_every; }));
  keys.push_back(number(
      "output", "checkpoint_every", "s", from_to(0.0, 86400.0),
      "wall time between checkpoints; 0: after each step",
      [](auto& s) -> auto& { return s.output.checkpoint_every; }));
}

void add_guard_keys(Keys& keys) {
  keys.push_back(choice(
      "guards", "action", {{"stop", "warn"}},
      "what follows when a run does what none should: it stops, or goes on with a recorded warning",
      [](auto& s) -> auto& { return s.guards.action; }));
  keys.push_back(number(
      "guards", "velocity", "sqrt(g D)", positive(), "largest velocity of a grain",
      [](auto& s) -> auto& { return s.guards.velocity; }));
  keys.push_back(number(
      "guards", "overlap", "D", positive(), "largest overlap of two grains",
      [](auto& s) -> auto& { return s.guards.overlap; }));
  keys.push_back(number(
      "guards", "energy", "m g H", positive(), "largest kinetic energy of a grain in the mean",
      [](auto& s) -> auto& { return s.guards.energy; }));
  keys.push_back(integer(
      "guards", "unconverged", {1, 1'000'000'000}, "most steps in a row that miss their tolerance",
      [](auto& s) -> auto& { return s.guards.unconverged; }));
}

Keys make_keys() {
  Keys keys;
  add_bed_keys(keys);
  add_deposition_keys(keys);
  add_tilt_keys(keys);
  add_computing_keys(keys);
  add_guard_keys(keys);
  return keys;
}

std::string text_of(const NumberRange& range) {
  const std::string low = short_text(range.low);
  const std::string numbers = std::isinf(range.high)
                                  ? "a finite number " + std::string(range.low_included ? ">= " : "> ") + low
                                  : "a number in " + std::string(range.low_included ? "[" : "(") + low +
                                        ", " + short_text(range.high) + "]";
  return range.word.empty() ? numbers : numbers + " or \"" + range.word + "\"";
}

std::string text_of(const IntegerRange& range) {
  return "an integer in " + std::to_string(range.low) + " ... " + std::to_string(range.high);
}

std::string text_of(const Choices& choices) {
  std::string text;
  for (const std::string& name : choices.names) text += (text.empty() ? "\"" : " or \"") + name + "\"";
  return text;
}

std::string text_of(const TextRange& range) {
  return range.what + " in quotes (at most " + std::to_string(range.longest) +
         " bytes, none of them zero), or \"\" for none";
}

std::optional<ScenarioValue> admitted_by(const NumberRange& range, const ScenarioValue& value) {
  if (const std::string* word = std::get_if<std::string>(&value))
    return !range.word.empty() && *word == range.word ? std::optional(value) : std::nullopt;
  const std::int64_t* whole = std::get_if<std::int64_t>(&value);
  const double number = whole != nullptr ? static_cast<double>(*whole) : std::get<double>(value);
  const bool above = range.low_included ? number >= range.low : number > range.low;
  return std::isfinite(number) && above && number <= range.high ? std::optional<ScenarioValue>(number)
                                                                : std::nullopt;
}

std::optional<ScenarioValue> admitted_by(const IntegerRange& range, const ScenarioValue& value) {
  const std::int64_t* whole = std::get_if<std::int64_t>(&value);
  return whole != nullptr && *whole >= range.low && *whole <= range.high ? std::optional(value)
                                                                         : std::nullopt;
}

std::optional<ScenarioValue> admitted_by(const Choices& choices, const ScenarioValue& value) {
  for (const std::string& name : choices.names)
    if (value == ScenarioValue(name)) return value;
  return std::nullopt;
}

std::optional<ScenarioValue> admitted_by(const TextRange& range, const ScenarioValue& value) {
  const std::string* text = std::get_if<std::string>(&value);
  return text != nullptr && text->size() <= range.longest && text->find('\0') == std::string::npos
             ? std::optional(value)
             : std::nullopt;
}

}  // namespace

const std::vector<ScenarioKey>& scenario_keys() {
  static const Keys keys = make_keys();
  return keys;
}

const ScenarioKey* find_key(std::string_view wanted) {
  for (const ScenarioKey& key : scenario_keys())
    if (full_name(key) == wanted) return &key;
  return nullptr;
}

std::string full_name(const ScenarioKey& key) {
  return key.section.empty() ? key.name : key.section + "." + key.name;
}

std::string range_text(const ScenarioKey& key) {
  return std::visit([](const auto& range) { return text_of(range); }, key.range);
}

std::string expectation(const ScenarioKey& key) {
  return range_text(key) + (key.unit.empty() ? "" : ", in " + key.unit);
}

std::optional<ScenarioValue> admitted(const ScenarioKey& key, const ScenarioValue& value) {
  return std::visit([&value](const auto& range) { return admitted_by(range, value); }, key.range);
}

}  // namespace talus
