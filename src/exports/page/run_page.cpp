#include "exports/page/run_page.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>

#include "base/hash.h"
#include "base/text.h"
#include "base/version.h"
#include "core/trigonometry.h"
#include "exports/page/contact_tables.h"
#include "exports/page/curves.h"
#include "exports/page/grain_fields.h"
#include "exports/page/json.h"
#include "exports/page/map_texts.h"
#include "exports/page/sources.h"

namespace talus::exports {
namespace {

std::string end_text(const PageRun& run) {
  const double theta_c = run.analysis.theta_c;
  if (std::isfinite(theta_c)) return fmt::format("until the slope failed at θ_c = {:.2f}°", degrees(theta_c));
  return fmt::format("to {}°; the slope has not failed", degrees_text(run.file.frame_tilts().back(), 2));
}

/// Returns the title, such as "A granular slope, tilted until it fails".
std::string page_title(const PageRun& run) {
  return std::isfinite(run.analysis.theta_c) ? "A granular slope, tilted until it fails"
                                             : "A granular slope, tilted";
}

/// Returns a description of the run and of the page, as rich text.
std::string page_sentence(const PageRun& run) {
  const RunStatics& statics = run.statics();
  const double diameter = statics.mean_diameter;
  return fmt::format(
      "A bed of {} rigid disks, {:.4g} mean diameters D long and {:.3g} D deep, {}, was tilted {}. Contact "
      "Dynamics "
      "computed how the grains move and press on each other.",
      statics.free_count, statics.length / diameter, statics.depth / diameter,
      statics.periodic ? "periodic along the slope" : "between two walls", end_text(run));
}

/// Returns names and values: seed, version, hash of the state; nothing about the machine.
Facts page_provenance(const PageRun& run) {
  const io::RunHeader& header = run.file.header();
  Facts facts = {{"seed", std::to_string(header.seed)}};
  // Information about the machine and its folders is left out.
  for (const char* name : {"version", "git_hash", "compiler", "start", "end"})
    if (const auto value = find_value(header.provenance, name); value && !value->empty())
      facts.emplace_back(name, *value);
  if (run.file.has_state())
    facts.emplace_back("hash of the last state", hash_text(state_hash(run.file.checkpoint().world)));
  facts.emplace_back("page written by", version_text());
  return facts;
}

/// The data that are collected frame by frame.
struct PageParts {
  GrainFields grains;
  ContactCollector contacts;
  std::vector<MapTexts> maps;
  std::vector<LineTexts> lines;
  std::vector<std::string> captions;

  explicit PageParts(const PageRun& run) : grains(run), contacts(run) {
    for (const pictures::MapKind kind : filling_maps(run)) maps.emplace_back(run, kind);
    for (const pictures::MapKind kind : {pictures::MapKind::forces, pictures::MapKind::critical})
      lines.emplace_back(run, kind);
  }
};

void take(PageParts& parts, const PageRun& run, const PageFrame& frame) {
  pictures::MapSettings settings = run.settings;
  const std::vector<pictures::MapKind> kinds = filling_maps(run);
  for (std::size_t m = 0; m < kinds.size(); ++m) {
    settings.layers = {kinds[m]};
    const pictures::MapLayer layer = pictures::make_layer(frame.mapped(run), settings, run.extent, 0);
    parts.maps[m].add(frame, layer);
    parts.grains.add(frame, kinds[m], layer);
  }
  for (LineTexts& line : parts.lines) line.add(run, frame);
  parts.grains.add(frame);
  parts.contacts.add(frame);
  parts.captions.push_back(pictures::caption_of(frame.frame, settings));
}

/// The tables in the document, and their descriptions in its data.
struct PageTables {
  std::vector<std::string> entries;
  std::string elements;

