/// Misspelt commands, options and values; the help; the list of maps.

#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <sstream>

#include "support/process.h"

namespace talus::test {
namespace {

using Words = std::vector<std::string>;

class TypedWords : public testing::Test {
 protected:
  Outcome talus(const Words& words) { return run_talus(words, folder_.path()); }

  /// Expects a usage error of one line that contains `part`.
  void expect_refused(const Words& words, const std::string& part) {
    const Outcome outcome = talus(words);
    EXPECT_EQ(outcome.exit_code, 64) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("talus: error: ")) << outcome.err;
    EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << part << "\n" << outcome.err;
  }

  TemporaryFolder folder_;
};

/// Returns the names at the beginning of the lines below a heading: "
/// Runs:
///  run ...".
Words names_below(const std::string& help, const std::string& heading) {
  std::istringstream lines(help.substr(std::min(help.find("\n" + heading), help.size())));
  Words names;
  std::string line;
  std::getline(lines, line) && std::getline(lines, line);
  while (std::getline(lines, line) && line.starts_with("  "))
    if (line[2] != ' ') names.push_back(line.substr(2, line.find(' ', 2) - 2));
  return names;
}

TEST_F(TypedWords, a_command_is_suggested) {
  expect_refused({"redner", "x"}, "did you mean 'render'? talus --help lists them");
  expect_refused({"plot", "x"}, "'plot' is not a command; did you mean 'figures' or 'render'?");
  expect_refused({"status", "x"}, "did you mean 'ensemble status'?");
  expect_refused({"slope.toml"}, "did you mean 'run slope.toml'?");
  expect_refused({"slope.h5"}, "did you mean 'view slope.h5' or 'info slope.h5'?");
  EXPECT_EQ(talus({"ensemble", "work.toml", "-o", "beds"}).exit_code, 66) << "a scenario that is missing";
  expect_refused({"frobnicate"}, "'frobnicate' is not a command; talus --help lists them");
  expect_refused({"ensemble", "statsu", "x"}, "did you mean 'talus ensemble status'?");
  expect_refused({}, "a command is missing, such as talus run SCENARIO.toml; talus --help lists them");
}

TEST_F(TypedWords, a_number_out_of_its_range_is_told_with_the_range) {
  expect_refused({"animate", "x.h5", "-o", "m.mp4", "--fps", "abc"},
                 "--fps: expected a number from 0.1 to 120, found abc;");
  expect_refused({"animate", "x.h5", "-o", "m.mp4", "--fps", "nan"},
                 "--fps: expected a number from 0.1 to 120, found nan;");
  expect_refused({"ensemble", "x.toml", "--jobs", "1.5"},
                 "--jobs: expected a whole number from 0 to 256, found 1.5; see talus ensemble --help");
  expect_refused({"figures", "x.h5", "-o", "x", "--size", "3"},
                 "--size 3: expected a width in cm from 8 to 60, or WIDTHxHEIGHT");
  expect_refused({"forces", "x.h5", "--seed", "abc"}, "--seed: expected a number, found abc;");
  expect_refused({"render", "x.h5", "--map", "gamma", "--range", "a,b"},
                 "--range: expected LOW,HIGH, found a,b (LOW,HIGH: ends of the bar");
}

TEST_F(TypedWords, options_without_what_they_need_are_told_in_plain_words) {
  const std::pair<Words, std::string> cases[] = {
      {{"run", "x.toml", "--set"},
       "found nothing (Change a key of the scenario, e.g. --set contact.friction=0.3);"},
      {{"render", "x.h5", "--map", "gamma", "--range", "0..1"},
       "--range: expected LOW,HIGH, found 0..1 (LOW,HIGH: ends of the bar, in the unit of its title);"},
      {{"render", "x.h5", "--map", "gamma", "--range", "1,2,3"}, "--range: expected LOW,HIGH, found 1,2,3 ("},
      {{"render", "x.h5", "--map", "gamma", "--crop", "1,2"}, "--crop: expected X0,Y0,X1,Y1, found 1,2 ("},
      {{"animate", "x.h5", "--speed"}, "--speed: expected DEG/S, found nothing ("},
      {{"render", "x.h5", "--at", "1", "--every", "2"},
       "--at and --every exclude each other: leave one out;"},
      {{"render"}, "RUN is missing; see talus render --help"},
      {{"export", "x.h5", "-o", "y"}, "--to is missing: expected --to {paraview,"},
      {{"panel", "x.h5", "-o", "y"}, "--at is missing: expected --at DEG,...; see talus panel --help"},
      {{"dump", "x.h5", "-o", "y"}, "--at is missing"},
      {{"run", "x.toml", "--colours", "gray"}, "--colours needs --pictures;"},
      {{"run", "x.toml", "-o", "a", "-o", "b"}, "--output was given 2 times; expected one FILE;"},
      {{"info", "x.h5", "--json=abc"}, "--json takes no value;"},
  };
  for (const auto& [words, part] : cases) expect_refused(words, part);
}

TEST_F(TypedWords, an_option_is_suggested_by_every_command) {
  expect_refused(
      {"render", "x.h5", "--map", "gamma", "--colors", "viridis"},
      "'--colors' is not an option of talus render; did you mean '--colours'? talus render --help");
  expect_refused({"animate", "x.h5", "--colors=gray"}, "did you mean '--colours'?");
  expect_refused({"ensemble", "x.toml", "--seed", "1-3"}, "did you mean '--seeds'?");
  expect_refused({"ensemble", "status", "x", "--jsno"},
                 "not an option of talus ensemble status; did you mean '--json'?");
  expect_refused({"run", "x.toml", "--over"}, "did you mean '--overwrite'?");
  expect_refused({"run", "x.toml", "-overwrite"}, "did you mean '--overwrite'?");
  expect_refused({"render", "x.h5", "--map", "gamma", "-at", "3"}, "did you mean '--at'?");
  expect_refused({"info", "x.h5", "--zzzzzz"},
                 "'--zzzzzz' is not an option of talus info; talus info --help lists them");
  expect_refused({"--verbose"}, "'--verbose' is not an option of talus;");
  for (const std::string& command : names_below(talus({"--help"}).out, "Runs:"))
    expect_refused({command, "x", "--hepl"}, "did you mean '--help'?");
}

TEST_F(TypedWords, a_key_is_no_option_but_a_setting) {
  expect_refused({"run", "x.toml", "--contact.friction=0.3"}, "did you mean '--set contact.friction=0.3'?");
  expect_refused({"check", "x.toml", "--friction", "0.3"},
                 "did you mean '--set contact.friction=VALUE' or '--set deposition.friction=VALUE'?");
  expect_refused({"check", "x.toml", "--end-angle", "20"}, "did you mean '--set tilt.end_angle=VALUE'?");
  expect_refused({"run", "x.toml", "--set", "contact.friction", "0.3"},
                 "did you mean '--set contact.friction=0.3'?");
  expect_refused({"run", "x.toml", "--set", "contact.friction=0.3", "tilt.step=0.002"},
                 "did you mean '--set tilt.step=0.002'?");
}

TEST_F(TypedWords, a_word_too_many_is_named) {
  expect_refused({"render", "a.h5", "b.h5", "--map", "gamma"},
                 "'b.h5' is one argument too many; expected talus render RUN and options");
}

TEST_F(TypedWords, a_value_is_suggested) {
  const Words render = {"render", "x.h5"};
  const std::vector<std::pair<Words, std::string>> cases = {
      {{"--map", "gama"}, "'gamma'"},
      {{"--map", "Coarse+forces"}, "'coarse'"},
      {{"--map", "gamma", "--colours", "virdis"}, "'viridis'"},
      {{"--map", "gamma", "--context", "osmsea"}, "'osmesa'"},
      {{"--map", "gamma", "--trace", "overlaoded"}, "'overloaded'"},
      {{"--map", "clusters", "--joined", "neighbors"}, "'neighbours'"},
  };
  for (const auto& [more, nearest] : cases) {
    Words words = render;
    words.insert(words.end(), more.begin(), more.end());
    expect_refused(words, "did you mean " + nearest + "?");
  }
  expect_refused({"export", "x.h5", "--to", "paravew", "-o", "x"}, "did you mean 'paraview'?");
  expect_refused({"solve", "x.h5", "--solver", "gaus-seidel"}, "did you mean 'gauss-seidel'?");
  expect_refused({"ensemble", "submit", "x", "--engine", "slrum"}, "did you mean 'slurm'?");
}

TEST_F(TypedWords, seeds_of_one_run_are_told_where_several_are_computed) {
  expect_refused({"run", "x.toml", "--seed", "1-3"},
                 "--seed: expected a whole number, found 1-3; talus ensemble SCENARIO --seeds 1-3 -o FOLDER");
  expect_refused({"run", "x.toml", "--seed", "seven"},
                 "expected a whole number, found seven; see talus run --help");
}

TEST_F(TypedWords, help_is_a_command_too) {
  EXPECT_EQ(talus({"help"}).out, talus({"--help"}).out);
  EXPECT_EQ(talus({"help", "run"}).out, talus({"run", "--help"}).out);
  EXPECT_EQ(talus({"help", "ensemble", "work"}).out, talus({"ensemble", "work", "--help"}).out);
  EXPECT_EQ(talus({"help"}).exit_code, 0);
}

TEST_F(TypedWords, help_has_groups_and_a_first_example) {
  const std::string help = talus({"--help"}).out;
  EXPECT_EQ(names_below(help, "Runs:"), (Words{"run", "check", "info", "replay", "repair"}));
  EXPECT_EQ(names_below(help, "Pictures:"), (Words{"view", "render", "panel", "animate", "maps"}));
  EXPECT_EQ(names_below(help, "Results:"), (Words{"analyze", "events", "figures", "export"}));
  EXPECT_EQ(names_below(help, "Many runs:"), (Words{"ensemble", "study", "perturb", "reproduce"}));
  EXPECT_EQ(names_below(help, "Contact problems:"), (Words{"dump", "solve", "forces"}));
  const std::size_t example = help.find("\n  talus run assets/scenarios/demo.toml -o demo.h5\n");
  EXPECT_LT(example, help.find("Usage:")) << "before everything else";
  EXPECT_NE(example, std::string::npos);
}

/// Checks that no internal terms of the argument parser appear in the text.
void expect_no_parser_terms(const std::string& text) {
  std::string letters = text;
  for (char& c : letters)
    if (std::isalpha(static_cast<unsigned char>(c)) == 0) c = ' ';
  std::istringstream words(letters);
  for (std::string word; words >> word;)
    for (const char* raw : {"TEXT", "FLOAT", "INT", "UINT", "BOOLEAN", "ENUM", "CHAR"})
      EXPECT_NE(word, raw) << text;
}

/// Returns the words of "
///  talus WORDS", the example in the help of a command.
Words example_in(const std::string& help) {
  const std::size_t at = help.find("Example:\n  talus ");
  if (at == std::string::npos) return {};
  std::istringstream line(help.substr(at + 17, help.find('\n', at + 17) - at - 17));
  Words words;
  for (std::string word; line >> word;) words.push_back(word);
  return words;
}

TEST_F(TypedWords, each_command_has_an_example_of_its_options_in_lines_that_fit) {
  std::vector<Words> commands;
  for (const char* group : {"Runs:", "Pictures:", "Results:", "Many runs:", "Contact problems:"})
    for (const std::string& command : names_below(talus({"--help"}).out, group))
      commands.push_back({command});
  for (const std::string& command : names_below(talus({"ensemble", "--help"}).out, "Subcommands:"))
    commands.push_back({"ensemble", command});
  ASSERT_EQ(commands.size(), 27u);
  for (Words command : commands) {
    const std::size_t depth = command.size();
    command.emplace_back("--help");
    const std::string help = talus(command).out;
    const Words words = example_in(help);
    ASSERT_GE(words.size(), depth) << help;
    for (std::size_t k = 0; k < depth; ++k) EXPECT_EQ(words[k], command[k]);
    for (const std::string& word : words) {
      if (word == "--") break;  // the rest belongs to another program
      if (word.starts_with("-")) {
        EXPECT_NE(help.find(word + (word.size() == 2 ? "," : " ")), std::string::npos) << word << "\n"
                                                                                       << help;
      }
    }
    expect_no_parser_terms(help);
    std::istringstream lines(help.substr(0, help.find("Example:")));
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("   ")) {
        EXPECT_LE(line.size(), 80u) << line;
      }
  }
}

