/// Misspelt commands, options and values; the help; the list of maps. Each command with a wrong path: an
/// incomplete run, its folder, a scenario instead of a run, a run instead of a scenario, or the folder of an
/// ensemble.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <sstream>

#include "support/commands.h"
#include "support/runs.h"

namespace talus::test {
namespace {

class TypedWords : public CommandTest {
 protected:
  /// Expects a usage error of one line that contains `part`.
  void expect_refused(const Words& words, const std::string& part) {
    const Outcome outcome = talus(words);
    EXPECT_EQ(outcome.exit_code, 64) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("talus: error: ")) << outcome.err;
    EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
    EXPECT_TRUE(has(outcome.err, part));
  }
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
  expect_refused({"slope.toml"}, "'slope.toml' is not a command; talus --help lists them");
  EXPECT_EQ(talus({"complete-words", "ensemble", "submit", "--engine", ""}).out, "slurm\nprint\n");
  EXPECT_EQ(talus({"ensemble", "work.toml", "-o", "beds"}).exit_code, 66) << "a scenario that is missing";
  expect_refused({"frobnicate"}, "'frobnicate' is not a command; talus --help lists them");
  expect_refused({"ensemble", "statsu", "x"},
                 "'statsu' is not a command; did you mean 'status'? talus ensemble --help lists them");
  expect_refused({}, "a command is missing, such as talus run SCENARIO.toml; talus --help lists them");
}

TEST_F(TypedWords, a_number_out_of_its_range_is_told_with_the_range) {
  expect_refused({"animate", "x.h5", "-o", "m.mp4", "--fps", "abc"},
                 "--fps: expected a number from 0.1 to 120, found abc;");
  expect_refused({"animate", "x.h5", "-o", "m.mp4", "--fps", "nan"},
                 "--fps: expected a number from 0.1 to 120, found nan;");
  expect_refused({"ensemble", "x.toml", "--jobs", "1.5"},
                 "--jobs: expected a whole number from 0 to 256, found 1.5; see talus ensemble --help");
  expect_refused({"figures", "x.h5", "-o", "x", "--size", "8.6"},
                 "--size 8.6: expected a width from 8 to 60 cm, such as 8.6cm");
  expect_refused({"forces", "x.h5", "--seed", "abc"}, " (expected --seed SEED); see talus forces --help");
  expect_refused({"render", "x.h5", "--map", "gamma", "--range", "a,b"}, " (expected --range LOW,HIGH)");
}

/// The words of the parser differ between its versions, except for the names.
TEST_F(TypedWords, options_without_what_they_need_are_named) {
  const std::pair<Words, std::string> cases[] = {
      {{"run", "x.toml", "--set"}, "(expected --set KEY=VALUE); see talus run --help"},
      {{"render", "x.h5", "--map", "gamma", "--range", "0..1"}, "(expected --range LOW,HIGH)"},
      {{"render", "x.h5", "--map", "gamma", "--range", "1,2,3"}, "(expected --range LOW,HIGH)"},
      {{"render", "x.h5", "--map", "gamma", "--crop", "1,2"}, "(expected --crop X0,Y0,X1,Y1)"},
      {{"animate", "x.h5", "--speed"},
       "--speed: 1 required DEG/S (0.001 to 1000) missing (expected --speed DEG/S); see"},
      {{"render", "x.h5", "--at", "1", "--every", "2"}, "--at excludes --every; see talus render --help"},
      {{"render"}, "RUN is required; see talus render --help"},
      {{"export", "x.h5", "-o", "y"}, "--to is required (expected --to {paraview,"},
      {{"dump", "x.h5", "-o", "y"}, "--at is required"},
      {{"study", "x.toml"}, "--output is required"},
      {{"run", "x.toml", "--resume", "--overwrite"}, ""},
      {{"run", "x.toml", "--threads", "0"}, ""},
      {{"run", "x.toml", "--colours", "gray"}, "--colours requires --pictures;"},
      {{"run", "x.toml", "-o", "a", "-o", "b"}, "(expected --output FILE)"},
      {{"info", "x.h5", "--json=abc"}, "(expected --json without a value)"},
      {{"render", "x.h5", "--for", "papr"}, "did you mean 'paper'? see talus render --help"},
      {{"run", "x.toml", "--set", "l_min = 0"}, "--set l_min = 0: a parameter of maps requires --pictures"},
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

TEST_F(TypedWords, an_option_that_has_another_name_now_is_told_it) {
  const std::pair<Words, std::string> cases[] = {
      {{"render", "x.h5", "--theta-c", "20"},
       "'--theta-c' of talus render is now '--set gamma_c=X', with the sine of that angle: 0.342 for 20 deg"},
      {{"panel", "x.h5", "--threshold=2"}, "is now '--set threshold_factors=FACTOR'"},
      {{"run", "x.toml", "--pictures", "maps", "--l-min", "0"}, "is now '--set l_min=D'"},
      {{"export", "x.h5", "--to", "vti", "-o", "x", "--length", "5"}, "is now '--set length=D'"},
      {{"animate", "x.h5", "--joined", "neighbours"}, "or '--set joining=neighbours'"},
      {{"render", "x.h5", "--frames", "0-10"},
       "'--frames' of talus render is now '--at frame0-frame10,frame20'"},
      {{"render", "x.h5", "--width", "1920"}, "is now '--size PIXELS'"},
      {{"animate", "x.h5", "--aspect", "16:9"}, "is now '--size WIDTHxHEIGHT'"},
      {{"panel", "x.h5", "--printed", "8.6"}, "is now '--size 8.6cm'"},
      {{"view", "x.h5", "--second", "y.h5"}, "is now a second window: talus view OTHER"},
      {{"events", "x.h5", "--force"}, "is now 'talus analyze --force'"},
  };
  for (const auto& [words, now] : cases) expect_refused(words, now);
}

/// Options of maps have their own page, and two screens of 50 lines are enough for each.
TEST_F(TypedWords, every_help_fits_two_screens) {
  const std::string page = talus({"maps", "--help"}).out;
  for (const char* option : {"--map MAP,...", "--size SIZE", "--set KEY=VALUE", "--colours", "--since",
                             "--range", "--crop", "--trace", "--turned", "--transparent", "--bare", "--for"})
    EXPECT_TRUE(has(page, std::string("\n  ") + option)) << option;
  for (const char* command : {"maps",     "run",     "render",  "panel",     "animate", "export", "view",
                              "ensemble", "figures", "check",   "info",      "replay",  "repair", "analyze",
                              "events",   "study",   "perturb", "reproduce", "dump",    "solve",  "forces"}) {
    const Outcome shown = talus({command, "--help"});
    EXPECT_TRUE(ends(shown, 0, {"\n"})) << command;
    const std::string& help = shown.out;
    EXPECT_LE(std::ranges::count(help, '\n'), 100) << command;
    EXPECT_FALSE(has(help, "... ...")) << help;
    const bool draws = std::string("run render panel animate").find(command) != std::string::npos;
    EXPECT_EQ(has(help, "\nMaps: talus maps --help describes --map, --size, "), draws) << help;
  }
}

TEST_F(TypedWords, a_word_too_many_is_named) {
  expect_refused({"render", "a.h5", "b.h5", "--map", "gamma"},
                 "'b.h5' is one argument too many; expected talus render RUN and options");
  expect_refused({"run", "x.toml", "--set", "contact.friction", "0.3"}, "'0.3' is one argument too many;");
}

TEST_F(TypedWords, a_value_is_suggested) {
  const Words render = {"render", "x.h5"};
  const std::vector<std::pair<Words, std::string>> cases = {
      {{"--map", "gama"}, "'gamma'"},
      {{"--map", "Coarse+forces"}, "'coarse'"},
      {{"--map", "gamma", "--colours", "virdis"}, "'viridis'"},
      {{"--map", "gamma", "--context", "osmsea"}, "'osmesa'"},
      {{"--map", "gamma", "--trace", "overlaoded"}, "'overloaded'"},
  };
  for (const auto& [more, nearest] : cases) expect_refused(render + more, "did you mean " + nearest + "?");
  expect_refused({"export", "x.h5", "--to", "paravew", "-o", "x"}, "did you mean 'paraview'?");
  expect_refused({"solve", "x.h5", "--solver", "gaus-seidel"}, "did you mean 'gauss-seidel'?");
  expect_refused({"ensemble", "submit", "x", "--engine", "slrum"}, "did you mean 'slurm'?");
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
        EXPECT_TRUE(has(help, word + (word.size() == 2 ? "," : " "))) << word;
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

TEST_F(TypedWords, man_pages_say_what_values_mean) {
  ASSERT_EQ(talus({"program-help", "share"}).exit_code, 0);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path("share")))
    if (entry.is_regular_file()) {
      ++files;
      expect_no_parser_terms(text_of(entry.path()));
    }
  EXPECT_GE(files, 25u);
  EXPECT_TRUE(has(folder_.text("share/talus-ensemble-work.1"), "all workers (1 to 86400) [120]"));
}

TEST_F(TypedWords, help_names_the_kind_of_a_value) {
  EXPECT_TRUE(has(talus({"run", "--help"}).out, "--pictures FOLDER     Folder for maps"));
}

TEST_F(TypedWords, version_is_told) {
  EXPECT_TRUE(ends(talus({"--version"}), 0,
                   {"talus ", "\ncompiler      ", "\nwindow        ", "\nrun files     schema version 4\n",
                    "\nanalyses      version "}));
}

TEST_F(TypedWords, maps_are_listed_in_a_table) {
  const Outcome maps = talus({"maps"});
  EXPECT_TRUE(ends(maps, 0,
                   {"\ngamma         stress ratio of each grain", "\nclusters ", "\ncritical ",
                    "\nlargest_cluster  Share", "--colours: gray, viridis"}));
  EXPECT_TRUE(has(maps.out, "length\n")) << "the parameter of the map coarse";
  std::istringstream lines(maps.out);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 100u) << line;
    EXPECT_FALSE(line.ends_with(' ')) << line;
  }
}

