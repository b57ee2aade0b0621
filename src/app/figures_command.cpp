/// `talus figures`: draws the paper's figures of runs, with their data, by the Python package.

#include <fmt/core.h>
#include <memory>

#include "app/command_line.h"
#include "app/commands.h"
#include "app/frame_options.h"
#include "app/options.h"
#include "app/other_programs.h"
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
  add_option(*command, "-o,--output", arguments->folder, "FOLDER",
             "Folder of the figures, created if missing")
      ->required();
  add_option(*command, "--only", arguments->only, "FIGURE,...",
             "Figures to make, by name or number, separated by commas: --only fig09,12 [all]")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_at_option(*command, arguments->at, " [those of the paper]; only for figures that show single frames");
  add_option(*command, "--size", arguments->size, "SIZE",
             "Size of the figures: 8.6cm, the width of a column of a journal; 17.8x10cm; or pixels of their "
             "PNG, as in 1600 or 1920x1080 [default of each figure]");
  add_analysis_settings(*command, arguments->settings);
  command
      ->add_option("--add", arguments->additions,
                   "paper: its values for other beds too; spread: deviations and single runs of more than "
                   "two groups; svg: each figure as SVG too")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(one_of({"paper", "spread", "svg"}));
  add_option(*command, "--style", arguments->style, "FILE",
             "Style sheet of matplotlib, by its path or its name");
  add_threads_option(*command, arguments->threads, "Frames analysed and figures drawn in parallel");
  command->add_flag("--overwrite", arguments->overwrite, "Replace existing files");
  command->add_flag("-q,--quiet", arguments->quiet, "Print errors and warnings only");
  command->footer("docs/figures.md lists the figures.");
  command->callback([arguments] { make(*arguments); });
}

}  // namespace talus::app
