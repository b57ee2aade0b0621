#include "app/figure_files.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <mutex>
#include <optional>
#include <utility>

#include "app/gnuplot.h"
#include "app/json.h"
#include "base/descriptor.h"
#include "base/errors.h"
#include "base/locked_file.h"
#include "base/output_file.h"
#include "base/version.h"
#include "io/durable_file.h"
#include "pictures/maps.h"
#include "pictures/panel.h"
#include "render/document.h"
#include "render/png.h"
#include "render/renderer.h"

namespace talus::app {
namespace {

namespace fs = std::filesystem;

constexpr double dots_per_cm = 400.0 / 2.54;
constexpr const char* endings[] = {".pdf", ".svg", ".png"};

/// Temporary folder, removed with its contents by the destructor. A folder left by a killed process is
/// replaced.
struct Workshop {
  explicit Workshop(const fs::path& folder) : path(folder), lock(create_locked_folder(folder.string())) {
    if (!lock)
      throw Error(ExitCode::cannot_create, folder.stem().stem().string() +
                                               " is being drawn by another process in the same folder; wait "
                                               "for it to end, or choose another folder with -o");
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

/// Draws a figure of maps as a panel, on a page of its own width, no higher than requested or than a page
/// with a caption.
void draw_maps(const figures::Figure& figure, const fs::path& folder, const FigureSize& size) {
  static std::mutex drawing;       // limits the memory to that of one picture
  constexpr double highest = 1.4;  // over the width
  const std::lock_guard one_at_a_time(drawing);
  const double width = figure_width(figure, size);
  std::vector<std::vector<render::FrameView>> maps = figure.maps;
  for (std::vector<render::FrameView>& row : maps)
    for (render::FrameView& view : row) pictures::print_letters(view, width, 8.0);
  const auto pixels = [](double cm) { return static_cast<int>(std::lround(cm * dots_per_cm)); };
  const render::Sheet sheet = pictures::panel_sheet(maps, "", pixels(width),
                                                    pixels(size.height > 0.0 ? size.height : highest * width),
                                                    render::embedded_font());
  render::Renderer renderer(render::make_context(std::nullopt));
  for (const char* ending : endings) {
    const std::string path = (folder / (figure.name + ending)).string();
    if (render::is_document(path))
      render::write_document(path, sheet, 0.01 * width,
                             {{"Software", version_text()}, {"Source", figure.title}});
    else
      render::write_png(path, renderer.draw(sheet), {{"Software", version_text()}}, 0.01 * width);
  }
}

/// Runs gnuplot with output into memory, because gnuplot exits successfully even if it could not write
/// everything. PNG files state their printed width (cm).
void draw(const figures::Figure& figure, const fs::path& folder, double width) {
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
    if (path.ends_with(".png")) {
      std::vector<std::uint8_t> bytes = made.bytes();
      render::print_at(bytes, 0.01 * width);
      file.write(bytes);
    } else {
      made.copy_to(file);
    }
    file.commit();
  }
}

}  // namespace

std::vector<std::string> figure_files(const figures::Figure& figure) {
  std::vector<std::string> names;
  for (const char* ending : endings) names.push_back(figure.name + ending);
  for (const figures::Table& table : figure.tables) names.push_back(figures::file_of(figure, table));
  if (figure.maps.empty()) names.push_back(figure.name + ".gp");
  names.push_back(figure.name + ".json");
  return names;
}

std::vector<std::string> earlier_figure_files(const std::string& folder, const std::string& name) {
  const std::string provenance = name + ".json";
  std::vector<std::string> names;
  try {
    const Json json = Json::parse(io::read_text((fs::path(folder) / provenance).string()));
    if (json.at("figure") != name) return {};
    for (const Json& table : json.at("tables")) {
      const std::string file = table.at("file");
      if (file.starts_with(name + "-") && file.ends_with(".csv") && file.find('/') == std::string::npos)
        names.push_back(file);
    }
  } catch (const Error&) {
    return {};
  } catch (const Json::exception&) {
    return {};
  }
  for (const char* ending : endings) names.push_back(name + ending);
  names.push_back(name + ".gp");
  names.push_back(provenance);
  return names;
}

void remove_earlier_figure(const std::string& folder, const std::vector<std::string>& earlier,
                           const std::vector<std::string>& names) {
  for (const std::string& name : earlier)
    if (std::ranges::find(names, name) == names.end()) io::remove_file((fs::path(folder) / name).string());
}

void write_figure(const figures::Figure& figure, std::span<const figures::RunGroup> groups,
                  const std::string& folder, const FigureOptions& options) {
  prepare_folder(folder);
  const Workshop workshop(fs::path(folder) / (figure.name + temporary_ending));
  for (const figures::Table& table : figure.tables)
    io::write_text((workshop.path / figures::file_of(figure, table)).string(), csv_text(table));
  if (figure.maps.empty())
    io::write_text((workshop.path / (figure.name + ".gp")).string(), gnuplot_text(figure, options.size));
  io::write_text((workshop.path / (figure.name + ".json")).string(),
                 provenance_json(figure, groups, options.command_line));
  if (figure.maps.empty())
    draw(figure, workshop.path, figure_width(figure, options.size));
  else
    draw_maps(figure, workshop.path, options.size);
  const std::vector<std::string> earlier = earlier_figure_files(folder, figure.name),
                                 names = figure_files(figure);
  for (const std::string& name : names)
    publish_file((workshop.path / name).string(), (fs::path(folder) / name).string());
  remove_earlier_figure(folder, earlier, names);
}

}  // namespace talus::app