namespace fs = std::filesystem;

constexpr const char* bed = "seed = 5\n[bed]\nlength = 10\ndepth = 2\n[tilt]\nend_angle = 0.2\n";

/// Commands with an argument that names a run or a scenario.
const Words takers_of_runs[] = {
    {"info", "X"},
    {"replay", "X"},
    {"repair", "X", "-o", "new.h5"},
    {"render", "X", "--map", "forces", "-o", "maps"},
    {"panel", "X", "--map", "forces", "--at", "frame0", "-o", "panel.png"},
    {"animate", "X", "--map", "forces", "-o", "movie.mp4"},
    {"analyze", "X"},
    {"events", "X"},
    {"figures", "X", "--only", "fig09", "-o", "figures"},
    {"export", "X", "--to", "csv", "-o", "tables"},
    {"dump", "X", "--at", "frame0", "-o", "problem.h5"},
    {"forces", "X", "--at", "frame0"},
};
const Words takers_of_scenarios[] = {
    {"run", "X"},
    {"ensemble", "X", "--seeds", "1", "-o", "beds"},
    {"study", "X", "--vary", "tilt.step=0.01", "--seeds", "1", "-o", "study"},
    {"perturb", "X", "--seeds", "1", "-o", "pushes"},
};

class MistakenPath : public CommandTest {
 protected:
  MistakenPath() : CommandTest(bed) {}

