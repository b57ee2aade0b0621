/// `talus maps`: the maps, traces and colours that there are, as tables.

#include <algorithm>
#include <cstdio>
#include <fmt/core.h>
#include <sstream>
#include <vector>

#include "analysis/quantities.h"
#include "app/commands.h"
#include "app/help_text.h"
#include "app/terminal.h"
#include "core/text.h"
#include "pictures/map_kind.h"
#include "pictures/traces.h"
#include "render/colour_map.h"

namespace talus {
namespace {

constexpr std::size_t first_width = 15, shows_width = 40, options_width = 21;

/// The options that change a map, of those that do not change all.
std::string options_of(MapKind kind) {
  std::string options;
  const auto add = [&options](bool has, const char* name) {
    if (has) options.append(options.empty() ? "" : ", ").append(name);
  };
  add(needs_theta_c(kind), "--theta-c");
  add(shows_gamma(kind), "--l-min");
  add(kind == MapKind::overloaded || kind == MapKind::clusters, "--threshold");
  add(kind == MapKind::clusters, "--joined");
  add(is_coarse(kind), "--length");
  add(needs_reference(kind), "--since");
  return options;
}

std::string options_of(TraceKind kind) {
  return std::string(needs_theta_c(kind) ? "--theta-c, --l-min, --threshold" : "") +
         (kind == TraceKind::largest_cluster ? ", --joined" : "");
}

std::vector<std::string> lines_of(const std::string& text, std::size_t width) {
  std::istringstream lines(wrapped(text, width));
  std::vector<std::string> all;
  for (std::string line; std::getline(lines, line);) all.push_back(line);
  return all;
}

/// A row of a table; a cell takes as many lines as it needs.
void print_row(std::string_view name, const std::string& shows, const std::string& options) {
  const std::vector<std::string> left = {std::string(name)}, middle = lines_of(shows, shows_width),
                                 right = lines_of(options, options_width);
  const auto line = [](const std::vector<std::string>& cell, std::size_t k) {
    return k < cell.size() ? cell[k] : std::string();
  };
  for (std::size_t k = 0; k < std::max({left.size(), middle.size(), right.size()}); ++k) {
    std::string text = fmt::format("{:{}}  {:{}}  {}", line(left, k), first_width, line(middle, k),
                                   shows_width, line(right, k));
    text.erase(text.find_last_not_of(' ') + 1);
    print("%s\n", text.c_str());
  }
}

void print_maps() {
  print_row("--map", "shows", "options");
  for (const MapKind kind : map_kinds())
    print_row(map_name(kind), std::string(map_help(kind)), options_of(kind));
  print("\nTwo are overlaid with a plus: --map gamma+forces. Several with commas are several pictures.\n\n");
  print_row("--trace", "shows", "options");
  for (const TraceKind kind : trace_kinds())
    print_row(trace_name(kind), shown_title(trace_quantity(kind)), options_of(kind));
  print("\n");
  print_row("--colours", joined(colour_maps(), ", ", colour_map_name), "");
  print("\ntalus render, panel, animate, view and run --frames draw them; docs/maps.md shows each.\n");
}

}  // namespace

void add_maps_command(CLI::App& app) {
  app.add_subcommand("maps", "List what can be drawn: maps, traces and colours")->callback(print_maps);
}

}  // namespace talus
