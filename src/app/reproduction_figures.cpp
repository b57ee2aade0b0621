#include "app/reproduction_figures.h"

#include <algorithm>
#include <filesystem>

#include "app/count_progress.h"
#include "app/figure_files.h"
#include "app/figure_runs.h"
#include "app/figure_text.h"
#include "core/errors.h"
#include "figures/catalogue.h"
#include "io/durable_file.h"
#include "io/run_file.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

std::vector<RunGroup> open_groups(const ReproductionPlan& plan, const WorkOptions& options) {
  std::vector<std::string> paths;
  // By bed, so that groups come in the order of the plan: the paper's preparation first.
  for (std::size_t b = 0; b < plan.beds.size(); ++b)
    for (const std::size_t r : runs_of(plan, b))
      if (const std::string path = run_path(options, plan.runs[r]); run_presence(path) == RunPresence::packed)
        paths.push_back(path);
  AnalysisOptions analysis;
  analysis.quiet = true;
  return group_runs(open_figure_runs(paths, AnalysisParameters(), analysis));
}

/// `talus figures` that makes the same figure.
std::string command_of(const Figure& figure, const std::string& folder) {
  std::string text = "talus figures";
  for (const std::string& run : figure.runs) text += " " + run;
  return text + " --only " + figure.name + " -o " + folder;
}

bool holds(const fs::path& file, const std::string& text) {
  if (!fs::exists(file)) return false;
  const std::vector<std::byte> bytes = read_file(file.string());
  return std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()) == text;
}

/// Whether all files of a figure are there, drawn from the same data in the same way.
bool is_drawn(const Figure& figure, std::span<const RunGroup> groups, const fs::path& folder,
              const FigureOptions& options) {
  const auto there = [&](const std::string& file) { return fs::exists(folder / file); };
  return std::ranges::all_of(figure_files(figure), there) &&
         holds(folder / (figure.name + ".json"), provenance_json(figure, groups, options.command_line)) &&
         holds(folder / (figure.name + ".gp"), gnuplot_text(figure, figure_width(figure, options.columns)));
}

void draw(const Figure& figure, std::span<const RunGroup> groups, const std::string& folder,
          const FigureOptions& figure_options, const WorkOptions& options) {
  try {
    write_figure(figure, groups, folder, figure_options);
  } catch (const Error&) {
    stop_where_asked(options);  // Ctrl-C ends gnuplot too: that is no error of the figure
    throw;
  }
}

}  // namespace

std::vector<ReportPicture> draw_figures(const ReproductionPlan& plan, const WorkOptions& options) {
  const std::vector<RunGroup> groups = open_groups(plan, options);
  const std::string folder = (fs::path(options.folder) / "figures").string();
  const auto catalogue = figure_catalogue();
  std::vector<ReportPicture> pictures;
  CountProgress progress("figures", catalogue.size(), false);
  for (std::size_t k = 0; k < catalogue.size(); ++k) {
    stop_where_asked(options);
    if (const auto figure = catalogue[k].make(groups)) {
      const FigureOptions figure_options{0, command_of(*figure, folder)};
      if (!is_drawn(*figure, groups, folder, figure_options))
        draw(*figure, groups, folder, figure_options, options);
      pictures.push_back({"figures/" + figure->name + ".png", figure->title, figure->caption, figure->wide});
    }
    progress.show(k + 1);
  }
  return pictures;
}

}  // namespace talus
