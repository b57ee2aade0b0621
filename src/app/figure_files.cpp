#include "app/figure_files.h"

#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "app/figure_text.h"
#include "app/gnuplot.h"
#include "core/errors.h"
#include "render/output_file.h"
#include "render/png.h"
#include "render/renderer.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

constexpr double dots_per_cm = map_resolution / 2.54;

void create_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw Error(ExitCode::cannot_create, folder.string() + ": cannot create the folder: " + error.message());
}

/// A folder that vanishes with all that is still in it.
struct Workshop {
  explicit Workshop(fs::path folder) : path(std::move(folder)) { create_folder(path); }
  ~Workshop() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;

  fs::path path;
};

void write_text(const fs::path& path, const std::string& text) {
  OutputFile file(path.string());
  file.write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  file.commit();
}

void draw_maps(const Figure& figure, const fs::path& folder, double width) {
  if (figure.maps.empty()) return;
  Renderer renderer(make_osmesa_context());
  for (const FigureMap& map : figure.maps)
    write_png((folder / file_of(figure, map)).string(),
              renderer.draw(map.view, static_cast<int>(std::lround(map.width * width * dots_per_cm))));
}

}  // namespace

std::vector<std::string> figure_files(const Figure& figure) {
  std::vector<std::string> names;
  for (const char* ending : {".pdf", ".svg", ".png"}) names.push_back(figure.name + ending);
  for (const Table& table : figure.tables) names.push_back(file_of(figure, table));
  for (const FigureMap& map : figure.maps) names.push_back(file_of(figure, map));
  for (const char* ending : {".gp", ".json"}) names.push_back(figure.name + ending);
  return names;
}

void write_figure(const Figure& figure, std::span<const RunGroup> groups, const std::string& folder,
                  const FigureOptions& options) {
  const double width = figure_width(figure, options.columns);
  create_folder(folder);
  const Workshop workshop(fs::path(folder) / (figure.name + ".part-" + std::to_string(getpid())));
  for (const Table& table : figure.tables)
    write_text(workshop.path / file_of(figure, table), csv_text(table));
  write_text(workshop.path / (figure.name + ".gp"), gnuplot_text(figure, width));
  write_text(workshop.path / (figure.name + ".json"), provenance_json(figure, groups, options.command_line));
  draw_maps(figure, workshop.path, width);
  run_gnuplot(workshop.path.string(), figure.name + ".gp");
  for (const std::string& name : figure_files(figure)) {
    std::error_code error;
    fs::rename(workshop.path / name, fs::path(folder) / name, error);
    if (error)
      throw Error(ExitCode::cannot_create,
                  (fs::path(folder) / name).string() + ": cannot create: " + error.message());
  }
}

}  // namespace talus
