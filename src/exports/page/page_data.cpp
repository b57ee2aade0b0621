#include "exports/page/page_data.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numeric>

#include "base/errors.h"

namespace talus::exports {
namespace {

/// Resolutions finer than the display: a shade of a map is 1/256 of its range.
constexpr double ratio_step = 1.0 / 4000.0;
constexpr double pressure_step = 1.0 / 200.0;  // rho g D
constexpr double length_step = 1.0 / 100.0;    // D
constexpr Quantum motion{1e-7, 0.02, true};    // D, or D per degree
constexpr double rotation_steps = 400.0;       // steps up to the end of the scale
constexpr double middle_code = 32767.0;

/// Returns the quantum of rotations, which are signed and centred on zero.
Quantum rotation_quantum(const pictures::MapSettings& settings) {
  const auto per_degree = settings.motion.range(pictures::MapKind::rotation, true);
  const auto fitting = per_degree ? per_degree : settings.motion.range(pictures::MapKind::rotation, false);
  const double step =
      fitting.value_or(pictures::fixed_motion_range(pictures::MapKind::rotation, true)).high / rotation_steps;
  return {-middle_code * step, step};
}

/// Returns the fields of maps with a bar, of l_c, and of clusters (their numbers; no_code outside them).
std::vector<GrainField> grain_fields(const PageRun& run) {
  using pictures::MapKind;
  const CodeTable codes =
      code_table(static_cast<std::size_t>(run.statics().free_count), run.frames.size(), 2, no_code);
  std::vector<GrainField> fields;
  const auto add = [&](MapKind kind, const std::string& label, const char* unit, const Quantum& quantum) {
    if (run.shows(kind))
      fields.push_back({std::string(pictures::map_name(kind)), label, unit, 3, quantum, codes});
  };
  add(MapKind::gamma,
      "γ, " + (run.settings.l_min > 0.0 ? pictures::reading_text(run.settings) : "of the grain alone"), "",
      {0.0, ratio_step});
  add(MapKind::coarse, fmt::format("γ_l, l = {:.6g} D", run.settings.length), "", {0.0, ratio_step});
  add(MapKind::pressure, "P", "ρgD", {-1.0, pressure_step});
  const bool by_time = run.file.goes_by_time();
  add(MapKind::displacement, "moved", by_time ? "D" : "D per degree", motion);
  add(MapKind::rotation, "turned", by_time ? "°" : "° per degree", rotation_quantum(run.settings));
  if (!run.has_threshold()) return fields;
  fields.push_back({"lc", "ℓ_c", "D", 3, {0.0, length_step}, codes});
  fields.push_back({"cluster", "", "", 0, {0.0, 1.0}, codes});
  return fields;
}

/// Returns "#rrggbbaa".
std::string colour_text(const render::Colour& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}{:02x}", colour.red, colour.green, colour.blue, colour.alpha);
}

std::string style_text(const render::Colour& fill, const render::Colour& rim) {
  return colour_text(fill) + colour_text(rim);
}

Json legend_json(const render::Legend& legend) {
  Json bars = Json::array(), swatches = Json::array();
  for (const render::Bar& bar : legend.bars) {
    Json ticks = Json::array();
    for (const render::BarTick& tick : bar.ticks)
      ticks.push_back({{"share", rounded(tick.share, "{:.4f}")}, {"label", tick.label}});
    bars.push_back({{"title", bar.title}, {"ticks", ticks}});
  }
  for (const render::Swatch& swatch : legend.swatches)
    swatches.push_back({{"kind", swatch.kind == render::Swatch::Kind::disc ? "disc" : "line"},
                        {"fill", colour_text(swatch.fill)},
                        {"rim", colour_text(swatch.rim)},
                        {"width", rounded(swatch.width, "{:.3g}")},
                        {"label", swatch.label}});
  return {{"bars", bars}, {"swatches", swatches}};
}

/// Returns the styles of clusters, the largest first: those of the coloured clusters, that of all others, and
/// that of grains in no cluster.
Json styles_json(const analysis::Clusters& clusters, const pictures::MapLayer& layer) {
  const pictures::GrainStyle outline = pictures::outline_style();
  std::vector<std::string> styles(clusters.size.size());
  std::string none;
  for (std::size_t i = 0; i < layer.styles.size(); ++i) {
    const Index label = clusters.label[i];
    std::string& style = label < 0 ? none : styles[static_cast<std::size_t>(label)];
    if (style.empty()) style = style_text(layer.styles[i].fill, layer.styles[i].rim);
  }
  if (none.empty()) none = style_text(outline.fill, outline.rim);
  const std::string rest = styles.empty() ? none : styles.back();
  while (!styles.empty() && styles.back() == rest) styles.pop_back();
  return {{"first", styles}, {"rest", rest}, {"none", none}};
}

/// Returns "ffffff..." for fills, and the same for rims: six digits for each of 256 steps.
Json ramp_json(const std::vector<render::Colour>& colours) {
  std::string fills, rims;
  for (const render::Colour& colour : colours) {
    fills += colour_text(colour).substr(1, 6);
    rims += colour_text(pictures::rim_of(colour)).substr(1, 6);
  }
  return {{"fills", fills}, {"rims", rims}};
}

pictures::OverColour colour_over(const PageRun& run, pictures::MapKind kind) {
  pictures::MapSettings settings = run.settings;
  settings.layers = {kind};
  return pictures::colour_over(settings, 0);
}

/// Converts to mean diameters, the unit of length on the page.
Json places_json(const Quantum& places, double diameter) {
  return {{"low", places.low / diameter}, {"step", places.step / diameter}};
}

Json named(pictures::MapKind kind) {
  return {{"name", pictures::map_name(kind)}, {"help", pictures::map_help(kind)}};
}

}  // namespace

