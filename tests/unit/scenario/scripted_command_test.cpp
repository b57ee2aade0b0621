/// [[command]]: reading, settings, and writing. tests/scenarios/bad has the rejected ones.

#include "scenario/scripted_command.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "scenario/keys.h"

namespace talus::scenario {
namespace {

const char* const commands =
    "[bed]\nlength = 10\ndepth = 3\n[[command]]\nat = 12\nkind = 'push'\ngrain = 7\ny = 0.5\n"
    "[[command]]\ntime = 2.5\nkind = 'friction'\nx = 0.3\n";

std::string message_of_settings(const std::vector<std::string>& settings) {
  try {
    parse_scenario(commands, "s.toml", settings);
  } catch (const LocatedError& error) {
    return error.what();
  }
  return "accepted";
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
