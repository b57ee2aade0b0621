#pragma once
/// What a page says of its maps: titles, legends and colours, as the pictures of `talus render` have them.

#include <map>
#include <string>
#include <vector>

#include "exports/page/page_run.h"
#include "exports/page/tables.h"
#include "pictures/layers.h"

namespace talus::exports {

/// The maps that fill grains, in the order in which they are listed to users.
std::vector<pictures::MapKind> filling_maps(const PageRun& run);

/// One map over all frames of the page.
class MapTexts {
 public:
  MapTexts(const PageRun& run, pictures::MapKind kind);
  /// Of the next frame. `layer` is that of the map.
  void add(const PageFrame& frame, const pictures::MapLayer& layer);
  std::string json() const;

 private:
  pictures::MapKind kind_;
  std::string over_;  ///< colour of lines over it
  std::string ramp_;  ///< fills and rims from end to end, where grains are coloured by a value
  Distinct titles_, legends_, scales_, looks_;
};

/// Lines between grains, or at contacts, over all frames: their titles, and for each colour of `over` (that
/// of lines over a map; empty: over outlines) their legends.
class LineTexts {
 public:
  LineTexts(const PageRun& run, pictures::MapKind kind);
  void add(const PageRun& run, const PageFrame& frame);
  std::string json() const;

 private:
  pictures::MapKind kind_;
  std::vector<pictures::OverColour> over_;
  Distinct titles_;
  std::vector<std::string> legends_;  ///< for each of these colours
};

/// "#rrggbbaa".
std::string colour_text(const render::Colour& colour);

}  // namespace talus::exports
