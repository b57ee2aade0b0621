/// Reading scenarios: values, settings on the command line, files.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <limits>
#include <sstream>

#include "base/errors.h"
#include "scenario/keys.h"
#include "scenario/scenario.h"
#include "scenario/text.h"
#include "support/exit_code.h"
#include "support/has.h"
#include "support/places.h"
#include "support/process.h"

namespace talus::scenario {
namespace {

/// Returns the message with which `read` fails; empty if it does not fail.
std::string message_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return test::message_of([&] { parse_scenario(text, "s.toml", overrides); });
}

TEST(ReadScenario, an_empty_file_is_the_default) { EXPECT_EQ(parse_scenario("", "s.toml"), Scenario{}); }

TEST(ReadScenario, the_default_breaks_no_rule) { EXPECT_TRUE(broken_rules(Scenario{}).empty()); }

TEST(ReadScenario, sets_the_fields_it_names) {
  const Scenario s = parse_scenario(
      "seed = 9223372036854775807\ncontact = { friction = 1 }\nbed.boundary = 'walls'\n"
      "[tilt]\nend_angle = 12.5\n[solver]\nmethod = \"gauss-seidel\"\nmax_iterations = 1_000\n",
      "s.toml");
  Scenario expected;
  expected.seed = 9223372036854775807u;
  expected.contact.friction = 1.0;
  expected.bed.boundary = BedBoundary::walls;
  expected.tilt.end_angle = 12.5;
  expected.solver.method = SolverMethod::gauss_seidel;
  expected.solver.max_iterations = 1000;
  EXPECT_EQ(s, expected);
}

TEST(ReadScenario, the_ends_of_a_range_belong_to_it) {
  EXPECT_EQ(message_of("[contact]\nfriction = 0\nrestitution = 1\ntangential_restitution = -1\n"), "");
  // Time steps at the ends of their range, except for round-off.
  EXPECT_EQ(message_of("[tilt]\nrate = 0.1\nstep = 1e-6\n"), "");
  EXPECT_EQ(message_of("[tilt]\nrate = 4.1\nstep = 0.041\n[output]\nobservable_every = 1\n"), "");
  EXPECT_EQ(message_of("[bed]\nlength = 10\n"), "");
}

/// Returns the numbers just outside of a range, as a scenario has them.
std::vector<std::string> numbers_beyond(const KeyRange& range) {
  std::vector<std::string> beyond;
  if (const auto* numbers = std::get_if<NumberRange>(&range)) {
    const double infinity = std::numeric_limits<double>::infinity();
    const double low = numbers->low_included ? std::nextafter(numbers->low, -infinity) : numbers->low;
    for (const double number : {low, std::nextafter(numbers->high, infinity)})
      if (std::isfinite(number)) beyond.push_back(toml_text(number));
  } else if (const auto* integers = std::get_if<IntegerRange>(&range)) {
    beyond.push_back(toml_text(integers->low - 1));
    if (integers->high < std::numeric_limits<std::int64_t>::max())
      beyond.push_back(toml_text(integers->high + 1));
  }
  return beyond;
}

TEST(ReadScenario, every_key_refuses_what_it_cannot_be) {
  for (const ScenarioKey& key : scenario_keys()) {
    const std::string name = full_name(key);
    std::vector<std::string> values = numbers_beyond(key.range);
    for (const char* value :
         {"nan", "inf", "-inf", "true", "[]", "{}", "1979-05-27", "\"no such word\"", "-1e300"})
      values.push_back(value);
    for (const std::string& value : values) {
      if (value.front() == '"' && std::holds_alternative<TextRange>(key.range)) continue;
      if (value == "true" && std::holds_alternative<Switch>(key.range)) continue;
      const std::string head = key.section.empty() ? "" : "[" + key.section + "]\n";
      const std::string message = message_of(head + key.name + " = " + value);
      EXPECT_TRUE(message.starts_with(
          fmt::format("s.toml:{}:{}: error: key '{}'", head.empty() ? 1 : 2, key.name.size() + 4, name)))
          << message;
      EXPECT_TRUE(test::has(message, ": expected " + expectation(key)));
      EXPECT_TRUE(test::has(message_of("", {name + "=" + value}), " error: key '" + name))
          << name << " = " << value;
    }
  }
}

TEST(BadScenarios, are_refused_with_the_message_beside_them) {
  std::size_t count = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(test::source_folder() + "/tests/scenarios/bad")) {
    std::filesystem::path path = entry.path();
    if (path.extension() != ".toml") continue;
    const std::string name = path.filename();
    const std::string message = test::message_of([&] { parse_scenario(test::text_of(path), name); });
    EXPECT_EQ(message + "\n", test::text_of(path.replace_extension(".expected"))) << name;
    ++count;
  }
  EXPECT_GE(count, 100u);
}

