/// `talus figures`: draws the paper's figures of runs, with their data, by the Python package.

#include <fmt/core.h>
#include <memory>

#include "app/choices.h"
#include "app/command_line.h"
#include "app/commands.h"
#include "app/frame_options.h"
#include "app/python_module.h"
#include "runs/run_view.h"

namespace talus::app {
namespace {

struct FiguresArguments {
  std::vector<std::string> runs;
  std::vector<std::string> only;
  std::vector<std::string> at;
  std::string size;
  std::vector<std::string> settings;
  std::vector<std::string> additions;
  std::string style;
  int threads = runs::AnalysisOptions{}.threads;
  bool overwrite = false;
  bool quiet = false;
  std::string folder;
};

[[noreturn]] void make(const FiguresArguments& arguments) {
  std::vector<std::string> words = {"--command=" + command_line(), "--output=" + arguments.folder,
                                    fmt::format("--threads={}", arguments.threads)};
  const auto add = [&words](const char* option, const std::vector<std::string>& values) {
    for (const std::string& value : values) words.push_back(option + value);
  };
  add("--only=", arguments.only);
  add("--at=", arguments.at);
  add("--set=", arguments.settings);
  add("--add=", arguments.additions);
  if (!arguments.size.empty()) add("--size=", {arguments.size});
  if (!arguments.style.empty()) add("--style=", {arguments.style});
  if (arguments.overwrite) words.emplace_back("--overwrite");
  if (arguments.quiet) words.emplace_back("--quiet");
  words.emplace_back("--");
  words.insert(words.end(), arguments.runs.begin(), arguments.runs.end());
  become_python_module("figures", words);
}

}  // namespace

void add_figures_command(CLI::App& app) {
  auto arguments = std::make_shared<FiguresArguments>();
  CLI::App* command = app.add_subcommand(
      "figures", "Draw the paper's figures of runs as PDF and PNG, with their data (needs matplotlib)");
  command
      ->add_option("RUNS", arguments->runs,
                   "Run files, folders of ensembles, or an ensemble.h5 alone; runs that differ only in their "
                   "seed are averaged. A missing analysis is computed and stored")
      ->required();
  command->add_option("-o,--output", arguments->folder, "Folder of the figures, created if missing")
      ->required();
  command
      ->add_option("--only", arguments->only,
                   "Figures to make, by name or number, separated by commas: --only fig09,12 [all]")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_at_option(*command, arguments->at, " [those of the paper]; only for figures that show single frames");
  command->add_option("--size", arguments->size,
                      "Width of the figures in cm, or WIDTHxHEIGHT; a journal column is 8.6 wide, a page "
                      "17.8 [default of each figure]");
  command
      ->add_option("--set", arguments->settings,
                   "Change a parameter of the analysis, e.g. --set lc_cut=30 (see docs/analysis.md)")
      ->allow_extra_args(false);
  command
      ->add_option(
          "--add", arguments->additions,
          "paper: its values for other beds too; spread: deviations and single runs of more than two "
          "groups; svg: each figure as SVG too")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(one_of({"paper", "spread", "svg"}));
  command->add_option("--style", arguments->style, "Style sheet of matplotlib, by its path or its name");
  command
      ->add_option("--threads", arguments->threads,
                   "Frames analysed and figures drawn in parallel; the result does not depend on it")
      ->capture_default_str()
      ->check(in_range(1, 256));
  command->add_flag("--overwrite", arguments->overwrite, "Replace existing files");
  command->add_flag("-q,--quiet", arguments->quiet, "Show no progress");
  command->footer("docs/figures.md lists the figures.");
  command->callback([arguments] { make(*arguments); });
}

}  // namespace talus::app