Json rounded(double value, const char* format) {
  return std::isfinite(value) ? Json(std::stod(fmt::format(fmt::runtime(format), value))) : Json();
}

Json rounded(const std::vector<double>& values, const char* format) {
  Json list = Json::array();
  for (const double value : values) list.push_back(rounded(value, format));
  return list;
}

void DistinctEntries::add(const Json& entry) {
  const auto found = std::find(kinds.begin(), kinds.end(), entry);
  of.push_back(found - kinds.begin());
  if (found == kinds.end()) kinds.push_back(entry);
}

std::vector<pictures::MapKind> filling_maps(const PageRun& run) {
  std::vector<pictures::MapKind> kinds = {
      pictures::MapKind::gamma,    pictures::MapKind::overloaded, pictures::MapKind::clusters,
      pictures::MapKind::coarse,   pictures::MapKind::pressure,   pictures::MapKind::displacement,
      pictures::MapKind::rotation,
  };
  std::erase_if(kinds, [&](pictures::MapKind kind) { return !run.shows(kind); });
  return kinds;
}

PageData::PageData(const PageRun& run)
    : run_(run),
      x_places_(run.statics().periodic ? places_of_period(run.statics().length)
                                       : places_of_box(0.0, run.statics().length)),
      y_places_(places_of_box(run.extent.y_min, run.extent.y_max)),
      radius_places_(places_of_box(0.0, std::ranges::max(run.statics().radius))),
      x_(code_table(run.statics().radius.size(), run.frames.size())),
      y_(x_),
      fields_(grain_fields(run)),
      over_{pictures::OverColour()} {
  for (const pictures::MapKind kind : filling_maps(run)) {
    maps_.push_back({kind, {}, {}, {}, {}, {}});
    const pictures::OverColour over = colour_over(run, kind);
    if (std::ranges::find(over_, over) == over_.end()) over_.push_back(over);
  }
  for (const pictures::MapKind kind : {pictures::MapKind::forces, pictures::MapKind::critical})
    lines_.push_back({kind, {}, {}});
}

GrainField& PageData::field(std::string_view name) {
  const auto found = std::ranges::find(fields_, name, &GrainField::name);
  if (found == fields_.end()) throw Error(ExitCode::internal, "a grain field is missing");
  return *found;
}