TEST(Settings, change_a_key) {
  const Scenario s = parse_scenario("[contact]\nfriction = 0.5\n", "s.toml",
                                    {"contact.friction=0.3", "seed=7", "solver.method=gauss-seidel",
                                     "bed.boundary=\"walls\"", "tilt.end_angle=5"});
  EXPECT_EQ(s.contact.friction, 0.3);
  EXPECT_EQ(s.seed, 7u);
  EXPECT_EQ(s.solver.method, SolverMethod::gauss_seidel);
  EXPECT_EQ(s.bed.boundary, BedBoundary::walls);
  EXPECT_EQ(s.tilt.end_angle, 5.0);
  EXPECT_EQ(parse_scenario("tilt.end_angle = 5", "s.toml", {"tilt.end_angle=repose"}).tilt.end_angle,
            std::nullopt);
}

TEST(Settings, of_text_need_no_quotes_where_they_are_no_toml) {
  const auto file_of = [](const std::string& setting) {
    return parse_scenario("[deposition]\nmethod = 'file'", "s.toml", {setting}).deposition.file;
  };
  EXPECT_EQ(file_of("deposition.file=beds/a b.csv"), "beds/a b.csv");
  EXPECT_EQ(file_of("deposition.file=../2024.h5"), "../2024.h5");
  EXPECT_EQ(file_of("deposition.file=bed"), "bed");
  EXPECT_EQ(file_of("deposition.file=\"2024\""), "2024");
  EXPECT_EQ(file_of("deposition.file='C:\\beds'"), "C:\\beds");
}

TEST(Rules, a_file_and_the_method_that_reads_it_come_together) {
  EXPECT_EQ(message_of("[deposition]\nmethod = 'file'\nfile = 'bed.csv'\n"), "");
  EXPECT_EQ(message_of("[deposition]\nfile = ''\n"), "");
  // A bed file determines the number of grains, whatever depth the scenario specifies.
  EXPECT_EQ(message_of("[bed]\nlength = 1e5\n[deposition]\nmethod = 'file'\nfile = 'bed.csv'\n"), "");
}

TEST(Settings, replace_what_the_file_says_even_where_that_is_wrong) {
  EXPECT_EQ(message_of("[contact]\nfriction = -3\n", {"contact.friction=0.3"}), "");
}

TEST(Settings, go_through_the_same_checks) {
  EXPECT_EQ(message_of("", {"contact.friction=abc"}),
            "--set contact.friction=abc: error: key 'contact.friction' = \"abc\": expected a number in "
            "[0, 10], found a string");
  EXPECT_EQ(message_of("", {"contact.fricton=1"}),
            "--set contact.fricton=1: error: unknown key 'contact.fricton'; did you mean "
            "'contact.friction'?");
  EXPECT_EQ(message_of("", {"contacts.friction=1"}),
            "--set contacts.friction=1: error: unknown section [contacts]; did you mean 'contact'?");
  EXPECT_EQ(message_of("", {"seed=1", "seed=2"}),
            "--set seed=2: error: key 'seed' is set twice on the command line; expected it once");
}

TEST(Settings, may_be_written_as_people_type_them) {
  const auto with = [](const std::string& setting) { return parse_scenario("", "s.toml", {setting}); };
  for (const char* form : {"contact.friction=.3", "contact.friction = 0.3", " contact.friction= 0.3 ",
                           "contact.friction=+.30", "contact.friction=3e-1"})
    EXPECT_EQ(with(form).contact.friction, 0.3) << form;
  EXPECT_EQ(with("contact.friction=1.").contact.friction, 1.0);
  for (const char* form : {"bed.length=20D", "bed.length=20 D", "bed.length=20."})
    EXPECT_EQ(with(form).bed.length, 20.0) << form;
  EXPECT_EQ(with("tilt.end_angle=5deg").tilt.end_angle, 5.0);
  for (const char* form : {"seed=7", "seed=007", "seed=7.0", "seed=+7", "seed=7e0"})
    EXPECT_EQ(with(form).seed, 7u) << form;
  EXPECT_EQ(with("solver.max_iterations=1e5").solver.max_iterations, 100000);
}

TEST(Settings, with_unknown_names_are_told_with_the_nearest_name_or_all_names) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"solver.MAX_ITERATIONS=9", "did you mean 'solver.max_iterations'?"},
      {"friction=0.3", "unknown key 'friction'; did you mean 'contact.friction' or 'deposition.friction'?"},
      {"bed.seed=0.3", "unknown key 'bed.seed'; did you mean 'seed'?"},
      {"tilt.seed=3", "unknown key 'tilt.seed'; did you mean 'seed'?"},
      {"tilt.speed=1", "; [tilt] has rate, step, end_angle, program, after_failure, lowering_rate"},
      {"tilt." + std::string(100000, 'r') + "=1", "; [tilt] has rate, step, "},
      {"viscosity=1", "; expected seed, or a section: [grains], [contact], "},
      {"magic.friction=1", "unknown section [magic]; expected one of [grains], [contact], [bed], "},
      {"bed.boundary=PERIODIC", "did you mean 'periodic'?"},
      {"bed.boundary=wall", "did you mean 'walls'?"},
      {"tilt.end_angle=Repose", "did you mean 'repose'?"},
  };
  for (const auto& [setting, meant] : cases) EXPECT_TRUE(test::has(message_of("", {setting}), meant));
}

