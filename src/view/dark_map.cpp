#include "view/dark_map.h"

#include <algorithm>

#include "pictures/cluster_colours.h"

namespace talus::view {
namespace {

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

/// Returns the rim of a grain with that fill on a dark background. The rim of a spanning cluster stays if it
/// is light, or if the fill is so light that a mirrored (white) rim would be invisible.
render::Colour rim_on_dark(const render::Colour& fill, const render::Colour& rim) {
  constexpr double light_luma = 110.0;
  const bool marks = rim == pictures::spanning_rim(fill) && !render::is_gray(fill);
  if (marks && (rim != render::black || render::luma(fill) > light_luma)) return rim;
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

}  // namespace

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

}  // namespace talus::view
