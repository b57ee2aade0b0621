/// `talus maps`: lists the available maps, traces and colours.

#include <algorithm>
#include <fmt/core.h>
#include <sstream>
#include <vector>

#include "analysis/quantities.h"
#include "app/commands.h"
#include "app/help_text.h"
#include "app/terminal.h"
#include "base/text.h"
#include "base/text_table.h"
#include "pictures/cluster_colours.h"
#include "pictures/map_kind.h"
#include "pictures/traces.h"
#include "render/colour_map.h"

namespace talus::app {
namespace {

constexpr std::size_t shows_width = 40, options_width = 21;

/// Returns the options that affect a map but not all maps.
std::string options_of(pictures::MapKind kind) {
  std::string options;
  const auto add = [&options](bool has, const char* name) {
    if (has) options.append(options.empty() ? "" : ", ").append(name);
  };
  add(pictures::needs_theta_c(kind), "--theta-c");
  add(pictures::shows_gamma(kind), "--l-min");
  add(kind == pictures::MapKind::overloaded || kind == pictures::MapKind::clusters, "--threshold");
  add(kind == pictures::MapKind::clusters, "--joined");
  add(pictures::is_coarse(kind), "--length");
  add(pictures::needs_reference(kind), "--since");
  return options;
}

std::string options_of(pictures::TraceKind kind) {
  return std::string(pictures::needs_theta_c(kind) ? "--theta-c, --l-min, --threshold" : "") +
         (kind == pictures::TraceKind::largest_cluster ? ", --joined" : "");
}

std::vector<std::string> lines_of(const std::string& text, std::size_t width) {
  std::istringstream lines(wrapped(text, width));
  std::vector<std::string> all;
  for (std::string line; std::getline(lines, line);) all.push_back(line);
  return all;
}

/// Adds a row; its cells may have several lines.
void add_row(TextTable& table, std::string_view name, std::string_view shows, const std::string& options) {
  const std::vector<std::string> middle = lines_of(std::string(shows), shows_width),
                                 right = lines_of(options, options_width);
  for (std::size_t k = 0; k < std::max(middle.size(), right.size()); ++k)
    table.rows.push_back({{k == 0 ? std::string(name) : ""},
                          {k < middle.size() ? middle[k] : ""},
                          {k < right.size() ? right[k] : ""}});
}

void print_maps() {
  TextTable maps{{{"--map"}, {"shows"}, {"options"}}, {}}, traces{{{"--trace"}, {"shows"}, {"options"}}, {}};
  for (const pictures::MapKind kind : pictures::map_kinds())
    add_row(maps, pictures::map_name(kind), pictures::map_help(kind), options_of(kind));
  for (const pictures::TraceKind kind : pictures::trace_kinds())
    add_row(traces, pictures::trace_name(kind), analysis::shown_title(pictures::trace_quantity(kind)),
            options_of(kind));
  print_text(fmt::format(
      "{}\nA plus overlays two maps: --map gamma+forces. Commas separate several pictures.\n\n{}\n--colours: "
      "{}; _r reverses them;\nof clusters: {}\n\ntalus render, panel, animate, view and run --pictures draw "
      "them; docs/maps.md shows each.\n",
      aligned_text(maps), aligned_text(traces), joined(render::colour_maps(), ", ", render::colour_map_name),
      joined(pictures::cluster_palettes, " or ", pictures::palette_name)));
}

}  // namespace

void add_maps_command(CLI::App& app) {
  app.add_subcommand("maps", "List the available maps, traces and colours")->callback(print_maps);
}

}  // namespace talus::app