TEST(Settings, that_are_none_are_refused) {
  for (const char* setting : {"", "=", "seed", "seed=", "=7"})
    EXPECT_TRUE(test::has(message_of("", {setting}), "expected section.key=value")) << setting;
  for (const char* value : {"[1,", "0.5\nseed=3", "\xff", "1e400", "0,5", "=0.3", "30%", "\"", "{"})
    EXPECT_TRUE(test::has(message_of("", {std::string("contact.friction=") + value}),
                          ": expected a number in [0, 10]"))
        << value;
  EXPECT_EQ(
      message_of("", {"seed=99999999999999999999"}),
      "--set seed=99999999999999999999: error: key 'seed' = 99999999999999999999: expected an integer in "
      "0 ... 9223372036854775807");
}

TEST(Settings, take_the_blame_for_a_rule_they_break) {
  EXPECT_EQ(message_of("[bed]\nlength = 200\n", {"bed.depth=10000"}), "");
  EXPECT_EQ(message_of("[bed]\nlength = 201\n", {"bed.depth=10000"}),
            "--set bed.depth=10000: error: key 'bed.depth' = 10000.0: expected at most 2000000 grains, "
            "bed.length * bed.depth; they are 2010000");
}

TEST(ScenarioErrors, come_in_the_order_of_the_file_and_settings_last) {
  const std::string message =
      message_of("[tilt]\nrate = -1\n[bed]\nlength = 5\ndepth = 'deep'\n[contact]\nfriction = -1\n",
                 {"grains.density=0", "seed=-1"});
  std::vector<std::string> places;
  for (std::size_t at = 0; at < message.size(); at = message.find('\n', at) + 1) {
    places.push_back(message.substr(at, message.find(": error:", at) - at));
    if (message.find('\n', at) == std::string::npos) break;
  }
  EXPECT_EQ(places, (std::vector<std::string>{"s.toml:2:8", "s.toml:4:10", "s.toml:5:9", "s.toml:7:12",
                                              "--set grains.density=0", "--set seed=-1"}));
}

TEST(ScenarioErrors, are_shown_up_to_a_hundred) {
  std::ostringstream text;
  text << "[contact]\n";
  for (int i = 0; i < 150; ++i) text << "x" << i << " = 1\n";
  const std::string message = message_of(text.str());
  EXPECT_EQ(std::ranges::count(message, '\n'), 100);
  EXPECT_TRUE(message.ends_with("\ns.toml: error: and 50 more")) << message;
}

TEST(ScenarioErrors, text_that_is_too_long_is_not_parsed) {
  const std::string message = message_of("# " + std::string(std::size_t{1} << 20, 'x'));
  EXPECT_EQ(message,
            "s.toml:1:1: error: the file is too large: expected a scenario of at most 1048576 bytes");
}

TEST(ScenarioErrors, a_packed_run_is_told_from_a_scenario) {
  EXPECT_TRUE(test::has(message_of("talus run file 1\nsize 12\n"), "this is not a scenario"));
}

TEST(ScenarioFile, a_missing_file_and_a_folder_are_missing_input) {
  for (const std::string& path : {std::string("no/such/file.toml"), test::source_folder()})
    EXPECT_TRUE(test::refuses([&] { read_scenario(path); }, ExitCode::missing_input, {path}));
}

TEST(ScenarioFile, gives_its_text_and_its_name_in_messages) {
  const std::string path = test::source_folder() + "/assets/scenarios/demo.toml";
  std::string text;
  const Scenario s = read_scenario(path, {}, &text);
  EXPECT_EQ(parse_scenario(text, path), s);
  EXPECT_EQ(text.size(), std::filesystem::file_size(path));
  const std::string bad = test::source_folder() + "/tests/scenarios/bad/seed_negative.toml";
  EXPECT_TRUE(test::message_of([&] { read_scenario(bad); }).starts_with(bad + ":1:8: error: "));
}

TEST(ReadScenario, a_device_that_holds_nothing_is_no_scenario_of_defaults) {
  EXPECT_TRUE(test::refuses([&] { read_scenario("/dev/null"); }, ExitCode::missing_input,
                            {"is an empty pipe or device"}));
}

}  // namespace
}  // namespace talus::scenario