TEST_F(TypedWords, pages_and_completions_say_what_values_mean) {
  ASSERT_EQ(talus({"program-help", "share"}).exit_code, 0);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path("share")))
    if (entry.is_regular_file()) {
      ++files;
      expect_no_parser_terms(text_of(entry.path()));
    }
  EXPECT_GE(files, 30u);
  EXPECT_NE(text_of(folder_.path("share/man/man1/talus-render.1")).find("\\-\\-theta\\-c\\fR DEG\n"),
            std::string::npos);
}

TEST_F(TypedWords, frames_are_a_folder_of_a_run_and_numbers_of_an_export) {
  EXPECT_NE(talus({"run", "--help"}).out.find("--pictures FOLDER     Folder for maps"), std::string::npos);
  EXPECT_NE(talus({"export", "--help"}).out.find("--frames K,K-K,... "), std::string::npos);
}

TEST_F(TypedWords, maps_are_listed_in_a_table) {
  const Outcome maps = talus({"maps"});
  EXPECT_EQ(maps.exit_code, 0);
  for (const char* row : {"\ngamma         stress ratio of each grain", "\nclusters ", "\ncritical ",
                          "\nlargest_cluster  Share", "--colours: gray, viridis"})
    EXPECT_NE(maps.out.find(row), std::string::npos) << row << "\n" << maps.out;
  EXPECT_NE(maps.out.find("--length\n"), std::string::npos) << "the option of the map coarse\n" << maps.out;
  std::istringstream lines(maps.out);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 100u) << line;
    EXPECT_FALSE(line.ends_with(' ')) << line;
  }
}

}  // namespace
}  // namespace talus::test
