/// `talus figures`: draws the paper's figures of runs as PDF, SVG and PNG, with their data.

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fmt/core.h>
#include <future>
#include <memory>
#include <mutex>

#include "app/choices.h"
#include "app/command_line.h"
#include "app/commands.h"
#include "app/figure_files.h"
#include "app/figure_runs.h"
#include "app/frame_options.h"
#include "app/gnuplot.h"
#include "app/progress.h"
#include "app/stop_signals.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/nearest_word.h"
#include "base/output_file.h"
#include "base/visible_text.h"
#include "figures/catalogue.h"
#include "runs/analysis_parameters.h"

namespace talus::app {
namespace {

struct FiguresArguments {
  std::vector<std::string> runs;
  std::vector<std::string> only;
  std::vector<std::string> settings;
  runs::AnalysisOptions analysis;
  bool quiet = false;
  std::vector<std::string> at;
  std::string size;
  std::string folder;
  bool overwrite = false;
};

/// Returns "fig09" for "fig09-overloaded-fraction"; other names have no short form.
std::string_view short_name(std::string_view name) {
  return name.starts_with("fig") ? name.substr(0, name.find('-')) : name;
}

/// Expands "9" and "09" to "fig09".
std::string long_form(const std::string& word) {
  const bool number = !word.empty() && word.size() <= 2 &&
                      std::ranges::all_of(word, [](unsigned char c) { return std::isdigit(c) != 0; });
  return number ? fmt::format("fig{:0>2}", word) : word;
}

[[noreturn]] void refuse_name(const std::string& word) {
  std::vector<std::string> names;
  for (const figures::FigureRecipe& recipe : figures::figure_catalogue())
    for (const std::string_view name : {recipe.name, short_name(recipe.name)}) names.emplace_back(name);
  const std::string meant = did_you_mean(word, names);
  throw Error(ExitCode::usage, fmt::format("--only {}: no such figure{} talus figures --help lists them",
                                           visible_word(word), meant.empty() ? ";" : meant));
}

/// Returns the requested recipes, in the order of the catalogue.
std::vector<figures::FigureRecipe> chosen_recipes(const std::vector<std::string>& only) {
  const auto catalogue = figures::figure_catalogue();
  const auto is_called = [](const figures::FigureRecipe& recipe, const std::string& word) {
    return recipe.name == word || short_name(recipe.name) == long_form(word);
  };
  for (const std::string& word : only)
    if (std::ranges::none_of(catalogue, [&](const auto& recipe) { return is_called(recipe, word); }))
      refuse_name(word);
  std::vector<figures::FigureRecipe> recipes(catalogue.begin(), catalogue.end());
  if (!only.empty())
    std::erase_if(recipes, [&](const figures::FigureRecipe& recipe) {
      return std::ranges::none_of(only, [&](const std::string& word) { return is_called(recipe, word); });
    });
  return recipes;
}

/// Whether any run has the data for a figure.
bool is_there(figures::Material material, std::span<const figures::RunGroup> groups) {
  const auto has = [material](const runs::RunView& run) {
    return material == figures::Material::values || (run.file && run.file->has_frames()) ||
           (material == figures::Material::distributions && !run.analysis.gamma_edge.empty());
  };
  return std::ranges::any_of(
      groups, [&](const figures::RunGroup& group) { return std::ranges::any_of(group.runs, has); });
}

/// Parses "8.6" or "17.8x10", cm; an empty text means the default of each figure.
FigureSize parse_size(const std::string& text) {
  constexpr double narrowest = 8.0, lowest = 4.0, largest = 60.0;
  if (text.empty()) return {};
  double sides[2] = {0.0, 0.0};
  const char *at = text.data(), *const end = at + text.size();
  for (int k = 0; k < 2; ++k) {
    const auto [next, error] = std::from_chars(at, end, sides[k]);
    const double least = k == 0 ? narrowest : lowest;
    if (error != std::errc() || !(sides[k] >= least && sides[k] <= largest)) break;
    if (next == end) return {sides[0], sides[1]};
    if (*next != 'x') break;
    at = next + 1;
  }
  throw Error(
      ExitCode::usage,
      fmt::format("--size {}: expected a width in cm from {} to {}, or WIDTHxHEIGHT with a height from {}",
                  visible_word(text), narrowest, largest, lowest));
}

/// Returns the figures that can be made of the runs, and reports the requirements of the others.
std::vector<figures::Figure> make_figures(const std::vector<figures::FigureRecipe>& recipes,
                                          std::span<const figures::RunGroup> groups,
                                          const figures::FrameWords& at) {
  std::vector<figures::Figure> figures;
  for (const figures::FigureRecipe& recipe : recipes)
    if (auto figure = recipe.make(groups, at))
      figures.push_back(std::move(*figure));
    else
      print_error("%s",
                  fmt::format("left out: {} needs {}{}\n", recipe.name, recipe.needs,
                              is_there(recipe.material, groups)
                                  ? ""
                                  : "; the input has only values of members, without frames of their runs")
                      .c_str());
  if (figures.empty()) throw Error(ExitCode::bad_data, "no figure can be made of these runs");
  return figures;
}

/// Writes figures in parallel, because gnuplot takes most of the time and uses one processor per figure.
void write_figures(const std::vector<figures::Figure>& figures, std::span<const figures::RunGroup> groups,
                   const FiguresArguments& arguments) {
  const CountDone progress = count_shown("figures", arguments.quiet);
  progress(0, figures.size());
  std::mutex counting;
  std::size_t next = 0, done = 0;
  const auto work = [&] {
    std::unique_lock lock(counting);
    while (next < figures.size()) {
      const figures::Figure& figure = figures[next++];
      lock.unlock();
      try {
        stop_if_asked();
        write_figure(figure, groups, arguments.folder, {parse_size(arguments.size), command_line()});
      } catch (...) {
        lock.lock();
        next = figures.size();  // starts no others
        throw;
      }
      lock.lock();
      progress(++done, figures.size());
    }
  };
  std::vector<std::future<void>> others;
  for (int t = 1; t < arguments.analysis.threads; ++t) others.push_back(std::async(std::launch::async, work));
  work();
  for (std::future<void>& other : others) other.get();
}

/// Removes earlier figures that were asked for and cannot be made of these runs.
void remove_left_out(const std::vector<figures::FigureRecipe>& recipes,
                     const std::vector<figures::Figure>& figures, const std::string& folder) {
  for (const figures::FigureRecipe& recipe : recipes) {
    const std::string name(recipe.name);
    if (std::ranges::find(figures, name, &figures::Figure::name) != figures.end()) continue;
    const std::vector<std::string> earlier = earlier_figure_files(folder, name);
    remove_earlier_figure(folder, earlier);
    if (!earlier.empty()) print_error("%s", fmt::format("removed: {} of an earlier command\n", name).c_str());
  }
}

void make(const FiguresArguments& arguments) {
  const std::vector<figures::FigureRecipe> recipes = chosen_recipes(arguments.only);
  parse_size(arguments.size);
  if (!arguments.at.empty() && std::ranges::none_of(recipes, &figures::FigureRecipe::shows_frames))
    throw Error(ExitCode::usage, "--at: no requested figure shows single frames");
  runs::parse_analysis_settings(arguments.settings);  // validates before any run is read
  require_gnuplot();
  runs::AnalysisOptions analysis = arguments.analysis;
  if (!arguments.quiet) analysis.progress = count_shown("analysis", false);
  FigureInput input = read_figure_input(arguments.runs, arguments.settings, analysis);
  const std::vector<figures::RunGroup> groups = figures::group_runs(std::move(input.runs));
  const std::vector<figures::Figure> figures = make_figures(recipes, groups, arguments.at);
  const std::filesystem::path folder = arguments.folder;
  const OutputRule rule{arguments.overwrite, input.files};
  for (const figures::Figure& figure : figures)
    for (const std::string& file : figure_files(figure)) output_target((folder / file).string(), rule);
  if (arguments.overwrite)
    for (const figures::FigureRecipe& recipe : recipes)
      for (const std::string& file : earlier_figure_files(arguments.folder, std::string(recipe.name)))
        output_target((folder / file).string(), rule);
  write_figures(figures, groups, arguments);
  if (arguments.overwrite) remove_left_out(recipes, figures, arguments.folder);
  for (const figures::Figure& figure : figures)
    print("%-34s %s\n", figure.name.c_str(), figure.title.c_str());
  const bool scripted = std::ranges::any_of(figures, [](const auto& figure) { return figure.maps.empty(); });
  print("%zu figure%s in %s: .pdf, .svg, .png; data in .csv, provenance in .json%s\n", figures.size(),
        figures.size() == 1 ? "" : "s", arguments.folder.c_str(), scripted ? ", script in .gp" : "");
}

/// Returns all figures, one per line, for the help.
std::string list_of_figures() {
  std::string text = "Figures:\n";
  for (const figures::FigureRecipe& recipe : figures::figure_catalogue())
    text += fmt::format("  {}: {}\n", recipe.name, recipe.title);
  return text;
}

}  // namespace

void add_figures_command(CLI::App& app) {
  auto arguments = std::make_shared<FiguresArguments>();
  CLI::App* command = app.add_subcommand(
      "figures", "Draw the paper's figures of runs as PDF, SVG and PNG, with their data (needs gnuplot)");
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
      ->add_option("--threads", arguments->analysis.threads,
                   "Frames analysed and figures drawn in parallel; the result does not depend on it")
      ->capture_default_str()
      ->check(in_range(1, 256));
  command->add_flag("--overwrite", arguments->overwrite, "Replace existing files");
  command->add_flag("-q,--quiet", arguments->quiet, "Show no progress");
  command->footer(list_of_figures());
  command->callback([arguments] { make(*arguments); });
}

}  // namespace talus::app
