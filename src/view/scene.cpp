#include "view/scene.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <utility>

#include "base/errors.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "pictures/bed_view.h"
#include "pictures/change_map.h"
#include "pictures/cluster_colours.h"
#include "pictures/layers.h"
#include "render/colour.h"

namespace talus::view {
namespace {

constexpr render::Colour light_wall{190, 196, 206};

void add_grains(render::FrameView& view, const render::FrameView& map) {
  view.discs.reserve(map.discs.size());
  for (const render::Disc& disc : map.discs)
    if (pictures::is_seen(view, disc)) view.discs.push_back(disc);
  for (const render::Line& line : map.lines)
    if (pictures::is_seen(view, line)) view.lines.push_back(line);
}

/// Adds side walls and a smooth floor, in a light colour if the background is not white.
void add_boundary(render::FrameView& view, const BedFrame& bed) {
  const RunStatics& statics = bed.statics;
  const render::Colour colour = view.transparent ? light_wall : render::black;
  const auto add = [&](double x0, double y0, double x1, double y1) {
    view.lines.push_back(pictures::line_between(x0, y0, x1, y1, 0.1 * statics.mean_diameter, colour));
  };
  const double low = std::max(view.y_min, std::min(0.0, view.y_max));
  if (!statics.periodic)
    for (const double x : {0.0, statics.length})
      if (x >= view.x_min && x <= view.x_max) add(x, low, x, view.y_max);
  const bool smooth = statics.free_count == bed.frame.grain_count();
  if (smooth && view.y_min <= 0.0 && view.y_max >= 0.0)
    add(std::max(0.0, view.x_min), 0.0, std::min(statics.length, view.x_max), 0.0);
}

/// Grays that replace black and white: the one does not dazzle, and the other stands out from the background.
constexpr double brightest = 245.0, darkest = 34.0;
constexpr render::Colour floor_fill{46, 51, 59}, floor_rim{140, 148, 160};
constexpr double dark_luma = 60.0;  // luminance below which a grain needs a lighter rim
constexpr render::Colour light_rim{96, 104, 118};

render::Colour mirrored(const render::Colour& colour) {
  if (!render::is_gray(colour)) return colour;
  const double share = 1.0 - colour.red / 255.0;
  const auto value = static_cast<std::uint8_t>(darkest + share * (brightest - darkest));
  return {value, value, value, colour.alpha};
}

bool all_gray(const render::Bar& bar) {
  return std::ranges::all_of(bar.colours,
                             [](const render::Colour& colour) { return render::is_gray(colour); });
}

/// Returns whether the bar passes from one hue to another through a light gray.
bool passes_white(const render::Bar& bar) {
  const render::Colour& middle = bar.colours[bar.colours.size() / 2];
  const int low = std::min({middle.red, middle.green, middle.blue});
  const int high = std::max({middle.red, middle.green, middle.blue});
  return !all_gray(bar) && low > 200 && high - low < 20;
}

bool keeps_grains(const render::FrameView& map) {
  return std::ranges::any_of(map.legends, [](const render::Legend& legend) {
    return std::ranges::any_of(legend.bars, passes_white);
  });
}

/// Returns the rim of a grain with that fill on a dark background. The black rim of a spanning cluster stays
/// if its fill is so light that a mirrored (white) rim would be invisible.
render::Colour rim_on_dark(const render::Colour& fill, const render::Colour& rim) {
  constexpr double light_luma = 110.0;
  const bool marks = rim == render::black && !render::is_gray(fill);
  if (marks && render::luma(fill) > light_luma) return rim;
  return render::luma(fill) < dark_luma ? light_rim : mirrored(rim);
}

void mirror(render::Disc& disc, bool keep) {
  if (disc.hatched > 0.5f) {
    disc.fill = floor_fill;
    disc.rim = floor_rim;
    return;
  }
  if (keep) return;
  disc.fill = mirrored(disc.fill);
  disc.rim = rim_on_dark(disc.fill, disc.rim);
}

/// Formats a number as briefly as possible; eight digits distinguish any two frames.
std::string number(double value) { return fmt::format("{:.8g}", value == 0.0 ? 0.0 : value); }

/// Formats the part in D, rounded inwards, because `talus render` rejects parts that leave the bed.
std::string crop_text(const pictures::MapExtent& part, double diameter) {
  constexpr double parts = 100.0;  // hundredths of D
  const auto up = [&](double x) { return number(std::ceil(x / diameter * parts - 1e-9) / parts); };
  const auto down = [&](double x) { return number(std::floor(x / diameter * parts + 1e-9) / parts); };
  return fmt::format("{},{},{},{}", up(part.x_min), up(part.y_min), down(part.x_max), down(part.y_max));
}

/// Returns the range if it differs from the default of `talus render`: a range chosen by the user or, for
/// motion, the fixed range of the window.
std::optional<pictures::ScaleRange> range_of(const RenderRequest& shown) {
  const pictures::MapSettings& settings = shown.settings;
  if (!pictures::has_bar(settings.layers)) return std::nullopt;
  if (settings.range_low && settings.range_high)
    return pictures::ScaleRange{*settings.range_low, *settings.range_high};
  const std::optional<pictures::MapKind> moving = moving_layer(settings.layers);
  if (!moving) return std::nullopt;
  return pictures::fixed_motion_range(*moving, !shown.since && !shown.in_flow);
}

}  // namespace

MapKey map_key(const pictures::PictureSeries& series, std::size_t k, std::shared_ptr<const Frame> frame,
               std::shared_ptr<const Frame> reference, bool change) {
  const pictures::MapSettings& settings = series.plan.maps[0];
  const bool dyed = pictures::shows(settings.layers, pictures::MapKind::dyed);
  // Frames that were read with another rule give clusters no colours.
  const bool coloured = pictures::shows(settings.layers, pictures::MapKind::clusters) &&
                        series.seen_frames.rule == static_cast<const pictures::OverloadRule&>(settings);
  const std::size_t needed = coloured ? k + 1 : std::size_t{dyed};
  const std::size_t colour_frames = std::min(series.seen_frames.instants.size(), needed);
  return {std::move(frame), std::move(reference), settings, series.extent,
          series.since,     colour_frames,        change};
}

render::FrameView draw_map(const pictures::PictureSeries& series, std::size_t k, const Frame& frame,
                           const Frame* reference, bool change) {
  const BedFrame bed{frame, series.run.statics};
  try {
    return change ? pictures::make_change_map({bed, reference, false}, series.plan.maps[0], series.extent)
                  : pictures::picture(series, k, frame, reference, 0);
  } catch (const Error& error) {
    render::FrameView view = pictures::outlined_bed(bed, series.extent);
    view.furniture = true;
    view.tilt = frame.tilt;
    view.title = error.what();
    return view;
  }
}

std::optional<pictures::MapKind> moving_layer(const pictures::MapLayers& layers) {
  const auto bar =
      std::ranges::find_if(layers, [](pictures::MapKind kind) { return pictures::has_bar({kind}); });
  return bar != layers.end() && pictures::fits_frames(*bar) ? std::optional(*bar) : std::nullopt;
}

render::FrameView shown_map(const render::FrameView& map, const pictures::MapExtent& part,
                            const BedFrame& bed) {
  render::FrameView view = pictures::empty_view(part);
  view.turn = map.turn;
  view.turn_max = map.turn_max;
  view.tilt = map.tilt;
  view.coloured = true;  // the same render target for everything shown
  view.transparent = map.transparent;
  add_grains(view, map);
  add_boundary(view, bed);
  return view;
}

render::FrameView on_dark_ground(render::FrameView map) {
  const bool keep = keeps_grains(map);
  for (render::Disc& disc : map.discs) mirror(disc, keep);
  for (render::Line& line : map.lines)
    if (!keep) line.colour = mirrored(line.colour);
  for (render::Legend& legend : map.legends) {
    for (render::Bar& bar : legend.bars)
      if (all_gray(bar)) std::ranges::transform(bar.colours, bar.colours.begin(), mirrored);
    for (render::Swatch& swatch : legend.swatches) {
      if (keep) continue;
      swatch.fill = mirrored(swatch.fill);
      swatch.rim = swatch.kind == render::Swatch::Kind::disc ? rim_on_dark(swatch.fill, swatch.rim)
                                                             : mirrored(swatch.rim);
    }
  }
  map.transparent = true;
  return map;
}

std::string render_command_line(const RenderRequest& shown) {
  const pictures::MapSettings& settings = shown.settings;
  const pictures::MapLayers& layers = settings.layers;
  std::string line = "talus render " + shell_quoted(shown.run);
  const auto add = [&line](const std::string& option, const std::string& value) {
    line += fmt::format(" {} {}", option, value);
  };
  const auto set = [&add](const char* key, const std::string& value) {
    add("--set", fmt::format("{}={}", key, value));
  };
  const auto flag = [&line](const std::string& option) { line += " " + option; };
  add("--map", pictures::name_of(settings));
  add("--at", shown.frame ? fmt::format("frame{}", *shown.frame) : number(degrees(shown.tilt)));
  if (shown.in_flow) flag("--flow");
  const bool by_theta_c = pictures::any_layer(layers, pictures::needs_theta_c);
  if (by_theta_c && settings.theta_c_assumed) set("gamma_c", number(sine(settings.theta_c)));
  if (pictures::any_layer(layers, pictures::shows_gamma) && settings.l_min != pictures::MapSettings().l_min)
    set("l_min", number(settings.l_min));
  const bool by_threshold = pictures::shows(layers, pictures::MapKind::overloaded) ||
                            pictures::shows(layers, pictures::MapKind::clusters);
  if (by_threshold && settings.threshold_factor != 1.0)
    set("threshold_factors", number(settings.threshold_factor));
  if (pictures::any_layer(layers, pictures::is_coarse) && settings.length != pictures::MapSettings().length)
    set("length", number(settings.length));
  if (shown.since && pictures::any_layer(layers, pictures::needs_reference))
    add("--since", number(degrees(*shown.since)));
  if (settings.joined_by_neighbours && pictures::shows(layers, pictures::MapKind::clusters))
    set("joining", "neighbours");
  std::vector<std::string_view> colours;
  if (pictures::has_bar(layers) && settings.colours)
    colours.push_back(render::colour_map_name(*settings.colours));
  if (pictures::shows(layers, pictures::MapKind::clusters) &&
      settings.palette != pictures::ClusterPalette::muted)
    colours.push_back(pictures::palette_name(settings.palette));
  if (!colours.empty()) add("--colours", joined(colours, ","));
  if (const std::optional<pictures::ScaleRange> range = range_of(shown))
    add("--range", fmt::format("{},{}", number(range->low), number(range->high)));
  if (shown.part) add("--crop", crop_text(*shown.part, shown.mean_diameter));
  if (settings.turned) flag("--turned");
  return line;
}

}  // namespace talus::view