void PageData::add_map(PageMap& map, const analysis::GrainSource& frame, const pictures::SeenFrames& seen,
                       const analysis::Clusters& clusters) {
  pictures::MapSettings settings = run_.settings;
  settings.layers = {map.kind};
  const pictures::MapLayer layer = pictures::make_layer(frame, settings, run_.extent, 0, &seen);
  map.titles.add(layer.title);
  map.legends.add(legend_json(layer.legend));
  if (layer.scale) {
    map.scales.add(
        {{"low", layer.scale->low}, {"high", layer.scale->high}, {"log", layer.scale->logarithmic}});
    map.ramp = ramp_json(render::colour_ramp(layer.scale->colours));
  } else {
    map.looks.add(styles_json(clusters, layer));
  }
  if (layer.values.empty()) return;
  GrainField& values = field(pictures::map_name(map.kind));
  for (std::size_t i = 0; i < layer.values.size(); ++i) values.set(i, column(), layer.values[i]);
}

void PageData::add_contacts(const Frame& frame) {
  const FrameContacts& contacts = frame.contacts;
  const double mean = std::accumulate(contacts.fn.begin(), contacts.fn.end(), 0.0) / contacts.count();
  for (Index c = 0; c < contacts.count(); ++c) {
    touches_[{contacts.a[c], contacts.b[c], contacts.shift[c]}].push_back(
        {column(), force_code(contacts.fn[c] / mean),
         contacts.status[c] == ContactStatus::sliding ? 1U : 0U});
    if (contacts.b[c] >= frame.grain_count()) planes_[contacts.b[c]] = {contacts.nx[c], contacts.ny[c]};
  }
}

void PageData::add(const analysis::GrainSource& frame, const pictures::SeenFrames& seen,
                   const analysis::Clusters& clusters, const std::vector<float>& lc) {
  for (PageMap& map : maps_) add_map(map, frame, seen, clusters);
  for (PageLines& lines : lines_) {
    lines.legends = Json::array();
    for (const pictures::OverColour& over : over_) {
      const auto layer_of =
          lines.kind == pictures::MapKind::forces ? pictures::forces_layer : pictures::critical_layer;
      const pictures::MapLayer layer = layer_of(frame, over);
      if (!over) lines.titles.add(layer.title);
      lines.legends.push_back(
          {{"over", over ? colour_text(*over) : ""}, {"legend", legend_json(layer.legend)}});
    }
  }
  for (std::size_t i = 0; i < frame.frame.x.size(); ++i) {
    x_.at(i, column()) = place_code(x_places_, frame.frame.x[i]);
    y_.at(i, column()) = place_code(y_places_, frame.frame.y[i]);
  }
  add_contacts(frame.frame);
  if (run_.has_threshold()) add_lengths(clusters, lc);
  captions_.push_back(pictures::caption_of(frame.frame, run_.settings));
}

void PageData::add_lengths(const analysis::Clusters& clusters, const std::vector<float>& lc) {
  GrainField &lengths = field("lc"), &numbers = field("cluster");
  for (std::size_t i = 0; i < clusters.label.size(); ++i) {
    lengths.set(i, column(), static_cast<double>(lc[i]) / run_.statics().mean_diameter);
    numbers.set(i, column(), clusters.label[i] < 0 ? not_known : static_cast<double>(clusters.label[i]));
  }
}

