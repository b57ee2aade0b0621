#include "exports/page/map_texts.h"

#include <algorithm>
#include <fmt/core.h>

#include "exports/page/json.h"
#include "pictures/scale.h"

namespace talus::exports {
namespace {

std::string bar_json(const render::Bar& bar) {
  std::vector<std::string> ticks;
  for (const render::BarTick& tick : bar.ticks)
    ticks.push_back(
        json::line({{"share", fmt::format("{:.4f}", tick.share)}, {"label", json::quoted(tick.label)}}));
  return json::line({{"title", json::quoted(bar.title)}, {"ticks", json::list(ticks)}});
}

std::string swatch_json(const render::Swatch& swatch) {
  return json::line({{"kind", json::quoted(swatch.kind == render::Swatch::Kind::disc ? "disc" : "line")},
                     {"fill", json::quoted(colour_text(swatch.fill))},
                     {"rim", json::quoted(colour_text(swatch.rim))},
                     {"width", fmt::format("{:.3g}", swatch.width)},
                     {"label", json::quoted(swatch.label)}});
}

std::string legend_json(const render::Legend& legend) {
  std::vector<std::string> bars, swatches;
  for (const render::Bar& bar : legend.bars) bars.push_back(bar_json(bar));
  for (const render::Swatch& swatch : legend.swatches) swatches.push_back(swatch_json(swatch));
  return json::line({{"bars", json::list(bars)}, {"swatches", json::list(swatches)}});
}

std::string scale_json(const pictures::Scale& scale) {
  return json::line({{"low", json::number(scale.low)},
                     {"high", json::number(scale.high)},
                     {"log", json::truth(scale.logarithmic)}});
}

std::string style_text(const pictures::GrainStyle& style) {
  return colour_text(style.fill) + colour_text(style.rim);
}

/// Returns the styles of clusters, the largest first: those of the coloured clusters, that of all others, and
/// that of grains in no cluster.
std::string styles_json(const PageFrame& frame, const pictures::MapLayer& layer) {
  std::vector<std::string> styles(static_cast<std::size_t>(frame.clusters.count()));
  std::string none;
  for (std::size_t i = 0; i < layer.styles.size(); ++i) {
    const Index label = frame.clusters.label[i];
    std::string& style = label < 0 ? none : styles[static_cast<std::size_t>(label)];
    if (style.empty()) style = style_text(layer.styles[i]);
  }
  if (none.empty()) none = style_text(pictures::outline_style());
  const std::string rest = styles.empty() ? none : styles.back();
  while (!styles.empty() && styles.back() == rest) styles.pop_back();
  return json::line(
      {{"first", json::array(styles)}, {"rest", json::quoted(rest)}, {"none", json::quoted(none)}});
}

/// Returns "#ffffff..." for fills, and the same for rims: eight digits for each of 256 steps.
std::string ramp_json(const std::vector<render::Colour>& colours) {
  std::string fills, rims;
  for (const render::Colour& colour : colours) {
    fills += colour_text(colour).substr(1, 6);
    rims += colour_text(pictures::rim_of(colour)).substr(1, 6);
  }
  return json::line({{"fills", json::quoted(fills)}, {"rims", json::quoted(rims)}});
}

pictures::MapSettings settings_of_map(const PageRun& run, pictures::MapKind kind) {
  pictures::MapSettings settings = run.settings;
  settings.layers = {kind};
  return settings;
}

}  // namespace

std::string colour_text(const render::Colour& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}{:02x}", colour.red, colour.green, colour.blue, colour.alpha);
}

std::vector<pictures::MapKind> filling_maps(const PageRun& run) {
  constexpr pictures::MapKind on_pages[] = {pictures::MapKind::gamma,    pictures::MapKind::overloaded,
                                            pictures::MapKind::clusters, pictures::MapKind::coarse,
                                            pictures::MapKind::pressure, pictures::MapKind::displacement,
                                            pictures::MapKind::rotation};
  std::vector<pictures::MapKind> kinds;
  for (const pictures::MapKind kind : on_pages)
    if (run.shows(kind)) kinds.push_back(kind);
  return kinds;
}

MapTexts::MapTexts(const PageRun& run, pictures::MapKind kind)
    : kind_(kind), over_(colour_text(pictures::colour_over(settings_of_map(run, kind), 0))) {}

void MapTexts::add(const PageFrame& frame, const pictures::MapLayer& layer) {
  titles_.add(json::quoted(layer.title));
  legends_.add(legend_json(layer.legend));
  if (layer.scale) {
    scales_.add(scale_json(*layer.scale));
    ramp_ = ramp_json(render::colour_ramp(layer.scale->colours));
  } else {
    looks_.add(styles_json(frame, layer));
  }
}

std::string MapTexts::json() const {
  json::Members members = {{"name", json::quoted(std::string(pictures::map_name(kind_)))},
                           {"help", json::quoted(std::string(pictures::map_help(kind_)))},
                           {"over", json::quoted(over_)},
                           {"titles", titles_.json()},
                           {"legends", legends_.json()}};
  if (ramp_.empty())
    members.emplace_back("looks", looks_.json());
  else
    members.insert(members.end(), {{"ramp", ramp_}, {"scales", scales_.json()}});
  return json::line(members);
}

LineTexts::LineTexts(const PageRun& run, pictures::MapKind kind)
    : kind_(kind), over_{pictures::OverColour()} {
  for (const pictures::MapKind map : filling_maps(run)) {
    const pictures::OverColour over = pictures::colour_over(settings_of_map(run, map), 0);
    if (std::ranges::find(over_, over) == over_.end()) over_.push_back(over);
  }
}

void LineTexts::add(const PageRun& run, const PageFrame& frame) {
  std::vector<std::string> legends;
  for (const pictures::OverColour& over : over_) {
    const pictures::MapLayer layer = kind_ == pictures::MapKind::forces
                                         ? pictures::forces_layer(frame.mapped(run), over)
                                         : pictures::critical_layer(frame.mapped(run), over);
    legends.push_back(legend_json(layer.legend));
    if (!over) titles_.add(json::quoted(layer.title));
  }
  legends_ = std::move(legends);
}

std::string LineTexts::json() const {
  std::vector<std::string> legends;
  for (std::size_t k = 0; k < over_.size(); ++k)
    legends.push_back(json::line({{"over", json::quoted(over_[k] ? colour_text(*over_[k]) : std::string())},
                                  {"legend", legends_[k]}}));
  return json::line({{"name", json::quoted(std::string(pictures::map_name(kind_)))},
                     {"help", json::quoted(std::string(pictures::map_help(kind_)))},
                     {"titles", titles_.json()},
                     {"legends", json::list(legends)}});
}

}  // namespace talus::exports
