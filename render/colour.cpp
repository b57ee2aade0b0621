#include "render/colour.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/errors.h"
#include "render/embedded.h"

namespace talus::render {
namespace {

/// Names of the maps, in the order of ColourMap.
constexpr std::array<std::string_view, 14> names = {
    "gray",   "viridis",   "cividis",   "magma",   "inferno",   "plasma",   "diverging",
    "gray_r", "viridis_r", "cividis_r", "magma_r", "inferno_r", "plasma_r", "diverging_r"};
constexpr std::size_t one_way_count = names.size() / 2;  // number of maps that are not reversed

std::size_t place_of(ColourMap map) { return static_cast<std::size_t>(map); }

/// Evenly spaced colours from the lower to the upper end.
using ColourTable = std::vector<Colour>;

/// Parses lines "red green blue"; a line that begins with # is a comment.
ColourTable parse_table(std::span<const unsigned char> file) {
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  ColourTable table;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const char *at = text.data() + start, *const stop = text.data() + end;
    start = end + 1;
    if (at == stop || *at == '#') continue;
    Colour colour;
    for (std::uint8_t* part : {&colour.red, &colour.green, &colour.blue}) {
      const auto [next, error] = std::from_chars(at, stop, *part);
      if (error != std::errc())
        throw Error(ExitCode::internal, "a colour map has a line that is not a colour");
      at = next == stop ? next : next + 1;
    }
    table.push_back(colour);
  }
  return table;
}

/// A CIELAB colour with white point D65: lightness 0 ... 100, a from green to red, b from blue to yellow.
struct Lab {
  double lightness, a, b;
};

/// Converts to sRGB and clamps each channel to its range (IEC 61966-2-1).
Colour srgb(const Lab& lab) {
  const double f = (lab.lightness + 16.0) / 116.0;
  const auto linear = [](double t) { return t > 6.0 / 29.0 ? t * t * t : (t - 4.0 / 29.0) * 108.0 / 841.0; };
  const double x = 0.95047 * linear(f + lab.a / 500.0), y = linear(f),
               z = 1.08883 * linear(f - lab.b / 200.0);
  const auto channel = [](double value) {
    const double coded = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(coded, 0.0, 1.0)));
  };
  return {channel(3.2404542 * x - 1.5371385 * y - 0.4985314 * z),
          channel(-0.9692660 * x + 1.8760108 * y + 0.0415560 * z),
          channel(0.0556434 * x - 0.2040259 * y + 1.0572252 * z)};
}

/// Interpolates linearly from each end to near white. The lightness changes evenly on each side and ends at
/// 28 and at 53, so that the two ends differ in a gray print.
Colour diverging(double share) {
  constexpr Lab low{28.3, 8.4, -37.6}, middle{97.2, 0.0, 0.0}, high{52.6, 38.3, 56.8};
  const Lab& end = share < 0.5 ? low : high;
  const double far = std::abs(2.0 * share - 1.0);
  return srgb({std::lerp(middle.lightness, end.lightness, far), std::lerp(middle.a, end.a, far),
               std::lerp(middle.b, end.b, far)});
}

template <typename Function>
ColourTable table_of(std::size_t size, const Function& colour) {
  ColourTable table;
  for (std::size_t k = 0; k < size; ++k)
    table.push_back(colour(static_cast<double>(k) / static_cast<double>(size - 1)));
  return table;
}

const ColourTable& table(ColourMap map) {
  static const std::array<ColourTable, one_way_count> tables = {
      table_of(256, gray),          parse_table(embedded::viridis), parse_table(embedded::cividis),
      parse_table(embedded::magma), parse_table(embedded::inferno), parse_table(embedded::plasma),
      table_of(511, diverging)};  // an odd number gives it a middle
  return tables.at(place_of(map) % one_way_count);
}

}  // namespace

std::span<const ColourMap> colour_maps() {
  static constexpr std::array maps = {ColourMap::gray,     ColourMap::viridis, ColourMap::cividis,
                                      ColourMap::magma,    ColourMap::inferno, ColourMap::plasma,
                                      ColourMap::diverging};
  return maps;
}

ColourMap reversed(ColourMap map) {
  return static_cast<ColourMap>((place_of(map) + one_way_count) % names.size());
}

bool is_reversed(ColourMap map) { return place_of(map) >= one_way_count; }

ColourMap one_way(ColourMap map) { return is_reversed(map) ? reversed(map) : map; }

std::string_view colour_map_name(ColourMap map) { return names.at(place_of(map)); }

std::optional<ColourMap> colour_map(std::string_view name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<ColourMap>(found - names.begin());
}

Colour colour_at(ColourMap map, double share) {
  const ColourTable& colours = table(map);
  double place = share > 0.0 ? std::min(share, 1.0) : 0.0;  // NaN gives 0
  if (is_reversed(map)) place = 1.0 - place;
  return colours[static_cast<std::size_t>(std::lround(place * static_cast<double>(colours.size() - 1)))];
}

std::vector<Colour> colour_ramp(ColourMap map) {
  return table_of(256, [&](double share) { return colour_at(map, share); });
}

}  // namespace talus::render