  Outcome call(Words words, const std::string& path) {
    words[1] = path;
    return folder_.talus(words);
  }

  void expect_refused(const Words& words, const std::string& path, int code, const Words& parts) {
    const Outcome outcome = call(words, path);
    EXPECT_TRUE(ends(outcome, code, parts)) << words[0];
    EXPECT_TRUE(outcome.err.starts_with("talus: error: ")) << words[0] << ": " << outcome.err;
  }

  /// Creates a run that exists only as the folder stopped.h5.run.
  void create_stopped_run() {
    folder_.talus({"run", "bed.toml", "-q", "-o", "stopped.h5", "--max-wall", "00:00:01", "--set",
                   "tilt.end_angle=60"});
    ASSERT_TRUE(fs::is_directory(folder_.path("stopped.h5.run")));
    ASSERT_FALSE(folder_.has_file("stopped.h5"));
  }
};

TEST_F(MistakenPath, a_stopped_run_in_place_of_a_scenario_is_refused_with_the_command_that_goes_on) {
  create_stopped_run();
  for (const char* path : {"stopped.h5", "stopped.h5.run", "stopped.h5.run/"})
    for (const Words& words : takers_of_scenarios)
      expect_refused(words, path, 65,
                     {"is not a scenario but a run; talus info stopped.h5 shows how far it is, and talus run "
                      "--resume stopped.h5 continues it if it is incomplete\n"});
  expect_refused({"run", "X", "--resume", "-o", "other.h5"}, "stopped.h5", 65,
                 {"talus run --resume stopped.h5 continues it if it is incomplete\n"});
  EXPECT_TRUE(
      has(call({"info", "X"}, "stopped.h5").out, "to continue         talus run --resume stopped.h5\n"));
  EXPECT_EQ(call({"check", "X"}, "stopped.h5.run/").exit_code, 0);
}

