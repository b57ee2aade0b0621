/// A scenario that is written and read back is bit-identical.

#include <gtest/gtest.h>

#include <cfloat>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "scenario/keys.h"
#include "scenario/text.h"

namespace talus::scenario {
namespace {

Scenario read_back(const Scenario& scenario) { return parse_scenario(resolved_toml(scenario), "resolved"); }

/// Returns a value in the range of the key that differs from its default.
KeyValue other_value(const ScenarioKey& key) {
  if (const auto* choices = std::get_if<Choices>(&key.range)) return choices->names.back();
  if (std::holds_alternative<IntegerRange>(key.range)) return std::int64_t{3};
  if (std::holds_alternative<Switch>(key.range)) return true;
  if (std::holds_alternative<TextRange>(key.range)) return std::string("beds/dense.csv");
  if (std::holds_alternative<PhraseList>(key.range)) return std::vector<std::string>{"to 3", "hold 1"};
  const auto& range = std::get<NumberRange>(key.range);
  const double high = std::isinf(range.high) ? 5.0 : range.high;
  return range.low + (high - range.low) / 3.0;
}

TEST(ResolvedScenario, has_every_key_with_unit_and_meaning) {
  const std::string text = resolved_toml({});
  for (const ScenarioKey& key : scenario_keys()) {
    EXPECT_NE(text.find(key.name + " = "), std::string::npos) << key.name;
    EXPECT_NE(text.find("# " + (key.unit.empty() ? "" : key.unit + "; ") + key.help), std::string::npos);
  }
  EXPECT_NE(text.find("density = 2500.0"), std::string::npos);
}

TEST(ResolvedScenario, reads_back_the_default) { EXPECT_EQ(read_back({}), Scenario{}); }

TEST(ScenarioKeys, each_sets_its_own_field_only) {
  for (const ScenarioKey& key : scenario_keys()) {
    Scenario scenario;
    key.set(scenario, other_value(key));
    for (const ScenarioKey& other : scenario_keys())
      EXPECT_EQ(other.get(scenario), &other == &key ? other_value(key) : other.get(Scenario{}))
          << full_name(key) << " and " << full_name(other);
  }
}

/// Returns a scenario in which all fields differ from their defaults. A field added to Scenario breaks the
/// compilation of this function: it requires a key, and a value here.
Scenario all_fields_changed() {
  Scenario scenario;
  auto& [seed, grains, contact, bed, deposition, tilt, solver, output, guards, commands] = scenario;
  seed = std::numeric_limits<std::int64_t>::max();
  auto& [mean_diameter, size_ratio, density] = grains;
  mean_diameter = 0.1 + 0.2;
  size_ratio = std::nextafter(1.0, 2.0);
  density = 1e6;
  auto& [friction, wall_friction, rolling_friction, restitution, tangential_restitution] = contact;
  friction = DBL_TRUE_MIN;
  wall_friction = 1e-300;
  rolling_friction = 0.1 / 3.0;
  restitution = 1.0 / 3.0;
  tangential_restitution = -2.0 / 3.0;
  auto& [boundary, length, depth, floor] = bed;
  boundary = BedBoundary::walls;
  length = 123456.7 / 1e2;
  depth = 17.0;
  floor = BedFloor::smooth;
  auto& [method, arrival_speed, deposition_rate, critical_angle, sites, file, file_unit, file_scale,
         deposition_frame, relax, fraction, deposition_friction, deposition_wall_friction, rest_velocity,
         max_time] = deposition;
  method = DepositionMethod::file;
  arrival_speed = 0.1;
  deposition_rate = 10.0 / 3.0;
  critical_angle = std::nextafter(90.0, 0.0);
  sites = 1000;
  file = "a \"quoted\" name\\with\ttab, \n line, \x1b and \x7f, \xc3\xa9 # [x] = 'y'";
  file_unit = LengthUnit::micrometre;
  file_scale = 1e-3 / 3.0;
  deposition_frame = 1'000'000'000;
  relax = true;
  fraction = 0.123456789012345678;
  deposition_friction = -0.0;
  deposition_wall_friction = 0.0;
  rest_velocity = DBL_MIN;
  max_time = 3600.0;
  auto& [rate, step, end_angle, program, after_failure, lowering_rate] = tilt;
  rate = 0.7;
  step = 0.0007;
  end_angle = std::nextafter(60.0, 0.0);
  program = {"to 12 at 0.25", "by -0.1", "hold 1e-3 s", "7 times", "to repose"};
  after_failure = AfterFailure::lower;
  lowering_rate = 0.03;
  auto& [solver_method, tolerance, moving_tolerance, max_iterations, allowed_overlap, overlap_correction] =
      solver;
  solver_method = SolverMethod::gauss_seidel;
  tolerance = 1e-12;
  moving_tolerance = 1e-2;
  max_iterations = 10'000'000;
  allowed_overlap = 1e-3;
  overlap_correction = 1e-7;
  auto& [frame_every, observable_every, checkpoint_every] = output;
  frame_every = 0.1;
  observable_every = 1e-3;
  checkpoint_every = 86400.0;
  auto& [action, velocity, overlap, energy, unconverged] = guards;
  action = GuardAction::warn;
  velocity = DBL_MAX;
  overlap = DBL_MIN;
  energy = 1.0 / 7.0;
  unconverged = 999'999'999;
  commands = {{-0.1, std::nullopt, CommandKind::push, 1'999'999, -1e-300, 1.0 / 3.0},
              {std::nullopt, 0.0, CommandKind::drop, 1000, 0.0, 0.0},
              {60.0, std::nullopt, CommandKind::friction, -1, 10.0, 0.0},
              {0.0, std::nullopt, CommandKind::tilt_rate, -1, DBL_TRUE_MIN, 0.0},
              {std::nullopt, 1e6, CommandKind::drag, 7, -1e9, 1e9},
              {0.1 + 0.2, std::nullopt, CommandKind::release, -1, 0.0, 0.0}};
  return scenario;
}

TEST(ResolvedScenario, reads_back_extreme_values) {
  const Scenario all = all_fields_changed();
  for (const ScenarioKey& key : scenario_keys())
    EXPECT_NE(key.get(all), key.get(Scenario{})) << full_name(key) << " sets no field";
  // A scenario can have only one of these.
  Scenario with_end = all, with_program = all;
  with_end.tilt.program.clear();
  with_program.tilt.end_angle.reset();
  for (const Scenario& scenario : {with_end, with_program}) {
    EXPECT_EQ(read_back(scenario), scenario);
    EXPECT_TRUE(std::signbit(*read_back(scenario).deposition.friction));
  }
}

TEST(ShortText, is_short_and_exact) {
  EXPECT_EQ(short_text(0.0), "0");
  EXPECT_EQ(short_text(0.001), "0.001");
  EXPECT_EQ(short_text(100000.0), "100000");
  EXPECT_EQ(short_text(1e-6), "1e-06");
  EXPECT_EQ(short_text(-1e22), "-1e+22");
  for (double value : {0.1 + 0.2, 1.0 / 3.0, DBL_MAX, DBL_TRUE_MIN, 9999999.999999998, 1.0000000000000002e-4})
    EXPECT_EQ(std::strtod(short_text(value).c_str(), nullptr), value);
}

TEST(TomlText, of_a_number_is_no_integer) {
  EXPECT_EQ(toml_text(200.0), "200.0");
  EXPECT_EQ(toml_text(1e22), "1e+22");
  EXPECT_EQ(toml_text(-0.0), "-0.0");
  EXPECT_EQ(toml_text(std::int64_t{7}), "7");
  EXPECT_EQ(toml_text(std::string("walls")), "\"walls\"");
}

TEST(TomlText, of_text_has_its_escapes) {
  EXPECT_EQ(toml_text(std::string()), "\"\"");
  EXPECT_EQ(toml_text(std::string("a \"b\" \\c")), R"("a \"b\" \\c")");
  EXPECT_EQ(toml_text(std::string("\t\n\x1f\x7f")), R"("\u0009\u000a\u001f\u007f")");
  EXPECT_EQ(toml_text(std::string("caf\xc3\xa9 #1")), "\"caf\xc3\xa9 #1\"");
}

}  // namespace
}  // namespace talus::scenario