Json PageData::json() const {
  const RunStatics& statics = run_.statics();
  const double diameter = statics.mean_diameter;
  std::vector<double> tilts, places;
  for (const std::size_t k : run_.frames) {
    tilts.push_back(degrees(run_.file.all_frame_tilts()[k]));
    places.push_back(run_.place(k));
  }
  const auto flow = std::ranges::lower_bound(run_.frames, run_.file.frame_count());
  Json fields = Json::array(), maps = Json::array(), lines = Json::array(), planes = Json::array();
  for (const GrainField& field : fields_)
    fields.push_back({{"name", field.name},
                      {"label", field.label},
                      {"unit", field.unit},
                      {"digits", field.digits},
                      {"low", field.quantum.low},
                      {"step", field.quantum.step},
                      {"log", field.quantum.logarithmic}});
  for (const PageMap& map : maps_) {
    Json json = named(map.kind);
    json.update({{"over", colour_text(*colour_over(run_, map.kind))},
                 {"titles", map.titles.json()},
                 {"legends", map.legends.json()}});
    if (map.ramp.is_null())
      json["looks"] = map.looks.json();
    else
      json.update({{"ramp", map.ramp}, {"scales", map.scales.json()}});
    maps.push_back(json);
  }
  for (const PageLines& entry : lines_) {
    lines.push_back(named(entry.kind));
    lines.back().update({{"titles", entry.titles.json()}, {"legends", entry.legends}});
  }
  for (const auto& [id, normal] : planes_) planes.push_back(Json::array({id, normal[0], normal[1]}));
  const pictures::GrainStyle outline = pictures::outline_style();
  return {{"bed",
           {{"grains", statics.radius.size()},
            {"free", statics.free_count},
            {"periodic", statics.periodic},
            {"smooth_floor", statics.radius.size() == static_cast<std::size_t>(statics.free_count)},
            {"length", statics.length / diameter},
            {"low", run_.extent.y_min / diameter},
            {"high", run_.extent.y_max / diameter},
            {"x", places_json(x_places_, diameter)},
            {"y", places_json(y_places_, diameter)},
            {"radius", places_json(radius_places_, diameter)}}},
          {"frames",
           {{"numbers", run_.frames},
            {"tilts", rounded(tilts, "{:.8g}")},
            {"places", rounded(places, "{:.8g}")},
            {"by_time", run_.file.goes_by_time()},
            {"of_tilt", flow - run_.frames.begin()},
            {"captions", captions_}}},
          {"fields", fields},
          {"contacts",
           {{"widest", pictures::force_lines.widest},
            {"half_width", pictures::force_lines.half_width},
            {"border", pictures::line_border},
            {"critical_length", pictures::critical_lines.length},
            {"critical_half_width", pictures::critical_lines.half_width},
            {"planes", planes}}},
          {"outlines", style_text(outline.fill, outline.rim)},
          {"floor", style_text(render::white, render::gray(0.75))},
          {"maps", maps},
          {"lines", lines}};
}

std::vector<std::pair<std::string, CodeTable>> PageData::tables() const {
  const std::size_t rows = touches_.size(), columns = run_.frames.size();
  CodeTable radius = code_table(run_.statics().radius.size(), 1);
  for (std::size_t i = 0; i < radius.rows; ++i)
    radius.at(i, 0) = place_code(radius_places_, run_.statics().radius[i]);
  CodeTable a = code_table(rows, 1, 4), b = a, shift = code_table(rows, 1, 1),
            force = code_table(rows, columns, 1), sliding = force;
  std::size_t row = 0;
  for (const auto& [pair, touches] : touches_) {
    a.at(row, 0) = static_cast<std::uint32_t>(std::get<0>(pair));
    b.at(row, 0) = static_cast<std::uint32_t>(std::get<1>(pair));
    shift.at(row, 0) = static_cast<std::uint8_t>(std::get<2>(pair));  // 0, 1, or 255 for -1
    for (const Touch& touch : touches) {
      force.at(row, touch.column) = touch.force;
      sliding.at(row, touch.column) = touch.sliding;
    }
    ++row;
  }
  std::vector<std::pair<std::string, CodeTable>> tables = {{"radius", radius}, {"x", x_}, {"y", y_}};
  for (const GrainField& field : fields_) tables.emplace_back(field.name, field.codes);
  tables.insert(tables.end(), {{"a", a}, {"b", b}, {"shift", shift}, {"force", force}, {"sliding", sliding}});
  return tables;
}

}  // namespace talus::exports
