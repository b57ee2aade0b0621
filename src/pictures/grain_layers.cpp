#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <string>
#include <utility>

#include "analysis/overload/clusters.h"
#include "analysis/overload/coarse_graining.h"
#include "base/errors.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "pictures/layers.h"
#include "pictures/scale.h"
#include "stress/stress.h"

namespace talus::pictures {
namespace {

constexpr int dyed_layers = 8;
constexpr double dyed_column = 10.0;  // D, approximate
constexpr double second_shade = 0.7;  // factor for the channels of every second column

render::Colour shaded(const render::Colour& colour) {
  const auto channel = [](std::uint8_t full) { return static_cast<std::uint8_t>(second_shade * full); };
  return {channel(colour.red), channel(colour.green), channel(colour.blue), colour.alpha};
}

/// Returns the middle, as a fraction of the scale, of the layer in which a fraction lies.
double layer_share(double share) {
  return (std::clamp(std::floor(share * dyed_layers), 0.0, dyed_layers - 1.0) + 0.5) / dyed_layers;
}

/// Whether a position lies in a column of the second shade. The number of columns is even.
bool in_second_column(double x, double length, double diameter) {
  const double pairs = std::max(1.0, std::round(length / (2.0 * dyed_column * diameter)));
  return static_cast<long>(std::floor(2.0 * pairs * x / length)) % 2 != 0;
}

}  // namespace

MapLayer size_layer(const analysis::GrainSource& bed, const ScaleChoice& choice) {
  constexpr double alike = 0.05;  // fraction of D: range of sizes that count as equal
  const RunStatics& statics = bed.statics;
  std::vector<double> sizes;
  for (Index i = 0; i < statics.free_count; ++i)
    sizes.push_back(2.0 * statics.radius[i] / statics.mean_diameter);
  double low = 1.0, high = 1.0;
  if (!sizes.empty()) {
    low = std::ranges::min(sizes);
    high = std::ranges::max(sizes);
  }
  if (high - low < alike) {
    low -= alike;
    high += alike;
  }
  const Scale scale = chosen({render::ColourMap::viridis, low, high}, choice);
  return scaled_layer("Size of grains", scale, std::move(sizes), bar_of(scale, "diameter (D)"));
}

MapLayer dyed_layer(const analysis::GrainSource& bed, const ScaleChoice& choice, const SeenFrames* seen) {
  constexpr int max_steps = 8;
  const RunStatics& statics = bed.statics;
  const double diameter = statics.mean_diameter;
  const auto begin = [&](Index i) {
    const auto grain = static_cast<std::size_t>(i);
    return seen != nullptr && grain < seen->begin.size() ? seen->begin[grain]
                                                         : Vec2{bed.frame.x[grain], bed.frame.y[grain]};
  };
  double highest = diameter;
  for (Index i = 0; i < statics.free_count; ++i) highest = std::max(highest, begin(i).y);
  const Scale scale = chosen({render::ColourMap::viridis, 0.0, highest / diameter}, choice);
  MapLayer layer;
  std::vector<double> heights;
  layer.title = "Layers and columns of the bed as the tilt began";
  for (Index i = 0; i < statics.free_count; ++i) {
    const Vec2 at = begin(i);
    const render::Colour light =
        render::colour_at(scale.colours, layer_share(share_of(scale, at.y / diameter)));
    const render::Colour fill = in_second_column(at.x, statics.length, diameter) ? shaded(light) : light;
    layer.styles.push_back({fill, rim_of(fill)});
    heights.push_back(at.y / diameter);
  }
  render::Bar bar{"height above the floor at that time (D)", {}, {}, scale.low, scale.high};
  const std::size_t colours = render::colour_ramp(scale.colours).size();
  for (std::size_t k = 0; k < colours; ++k)
    bar.colours.push_back(render::colour_at(
        scale.colours, layer_share((static_cast<double>(k) + 0.5) / static_cast<double>(colours))));
  for (const RoundTick& tick : round_ticks(scale.low, scale.high, max_steps))
    bar.ticks.push_back({std::clamp(share_of(scale, tick.value), 0.0, 1.0), tick.label});
  bar.values = std::move(heights);
  layer.legend.bars = {bar};
  return layer;
}

namespace {

const analysis::FrameQuantity& quantity_of(MapKind kind) {
  const analysis::FrameQuantity* quantity = shown_quantity(kind);
  if (quantity == nullptr) throw Error(ExitCode::internal, "a map that shows no number for each grain");
  return *quantity;
}

Scale scale_of(MapKind kind, const analysis::GrainSource& bed, const MapSettings& settings, bool per_degree) {
  constexpr int max_ticks = 4;
  const analysis::ScaleRule rule = quantity_of(kind).map.scale;
  ScaleRange range = fixed_motion_range(kind, per_degree);
  if (fits_frames(kind)) range = settings.motion.range(kind, per_degree).value_or(range);
  if (rule == analysis::ScaleRule::by_depth) {
    const double largest = range.high * std::max(1.0, bed.statics.depth / bed.statics.mean_diameter);
    const double step = round_step(largest, max_ticks);
    range.high = std::ceil(largest / step) * step;
  }
  return {rule == analysis::ScaleRule::about_zero ? render::ColourMap::diverging : render::ColourMap::viridis,
          range.low, range.high, rule == analysis::ScaleRule::sizes};
}

/// Returns ", 5 to 99 % of grains" if the range is fitted; empty if it is fixed or chosen.
std::string fitted_text(MapKind kind, const MotionRanges& motion, bool per_degree,
                        const ScaleChoice& choice) {
  if (choice.low || !fits_frames(kind) || !motion.range(kind, per_degree)) return "";
  if (is_signed(kind)) return fmt::format(", {:.6g} % of grains", 100.0 * signed_share);
  return fmt::format(", {:.6g} to {:.6g} % of grains", 100.0 * size_shares.low, 100.0 * size_shares.high);
}

}  // namespace

ScaleRange fixed_motion_range(MapKind kind, bool per_degree) {
  const analysis::MapRule& rule = quantity_of(kind).map;
  return per_degree ? ScaleRange{rule.low_per_degree, rule.high_per_degree} : ScaleRange{rule.low, rule.high};
}

std::vector<double> map_values(MapKind kind, const analysis::GrainSource& bed, const MapSettings& settings) {
  const analysis::FrameQuantity& quantity = quantity_of(kind);
  analysis::GrainSource source = bed;
  if (needs_reference(kind)) source.degrees = motion_span(bed).degrees;
  if (is_coarse(kind)) source.length = coarse_length(bed, settings);
  const double unit = analysis::bed_unit(quantity.unit, bed.statics).value;
  std::vector<double> values = quantity.values(source, 0);
  values.resize(static_cast<std::size_t>(bed.statics.free_count));
  for (double& value : values) value /= unit;
  return values;
}

MapLayer value_layer(MapKind kind, const analysis::GrainSource& bed, const MapSettings& settings,
                     const ScaleChoice& choice) {
  const analysis::MapRule& rule = quantity_of(kind).map;
  const MotionSpan span = needs_reference(kind) ? motion_span(bed) : MotionSpan{};
  const Scale scale = chosen(scale_of(kind, bed, settings, span.per_degree), choice);
  const std::string averaged =
      is_coarse(kind) ? fmt::format(", coarse-grained over {:.6g} D", settings.length) : std::string();
  std::string title(rule.bar);
  if (title.ends_with(')'))
    title.insert(title.size() - 1, span.unit);  // "displacement (D per degree)"
  else if (!span.unit.empty())
    title += " (" + span.unit.substr(1) + ")";
  const render::Bar bar = bar_of(
      scale, title + std::string(rule.sign) + fitted_text(kind, settings.motion, span.per_degree, choice));
  MapLayer layer = scaled_layer(fmt::format("{}{}{}", rule.title, span.title, averaged), scale,
                                map_values(kind, bed, settings), bar, rule.outlines);
  if (!rule.without.empty())
    layer.legend.swatches = {disc_swatch(outline_style(), std::string(rule.without))};
  return layer;
}

namespace {

/// Values over Gamma_c at which grains are black. For gamma as in the paper's Fig. 10; lower for
/// neighbourhoods, whose averages vary less and must differ in shade about Gamma_c.
constexpr double black_gamma = 2.0, black_coarse = 1.5;

/// Returns a bar with ticks at the ends and at Gamma_c.
render::Bar stress_ratio_bar(const Scale& scale, double gamma_c, const std::string& title,
                             const std::string& end) {
  constexpr double clear_of_ends = 0.2;  // fraction of the bar, for the labels
  render::Bar bar{
      title, render::colour_ramp(scale.colours), {{0.0, number_label(scale.low)}}, scale.low, scale.high};
  const double share = share_of(scale, gamma_c);
  if (share > clear_of_ends && share < 1.0 - clear_of_ends)
    bar.ticks.push_back({share, fmt::format("Γ_c = {:.2f}", gamma_c)});
  bar.ticks.push_back({1.0, end});
  return bar;
}

}  // namespace

double coarse_length(const analysis::GrainSource& bed, const MapSettings& settings) {
  const double length = settings.length * bed.statics.mean_diameter;
  if (length > 0.0 && length <= bed.statics.length) return length;
  throw Error(
      ExitCode::usage,
      "neighbourhoods of {:.6g} D: expected a diameter above 0, up to the length of the bed, {:.6g} D",
      settings.length, bed.statics.length / bed.statics.mean_diameter);
}

double gamma_c_of(const MapSettings& settings) { return sine(settings.theta_c); }

std::string reading_text(const OverloadRule& rule) {
  return rule.l_min > 0.0 ? fmt::format("l = {:.6g} D", rule.l_min) : std::string("single grains");
}

MapLayer gamma_layer(const analysis::GrainSource& bed, const MapSettings& settings,
                     const ScaleChoice& choice) {
  const double gamma_c = gamma_c_of(settings);
  const double black = black_gamma * gamma_c;  // a single grain fails at tiny angles
  const Scale scale =
      chosen({render::ColourMap::gray, black > white_below ? white_below : 0.0, black}, choice);
  const std::string end = choice.high ? number_label(scale.high) : fmt::format("2Γ_c = {:.2f}", scale.high);
  const auto free_grains = std::span(bed.frame.gamma).first(static_cast<std::size_t>(bed.statics.free_count));
  return scaled_layer(fmt::format("Stress ratio γ of {}{}",
                                  settings.l_min > 0.0 ? "grains with their neighbours, " : std::string(),
                                  reading_text(settings)),
                      scale, {free_grains.begin(), free_grains.end()},
                      stress_ratio_bar(scale, gamma_c, "γ = q/p", end));
}

MapLayer coarse_layer(const analysis::GrainSource& bed, const MapSettings& settings,
                      const ScaleChoice& choice) {
  const double length = coarse_length(bed, settings);
  const double gamma_c = gamma_c_of(settings);
  const Scale scale = chosen({render::ColourMap::gray, 0.0, black_coarse * gamma_c}, choice);
  const std::string end = choice.high ? number_label(scale.high) : fmt::format("{:.2f}", scale.high);
  return scaled_layer(fmt::format("Stress ratio γ_l of neighbourhoods, l = {:.6g} D", settings.length), scale,
                      analysis::coarse_stress_ratio(bed, length),
                      stress_ratio_bar(scale, gamma_c, "γ_l", end));
}

namespace {

/// Shade of clusters that have no colour.
constexpr double uncoloured_shade = 0.4;

/// Returns "Γ_c" or "2Γ_c".
std::string threshold_symbol(const MapSettings& settings) {
  const double factor = settings.threshold_factor;
  return factor == 1.0 ? "Γ_c" : fmt::format("{:.6g}Γ_c", factor);
}

/// Returns "Γ_c = sin θ_c = 0.34" or "2Γ_c = 0.69".
std::string threshold_text(const MapSettings& settings) {
  return fmt::format("{} = {}{:.2f}", threshold_symbol(settings),
                     settings.threshold_factor == 1.0 ? "sin θ_c = " : "", threshold_of(settings));
}

/// Returns the colours of clusters; see make_map.
std::vector<ClusterColour> next_colours(const analysis::GrainSource& bed, const analysis::Clusters& clusters,
                                        const OverloadRule& rule, const SeenFrames* seen) {
  // Colours by another rule belong to other clusters.
  if (seen == nullptr || !(seen->rule == rule)) return ClusterColours().next(clusters);
  const std::size_t k = bed.number;
  if (k < seen->cluster_colours.size() && seen->instants[k].step == bed.frame.step)
    return seen->cluster_colours[k];
  return ClusterColours(seen->tracker).next(clusters);
}

/// Returns the looks of clusters. Those that span the bed have the first colour and a black rim.
std::vector<GrainStyle> cluster_styles(std::span<const ClusterColour> colours, const std::vector<bool>& spans,
                                       ClusterPalette chosen) {
  const std::vector<render::Colour> palette = cluster_palette(chosen);
  std::vector<GrainStyle> styles;
  for (const ClusterColour& colour : colours) {
    const auto index = static_cast<std::size_t>(std::max(0, colour.palette_index)) % (palette.size() - 1);
    const render::Colour fill =
        colour.palette_index < 0 ? render::gray(uncoloured_shade) : palette[1 + index];
    styles.push_back({fill, rim_of(fill)});
  }
  for (std::size_t k = 0; k < styles.size(); ++k)
    if (spans[k]) styles[k] = {palette.front(), render::black};
  return styles;
}

std::string clusters_title(const analysis::Clusters& clusters, const MapSettings& settings) {
  const std::string title = "Clusters of overloaded grains, " + reading_text(settings);
  if (clusters.count() == 0) return title + ", no cluster";
  return fmt::format("{}, {}, largest {:.0f} %", title,
                     counted(static_cast<std::size_t>(clusters.count()), "cluster"),
                     100.0 * clusters.size[0] / clusters.members);
}

/// Returns the look of each free grain: black if gamma >= threshold, otherwise white; with `over_grains`, a
/// mark in a grain that another layer fills.
std::vector<GrainStyle> overload_styles(const BedFrame& bed, double threshold, bool over_grains) {
  std::vector<GrainStyle> styles;
  for (Index i = 0; i < bed.statics.free_count; ++i) {
    const bool overloaded = stress::is_overloaded(bed.frame.gamma[i], threshold);
    const render::Colour fill = overloaded ? render::black : render::white;
    styles.push_back({fill, over_grains ? render::white : rim_of(fill), overloaded});
  }
  return styles;
}

}  // namespace

MapLayer overloaded_layer(const analysis::GrainSource& bed, const MapSettings& settings, bool over_grains) {
  const double threshold = threshold_of(settings);
  const stress::OverloadCount count = stress::count_overloaded(bed, threshold);
  MapLayer layer;
  layer.title = settings.l_min > 0.0 ? "Overloaded grains, " + reading_text(settings)
                                     : "Overloaded " + reading_text(settings);
  if (count.loaded > 0) layer.title += fmt::format(", p_o = {:.3f}", count.fraction());
  layer.styles = overload_styles(bed, threshold, over_grains);
  layer.legend.swatches = {disc_swatch({render::black, render::black}, "γ ≥ " + threshold_text(settings))};
  if (!over_grains)
    layer.legend.swatches.push_back(
        disc_swatch({render::white, rim_of(render::white)}, "γ < " + threshold_symbol(settings)));
  return layer;
}

MapLayer clusters_layer(const analysis::GrainSource& bed, const MapSettings& settings, bool over_grains,
                        const SeenFrames* seen) {
  const analysis::Clusters clusters = overloaded_clusters(bed, settings);
  const std::vector<GrainStyle> styles =
      cluster_styles(next_colours(bed, clusters, settings, seen),
                     analysis::find_spanning(clusters, analysis::bed_edges(bed)).each, settings.palette);
  MapLayer layer;
  layer.title = clusters_title(clusters, settings);
  for (const Index label : clusters.label)
    layer.styles.push_back(label < 0 ? outline_style() : styles[static_cast<std::size_t>(label)]);
  // The same entries in every frame, so that they keep their places in movies and panels.
  layer.legend.swatches = {
      disc_swatch({cluster_palette(settings.palette).front(), render::black}, "spans the bed"),
      disc_swatch({render::gray(uncoloured_shade), rim_of(render::gray(uncoloured_shade))},
                  fmt::format("fewer than {} grains", smallest_coloured_cluster))};
  if (!over_grains)
    layer.legend.swatches.push_back(disc_swatch(outline_style(), "γ < " + threshold_text(settings)));
  return layer;
}

}  // namespace talus::pictures