  void add(const std::string& name, const CodeTable& table) {
    entries.push_back(json::line({{"name", json::quoted(name)},
                                  {"rows", json::number(table.rows)},
                                  {"columns", json::number(table.columns)},
                                  {"bytes", json::number(table.bytes)}}));
    elements +=
        fmt::format("<script type=\"text/plain\" id=\"table-{}\">{}</script>\n", name, packed_text(table));
  }
};

/// Converts to mean diameters, the unit of length on the page.
std::string places_json(const PlaceQuantum& quantum, double diameter) {
  return json::line(
      {{"low", json::number(quantum.low / diameter)}, {"step", json::number(quantum.step / diameter)}});
}

std::string field_json(const GrainField& field) {
  return json::line({{"name", json::quoted(field.name)},
                     {"label", json::quoted(field.label)},
                     {"unit", json::quoted(field.unit)},
                     {"digits", json::number(field.digits)},
                     {"low", json::number(field.quantum.low)},
                     {"step", json::number(field.quantum.step)},
                     {"log", json::truth(field.quantum.logarithmic)}});
}

PlaceQuantum radius_places(const RunStatics& statics) {
  return places_of_box(0.0, std::ranges::max(statics.radius));
}

CodeTable radius_table(const RunStatics& statics) {
  CodeTable table = code_table(statics.radius.size(), 1, 2);
  for (std::size_t i = 0; i < statics.radius.size(); ++i)
    table.at(i, 0) = place_code(radius_places(statics), statics.radius[i]);
  return table;
}

std::string bed_json(const PageRun& run, const PageParts& parts) {
  const RunStatics& statics = run.statics();
  const double diameter = statics.mean_diameter;
  const auto in_d = [diameter](double length) { return json::number(length / diameter); };
  const bool smooth_floor = statics.radius.size() == static_cast<std::size_t>(statics.free_count);
  return json::line({{"grains", json::number(statics.radius.size())},
                     {"free", json::number(statics.free_count)},
                     {"periodic", json::truth(statics.periodic)},
                     {"smooth_floor", json::truth(smooth_floor)},
                     {"length", in_d(statics.length)},
                     {"low", in_d(run.extent.y_min)},
                     {"high", in_d(run.extent.y_max)},
                     {"x", places_json(parts.grains.x_quantum(), diameter)},
                     {"y", places_json(parts.grains.y_quantum(), diameter)},
                     {"radius", places_json(radius_places(statics), diameter)}});
}

std::string frames_json(const PageRun& run, const PageParts& parts) {
  std::vector<std::string> numbers;
  std::vector<double> tilts;
  std::size_t tilt_frames = 0;
  for (const std::size_t k : run.frames) {
    numbers.push_back(std::to_string(k));
    tilts.push_back(degrees(run.file.all_frame_tilts()[k]));
    tilt_frames += k < run.file.frame_count() ? 1 : 0;
  }
  return json::line({{"numbers", json::list(numbers)},
                     {"tilts", json::rounded(tilts, 8)},
                     {"of_tilt", json::number(tilt_frames)},
                     {"captions", json::array(parts.captions)}});
}

std::string contacts_json(const ContactTables& contacts) {
  std::vector<std::string> planes;
  for (const TouchedPlane& plane : contacts.planes)
    planes.push_back(json::list({json::number(plane.id), json::number(plane.nx), json::number(plane.ny)}));
  return json::line({{"widest", json::number(pictures::force_lines.widest)},
                     {"half_width", json::number(pictures::force_lines.half_width)},
                     {"border", json::number(pictures::line_border)},
                     {"critical_length", json::number(pictures::critical_lines.length)},
                     {"critical_half_width", json::number(pictures::critical_lines.half_width)},
                     {"planes", json::list(planes)}});
}

template <typename Items, typename TextOf>
std::string json_list(const Items& items, const TextOf& text_of) {
  std::vector<std::string> texts;
  for (const auto& item : items) texts.push_back(text_of(item));
  return json::list(texts);
}

std::string facts_json(const Facts& facts) {
  return json_list(facts, [](const auto& fact) { return json::array({fact.first, fact.second}); });
}

PageTables tables_of(const PageRun& run, const PageParts& parts, const ContactTables& contacts) {
  PageTables tables;
  tables.add("radius", radius_table(run.statics()));
  tables.add("x", parts.grains.x());
  tables.add("y", parts.grains.y());
  for (const GrainField& field : parts.grains.fields()) tables.add(field.name, field.codes);
  tables.add("a", contacts.a);
  tables.add("b", contacts.b);
  tables.add("shift", contacts.shift);
  tables.add("force", contacts.force);
  tables.add("sliding", contacts.sliding);
  return tables;
}

std::string data_json(const PageRun& run, const std::string& name, const PageParts& parts,
                      const PageTables& tables, const ContactTables& contacts) {
  const bool failed = std::isfinite(run.analysis.theta_c);
  return json::object({{"name", json::quoted(name)},
                       {"title", json::quoted(page_title(run))},
                       {"sentence", json::quoted(page_sentence(run))},
                       {"theta_c", json::number(failed ? degrees(run.analysis.theta_c) : not_known)},
                       {"bed", bed_json(run, parts)},
                       {"frames", frames_json(run, parts)},
                       {"tables", json::list(tables.entries)},
                       {"fields", json_list(parts.grains.fields(), field_json)},
                       {"contacts", contacts_json(contacts)},
                       {"outlines", json::quoted(colour_text(pictures::outline_style().fill) +
                                                 colour_text(pictures::outline_style().rim))},
                       {"floor", json::quoted(colour_text(render::white) + colour_text(render::gray(0.75)))},
                       {"maps", json_list(parts.maps, [](const MapTexts& map) { return map.json(); })},
                       {"lines", json_list(parts.lines, [](const LineTexts& line) { return line.json(); })},
                       {"events", events_json(run)},
                       {"curves", curves_json(run)},
                       {"scenario", json::quoted(run.file.header().scenario_resolved)},
                       {"provenance", facts_json(page_provenance(run))}});
}

/// Escapes JSON for a script element, which would end at "</".
std::string escaped_for_script(const std::string& text) {
  std::string result;
  for (const char c : text)
    if (c == '<')
      result += "\\u003c";
    else
      result += c;
  return result;
}

}  // namespace

std::string run_page(const io::RunFile& file, const std::string& path, const analysis::Analysis& analysis,
                     const std::vector<std::size_t>& frames, const Watch& watch) {
  const PageRun run = begin_page(file, analysis, frames);
  PageParts parts(run);
  for_each_frame(run, watch, [&](const PageFrame& frame) { take(parts, run, frame); });
  const ContactTables contacts = parts.contacts.tables();
  const PageTables tables = tables_of(run, parts, contacts);
  const std::string name = std::filesystem::path(path).stem().string();
  return filled(page_template(), [&](std::string_view part) -> std::string {
    if (part == "title") return xml_text(fmt::format("{}: {}", page_title(run), name));
    if (part == "style") return std::string(page_style());
    if (part == "script") return page_script();
    if (part == "data") return escaped_for_script(data_json(run, name, parts, tables, contacts));
    if (part == "tables") return tables.elements;
    return std::string();
  });
}

}  // namespace talus::exports
