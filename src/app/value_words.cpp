#include "app/value_words.h"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace talus::app {
namespace {

struct ValueWord {
  std::string_view option;
  std::string_view word;
  std::string_view command = {};  ///< command that the placeholder applies to; empty: all
};

constexpr ValueWord value_words[] = {
    {"--output", "FOLDER", "render"},
    {"--output", "FOLDER", "figures"},
    {"--output", "FOLDER", "export"},
    {"--output", "FOLDER", "ensemble"},
    {"--output", "FOLDER", "study"},
    {"--output", "FOLDER", "perturb"},
    {"--output", "FOLDER", "reproduce"},
    {"--output", "FILE"},
    {"--at", "DEG,...", "render"},
    {"--at", "DEG,...", "panel"},
    {"--at", "DEG,...", "export"},
    {"--at", "DEG,...", "forces"},
    {"--at", "DEG,...", "figures"},
    {"--at", "DEG"},
    {"--pictures", "FOLDER"},
    {"--frames", "K,K-K,..."},
    {"--displacement", "D"},
    {"--reference", "DEG"},
    {"--every", "DEG"},
    {"--from", "DEG"},
    {"--since", "DEG"},
    {"--theta-c", "DEG"},
    {"--second-minus", "DEG"},
    {"--speed", "DEG/S"},
    {"--length", "D"},
    {"--l-min", "D"},
    {"--crop", "X0,Y0,X1,Y1"},
    {"--range", "LOW,HIGH"},
    {"--patch", "WIDTHxDEPTH"},
    {"--printed", "CM"},
    {"--width", "PX"},
    {"--size", "WIDTHxHEIGHT"},
    {"--aspect", "W:H"},
    {"--title", "LINE"},
    {"--hold", "S"},
    {"--scale", "FACTOR"},
    {"--threshold", "FACTOR"},
    {"--fps", "1/S"},
    {"--stale", "S"},
    {"--max-wall", "HH:MM[:SS]"},
    {"--time", "HH:MM[:SS]"},
    {"--map", "MAP,..."},
    {"--map", "MAP", "view"},
    {"--second-map", "MAP"},
    {"--trace", "CURVE,..."},
    {"--colours", "COLOURS"},
    {"--joined", "contacts|neighbours"},
    {"--context", "CONTEXT"},
    {"--only", "FIGURE,..."},
    {"--add", "paper|spread|svg,..."},
    {"--style", "FILE"},
    {"--branch", "RUN"},
    {"--screenshot", "FILE"},
    {"--grain", "ID"},
    {"--set", "KEY=VALUE"},
    {"--vary", "KEY=VALUE,..."},
    {"--until", "MEAN:ERROR"},
    {"--keep", "all|analysis|N"},
    {"--seed", "SEED"},
    {"--seeds", "SEEDS"},
    {"--tol", "ETA"},
    {"--threads", "N"},
    {"--jobs", "N"},
    {"--tasks", "N"},
    {"--columns", "N"},
    {"--largest", "N"},
    {"--solutions", "N"},
    {"--max-iterations", "N"},
};

/// Whether the word is a type name of the parser, such as "FLOAT".
bool is_word_of_parser(const std::string& word) {
  constexpr std::string_view words[] = {"TEXT", "FLOAT", "INT",  "UINT",    "BOOLEAN",
                                        "CHAR", "ENUM",  "NONE", "COMPLEX", "[some_object]"};
  return std::ranges::find(words, word) != std::end(words);
}

std::string_view word_of(const std::string& option, const std::string& command) {
  std::string_view word;
  for (const ValueWord& row : value_words) {
    if (row.option != option) continue;
    if (row.command == command) return row.word;
    if (row.command.empty()) word = row.word;
  }
  return word;
}

void name_values_of(CLI::App& app, const std::string& command) {
  for (CLI::Option* option : app.get_options()) {
    const std::string type = option->get_type_name();
    const bool is_flag = option->get_expected_max() == 0;
    if (is_flag || !is_word_of_parser(type.substr(0, type.find(':')))) continue;
    if (option->get_positional()) {
      option->type_name(option->get_name(true));  // its name states its meaning
      continue;
    }
    std::string_view word = type.find(":{") == std::string::npos ? "" : "CHOICE";
    for (const std::string& name : option->get_lnames())
      if (const std::string_view found = word_of("--" + name, command); !found.empty()) word = found;
    if (!word.empty()) option->type_name(std::string(word));
  }
}

}  // namespace

void name_values(CLI::App& app) {
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    // The parser treats a group of options as a command without a name.
    name_values_of(*command, command->get_name().empty() ? app.get_name() : command->get_name());
    name_values(*command);
  }
}

}  // namespace talus::app