TEST_F(MistakenPath, a_complete_run_in_place_of_a_scenario_is_refused) {
  take_run(folder_, "done.h5", bed);
  for (const Words& words : takers_of_scenarios)
    expect_refused(
        words, "done.h5", 65,
        {"done.h5 is not a scenario but a run; talus info done.h5 shows", "if it is incomplete\n"});
}

TEST_F(MistakenPath, a_scenario_in_place_of_a_run_is_refused) {
  for (const Words& words : takers_of_runs)
    expect_refused(
        words, "bed.toml", 65,
        {"bed.toml: is not a Talus run file", "expected one that talus run, view or replay has written"});
}

TEST_F(MistakenPath, the_folder_of_an_ensemble_is_refused) {
  fs::create_directory(folder_.path("beds"));
  write_file(folder_, "beds/ensemble.manifest", "");
  take_run(folder_, "beds/seed-2.h5", bed);
  take_run(folder_, "beds/seed-1.h5", bed);
  for (const Words& words : takers_of_runs)
    if (words[0] != "figures" && words[0] != "analyze" && words[0] != "events")  // these commands accept it
      expect_refused(words, "beds", 66, {"beds is a folder, but not a run; expected a run file"});
  expect_refused({"check", "X"}, "beds", 66, {"beds is a folder"});
  for (const Words& words : takers_of_scenarios)
    expect_refused(words, "beds", 66, {"beds is a folder; expected a scenario file (TOML)"});
}

TEST_F(MistakenPath, a_folder_without_a_run_is_told) {
  fs::create_directory(folder_.path("empty"));
  fs::create_directory(folder_.path("begun.h5.run"));
  for (const Words& words : takers_of_runs) {
    expect_refused(words, "empty", 66,
                   {"empty is a folder, but not a run; expected a run file, or a folder"});
    expect_refused(words, "nothing.h5", 66, {"nothing.h5: no such run; expected a run file, or a folder"});
    expect_refused(words, "begun.h5", 66, {"begun.h5.run: nothing is committed there yet"});
  }
  for (const char* path : {"begun.h5.run", "begun.h5.run/"})
    expect_refused({"info", "X"}, path, 66, {"begun.h5.run: nothing is committed there yet"});
  for (const Words& words : takers_of_scenarios) {
    expect_refused(words, "empty", 66, {"empty is a folder; expected a scenario file (TOML)"});
    expect_refused(words, "nothing.toml", 66, {"nothing.toml: cannot read: "});
  }
  expect_refused({"check", "X"}, "nothing.toml", 66, {"nothing.toml: cannot read: "});
}

}  // namespace
}  // namespace talus::test
