#include "app/figure_files.h"

#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <mutex>
#include <optional>
#include <utility>

#include "app/gnuplot.h"
#include "base/descriptor.h"
#include "base/errors.h"
#include "base/locked_file.h"
#include "base/output_file.h"
#include "io/durable_file.h"
#include "render/png.h"
#include "render/renderer.h"

namespace talus::app {
namespace {

namespace fs = std::filesystem;

constexpr double dots_per_cm = figures::map_resolution / 2.54;
constexpr const char* endings[] = {".pdf", ".svg", ".png"};

/// A folder that vanishes with all that is still in it. One that a kill left is replaced.
struct Workshop {
  explicit Workshop(const fs::path& folder) : path(folder), lock(create_locked_folder(folder.string())) {
    if (!lock)
      throw Error(ExitCode::cannot_create,
                  folder.stem().stem().string() +
                      " is being drawn by another process in the same folder; wait for it to end, or choose "
                      "another folder with -o");
  }
  ~Workshop() {
    std::error_code ignored;
    if (lock) fs::remove_all(path, ignored);
  }
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;

  fs::path path;
  std::optional<Descriptor> lock;
};

void draw_maps(const figures::Figure& figure, const fs::path& folder, double width) {
  static std::mutex drawing;  // the memory of one picture at a time
  if (figure.maps.empty()) return;
  const std::lock_guard one_at_a_time(drawing);
  render::Renderer renderer(render::make_context(std::nullopt));
  for (const figures::FigureMap& map : figure.maps)
    render::write_png(
        (folder / figures::file_of(figure, map)).string(),
        renderer.draw(map.view, static_cast<int>(std::lround(map.width * width * dots_per_cm))));
}

/// gnuplot draws into memory, as it ends well even where it could not write all.
void draw(const figures::Figure& figure, const fs::path& folder) {
  std::vector<std::pair<std::string, MemoryFile>> drawings;
  for (const char* ending : endings) {
    const std::string path = (folder / (figure.name + ending)).string();
    const MemoryFile& made = drawings.emplace_back(path, MemoryFile(path)).second;
    std::error_code error;
    fs::create_symlink(made.path(), path, error);
    if (error) throw creation_error("create", path, error.value());
  }
  run_gnuplot(folder.string(), figure.name + ".gp");
  for (const auto& [path, made] : drawings) {
    io::remove_file(path);
    OutputFile file(path);
    made.copy_to(file);
    file.commit();
  }
}

}  // namespace

std::vector<std::string> figure_files(const figures::Figure& figure) {
  std::vector<std::string> names;
  for (const char* ending : endings) names.push_back(figure.name + ending);
  for (const figures::Table& table : figure.tables) names.push_back(figures::file_of(figure, table));
  for (const figures::FigureMap& map : figure.maps) names.push_back(figures::file_of(figure, map));
  for (const char* ending : {".gp", ".json"}) names.push_back(figure.name + ending);
  return names;
}

void write_figure(const figures::Figure& figure, std::span<const figures::RunGroup> groups,
                  const std::string& folder, const FigureOptions& options) {
  prepare_folder(folder);
  const Workshop workshop(fs::path(folder) / (figure.name + temporary_ending));
  for (const figures::Table& table : figure.tables)
    io::write_text((workshop.path / figures::file_of(figure, table)).string(), csv_text(table));
  io::write_text((workshop.path / (figure.name + ".gp")).string(), gnuplot_text(figure, options.size));
  io::write_text((workshop.path / (figure.name + ".json")).string(),
                 provenance_json(figure, groups, options.command_line));
  draw_maps(figure, workshop.path, figure_width(figure, options.size));
  draw(figure, workshop.path);
  for (const std::string& name : figure_files(figure))
    give_name((workshop.path / name).string(), (fs::path(folder) / name).string());
}

}  // namespace talus::app
