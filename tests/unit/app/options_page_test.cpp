/// docs/options.md lists the commands that share an option, as the parser has them, and shared options have
/// the same meaning everywhere.

#include <gtest/gtest.h>

#include <algorithm>
#include <fmt/core.h>
#include <map>
#include <set>

#include "app/commands.h"
#include "app/help_text.h"
#include "app/map_options.h"
#include "base/text.h"
#include "support/has.h"
#include "support/places.h"
#include "support/process.h"

namespace talus::app {
namespace {

struct SharedOption {
  std::vector<std::string> commands;
  std::set<std::string> values;
};

/// `name`: that of the command without the program, empty for the program itself.
void collect(const CLI::App& app, const std::string& name, std::map<std::string, SharedOption>& options) {
  for (const CLI::Option* option : visible_options(app)) {
    if (name.empty() || option->get_positional() || option == app.get_help_ptr()) continue;
    SharedOption& shared = options["--" + option->get_lnames().back()];
    shared.commands.push_back(name);
    std::string value = value_text(*option);
    if (value.starts_with('{')) {
      value = value.substr(1, value.size() - 2);
      std::ranges::replace(value, ',', '|');
    }
    shared.values.insert(value);
  }
  for (const CLI::App* command : visible_commands(app))
    collect(*command, name + (name.empty() ? "" : " ") + command->get_name(), options);
}

/// Returns the options that at least two commands have.
std::map<std::string, SharedOption> shared_options() {
  CLI::App app;
  add_commands(app);
  std::map<std::string, SharedOption> options;
  collect(app, "", options);
  std::erase_if(options, [](const auto& option) { return option.second.commands.size() < 2; });
  return options;
}

std::string table_of(const std::map<std::string, SharedOption>& options) {
  std::string table = "| option | commands |\n|---|---|\n";
  for (const auto& [name, shared] : options) {
    std::string head = name;
    for (const std::string& value : shared.values)
      if (!value.empty()) head += (head == name ? " " : " or ") + value;
    for (std::size_t bar = head.find('|'); bar != std::string::npos; bar = head.find('|', bar + 2))
      head.insert(bar, 1, '\\');  // an unescaped bar would end the cell
    table += fmt::format("| `{}` | {} |\n", head, joined(shared.commands, ", "));
  }
  return table;
}

TEST(OptionsPage, has_the_table_of_the_parser) {
  if (!has_window) GTEST_SKIP() << "built without talus view";
  const std::string page = test::text_of(test::source_folder() + "/docs/options.md"),
                    table = table_of(shared_options());
  EXPECT_TRUE(test::has(page, table)) << "docs/options.md must have this table";
}

/// Returns the number of options of a command and of those below it. Options of maps, which have one page,
/// are collected in `maps`, so that each counts once.
std::size_t count_options(const CLI::App& app, std::set<std::string>& maps) {
  std::size_t count = 0;
  for (const CLI::Option* option : visible_options(app)) {
    if (option->get_positional() || option == app.get_help_ptr()) continue;
    if (option->get_group() == map_group)
      maps.insert(option->get_name());
    else
      ++count;
  }
  for (const CLI::App* command : visible_commands(app)) count += count_options(*command, maps);
  return count;
}

/// An option more needs a reason, and another that goes.
TEST(OptionsPage, options_are_few) {
  if (!has_window) GTEST_SKIP() << "built without talus view";
  CLI::App app;
  add_commands(app);
  std::set<std::string> maps;
  const std::size_t count = count_options(app, maps);
  EXPECT_LE(count + maps.size(), 150u);
}

/// A frame, a size or a key has the same syntax everywhere.
TEST(OptionsPage, shared_options_have_one_kind_of_value) {
  const std::map<std::string, SharedOption> options = shared_options();
  const std::map<std::string, std::set<std::string>> kinds = {
      {"--at", {"DEG,...", "DEG"}},  // several frames, or one
      {"--size", {"SIZE"}},
      {"--set", {"KEY=VALUE"}},
      {"--every", {"DEG"}}};
  for (const auto& [name, values] : kinds) {
    ASSERT_TRUE(options.contains(name)) << name;
    EXPECT_EQ(options.at(name).values, values) << name;
  }
}

}  // namespace
}  // namespace talus::app
