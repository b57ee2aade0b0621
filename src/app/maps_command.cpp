/// `talus maps`: lists the available maps, traces and colours. Its help describes the options of maps, which
/// that of the commands that draw only names.

#include <algorithm>
#include <fmt/core.h>
#include <sstream>
#include <vector>

#include "analysis/quantities.h"
#include "app/commands.h"
#include "app/help_text.h"
#include "app/map_options.h"
#include "app/terminal.h"
#include "base/text.h"
#include "pictures/cluster_colours.h"
#include "pictures/map_kind.h"
#include "pictures/traces.h"
#include "render/colour.h"

namespace talus::app {
namespace {

constexpr std::size_t shows_width = 44, parameters_width = 24;

/// Returns the parameters of --set, and the options, that affect a map but not all maps.
std::string parameters_of(pictures::MapKind kind) {
  std::string parameters;
  const auto add = [&parameters](bool has, const char* name) {
    if (has) parameters.append(parameters.empty() ? "" : ", ").append(name);
  };
  add(pictures::needs_theta_c(kind), "gamma_c");
  add(pictures::shows_gamma(kind), "l_min");
  add(kind == pictures::MapKind::overloaded || kind == pictures::MapKind::clusters, "threshold_factors");
  add(kind == pictures::MapKind::clusters, "joining");
  add(pictures::is_coarse(kind), "length");
  add(pictures::needs_reference(kind), "--since");
  return parameters;
}

std::string parameters_of(pictures::TraceKind kind) {
  return std::string(pictures::needs_theta_c(kind) ? "gamma_c, l_min, threshold_factors" : "") +
         (kind == pictures::TraceKind::largest_cluster ? ", joining" : "");
}

std::vector<std::string> lines_of(const std::string& text, std::size_t width) {
  std::istringstream lines(wrapped(text, width));
  std::vector<std::string> all;
  for (std::string line; std::getline(lines, line);) all.push_back(line);
  return all;
}

/// Adds a row; its cells may have several lines.
void add_row(TextTable& table, std::string_view name, std::string_view shows, const std::string& parameters) {
  const std::vector<std::string> middle = lines_of(std::string(shows), shows_width),
                                 right = lines_of(parameters, parameters_width);
  for (std::size_t k = 0; k < std::max(middle.size(), right.size()); ++k)
    table.rows.push_back({{k == 0 ? std::string(name) : ""},
                          {k < middle.size() ? middle[k] : ""},
                          {k < right.size() ? right[k] : ""}});
}

void print_maps() {
  TextTable maps{{{"--map"}, {"shows"}, {"depends on"}}, {}},
      traces{{{"--trace"}, {"shows"}, {"depends on"}}, {}};
  for (const pictures::MapKind kind : pictures::map_kinds())
    add_row(maps, pictures::map_name(kind), pictures::map_help(kind), parameters_of(kind));
  for (const pictures::TraceKind kind : pictures::trace_kinds())
    add_row(traces, pictures::trace_name(kind), analysis::shown_title(pictures::trace_quantity(kind)),
            parameters_of(kind));
  print_text(fmt::format(
      "{}\nA plus overlays two maps: --map gamma+forces. Commas separate several pictures.\n\n{}\n--colours: "
      "{}; _r reverses them;\nof clusters: {}\n\ntalus maps --help describes the options of pictures; "
      "docs/maps.md shows each map.\n",
      aligned_text(maps), aligned_text(traces), joined(render::colour_maps(), ", ", render::colour_map_name),
      joined(pictures::cluster_palettes, " or ", pictures::palette_name)));
}

}  // namespace

void add_maps_command(CLI::App& app) {
  CLI::App page;
  CLI::App* const options = page.add_subcommand("render");
  MapArguments unused;
  add_map_options(*options, unused, MapOptionSet::all);
  app.add_subcommand("maps", "List the available maps, traces and colours; the help describes their options")
      ->callback(print_maps)
      ->footer(
          "Options of talus render, panel and animate, and --map, --size, --colours and\n--context of talus "
          "run --pictures:\n" +
          option_rows(*options));
}

}  // namespace talus::app
