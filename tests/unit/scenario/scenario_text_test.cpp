/// Texts of scenarios: written, documented, and with commands.

#include <gtest/gtest.h>

#include <cfloat>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>

#include "scenario/keys.h"
#include "scenario/scripted_command.h"
#include "scenario/text.h"
#include "support/exit_code.h"
#include "support/has.h"
#include "support/key_rows.h"
#include "support/places.h"

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
    EXPECT_TRUE(test::has(text, key.name + " = ")) << key.name;
    EXPECT_TRUE(test::has(text, "# " + (key.unit.empty() ? "" : key.unit + "; ") + key.help));
  }
  EXPECT_TRUE(test::has(text, "density = 2500.0"));
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

TEST(ScenarioKeys, are_documented_as_they_are) {
  std::string expected;
  for (const ScenarioKey& key : scenario_keys()) expected += row_text(key, toml_text(key.get(Scenario{})));
  for (const CommandKey& key : command_keys()) {
    std::string row = row_text(key, "-");
    expected += row.replace(row.find("`-`"), 3, "-");  // none of them has a default
  }
  EXPECT_EQ(rows_of("docs/scenario.md"), expected) << "the table of docs/scenario.md must be:\n" << expected;
}

TEST(ScenarioKeys, stand_once_and_admit_their_defaults) {
  std::set<std::string> names;
  for (const ScenarioKey& key : scenario_keys()) {
    EXPECT_TRUE(names.insert(full_name(key)).second) << full_name(key);
    EXPECT_EQ(find_key(full_name(key)), &key);
    EXPECT_EQ(admitted(key, key.get(Scenario{})), key.get(Scenario{})) << full_name(key);
  }
}

Scenario asset(const std::string& name) {
  return read_scenario(test::source_folder() + "/assets/scenarios/" + name);
}

/// Returns a bed with mu = 0.5, size ratio 1.5, no restitution, H = 40 D, rough floor, 1 deg/s, 0.001 deg per
/// step, run to repose.
Scenario paper_bed(BedBoundary boundary, double length) {
  Scenario scenario;
  scenario.grains.size_ratio = 1.5;
  scenario.contact = {.friction = 0.5,
                      .wall_friction = 0.5,
                      .rolling_friction = 0.0,
                      .restitution = 0.0,
                      .tangential_restitution = 0.0};
  scenario.bed = {.boundary = boundary, .length = length, .depth = 40.0, .floor = BedFloor::rough};
  scenario.tilt = {.rate = 1.0, .step = 0.001, .end_angle = std::nullopt, .program = {}};
  return scenario;
}

TEST(Assets, have_the_values_of_the_paper) {
  EXPECT_EQ(asset("paper-pbc.toml"), paper_bed(BedBoundary::periodic, 200.0));
  for (int length : {100, 150, 200, 250, 300})
    EXPECT_EQ(asset("paper-wbc-" + std::to_string(length) + ".toml"), paper_bed(BedBoundary::walls, length));
}

TEST(Assets, have_a_small_demo) {
  Scenario expected = paper_bed(BedBoundary::periodic, 50.0);
  expected.bed.depth = 20.0;
  EXPECT_EQ(asset("demo.toml"), expected);
  expected.tilt.after_failure = AfterFailure::lower;
  EXPECT_EQ(asset("dynamic-angle.toml"), expected) << "the same bed, lowered after failure";
  expected.tilt.after_failure = AfterFailure::stop;
  expected.tilt.program = {"to 12", "to 0", "10 times", "to repose"};
  expected.output.frame_every = 0.5;
  EXPECT_EQ(asset("cycles.toml"), expected) << "the same bed, in cycles";
}

const char* const commands =
    "[bed]\nlength = 10\ndepth = 3\n[[command]]\nat = 12\nkind = 'push'\ngrain = 7\ny = 0.5\n"
    "[[command]]\ntime = 2.5\nkind = 'friction'\nx = 0.3\n";

std::string message_of_settings(const std::vector<std::string>& settings) {
  return test::message_of([&] { parse_scenario(commands, "s.toml", settings); });
}

TEST(ScriptedCommands, are_read_in_their_order) {
  const Scenario scenario = parse_scenario(commands, "s.toml");
  const std::vector<ScriptedCommand> expected = {{12.0, {}, CommandKind::push, 7, 0.0, 0.5},
                                                 {{}, 2.5, CommandKind::friction, -1, 0.3, 0.0}};
  EXPECT_EQ(scenario.commands, expected);
  EXPECT_EQ(parse_scenario(resolved_toml(scenario), "resolved"), scenario);
  EXPECT_EQ(moment_text(expected[0]), "at 12 deg");
  EXPECT_EQ(moment_text(expected[1]), "2.5 s after the tilt began");
}

TEST(ScriptedCommands, are_changed_by_settings) {
  const Scenario scenario = parse_scenario(commands, "s.toml", {"command.2.x=0.4", "command.1.at = 13 deg"},
                                           {"command.1.grain=29"});
  EXPECT_EQ(scenario.commands[1].x, 0.4);
  EXPECT_EQ(scenario.commands[0].at, 13.0);
  EXPECT_EQ(scenario.commands[0].grain, 29);
  EXPECT_EQ(value_text(scenario, "command.1.at"), "13");
  EXPECT_EQ(value_text(scenario, "command.3.at"), "none");
  const Scenario later = parse_scenario(commands, "s.toml", {"command.1.at=none", "command.1.time=1"});
  EXPECT_EQ(later.commands[0].at, std::nullopt);
  EXPECT_EQ(later.commands[0].time, 1.0);
}

TEST(ScriptedCommands, refuse_settings_of_commands_that_are_not_there) {
  const std::string none =
      "': expected command.N.KEY with N from 1 to the number of [[command]] tables of the scenario, and KEY "
      "one of at, time, kind, grain, x and y";
  for (const std::string name : {"command.3.at", "command.0.at", "command.x"})
    EXPECT_EQ(message_of_settings({name + "=1"}), "--set " + name + "=1: error: unknown key '" + name + none);
  EXPECT_EQ(message_of_settings({"command.2.x=12"}),
            "s.toml:9:1: error: command.2 is \"friction\" with coefficient 12, expected 0 ... 10");
  EXPECT_EQ(
      message_of_settings({"command.1.grain=-1"}),
      "--set command.1.grain=-1: error: key 'command.1.grain' = -1: expected an integer in 0 ... 2000000");
}

TEST(ScriptedCommands, are_told_where_scenarios_differ) {
  const Scenario one = parse_scenario(commands, "s.toml"),
                 none = parse_scenario("bed.length = 10\nbed.depth = 3", "s.toml");
  EXPECT_EQ(differences(one, parse_scenario(commands, "s.toml", {"command.2.x=0.4"})),
            "command.2.x is 0.3 there, 0.4 here");
  EXPECT_TRUE(differences(one, none).starts_with("command.1.at is 12 there, none here; "));
  EXPECT_TRUE(differences(none, one).starts_with("command.1.at is none there, 12 here; "));
}

TEST(ScriptedCommands, are_at_most_a_thousand) {
  std::string text;
  for (int k = 0; k < 1000; ++k) text += "[[command]]\nat = 1\nkind = 'release'\n";
  EXPECT_EQ(parse_scenario(text, "s.toml").commands.size(), 1000u);
  EXPECT_THROW(parse_scenario(text + "[[command]]\nat = 1\nkind = 'release'\n", "s.toml"), LocatedError);
}

}  // namespace
}  // namespace talus::scenario
