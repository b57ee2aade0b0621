#pragma once
/// Texts of the maps of a page: titles, legends and colours, identical to the pictures of `talus render`.

#include <map>
#include <string>
#include <vector>

#include "exports/page/page_run.h"
#include "exports/page/tables.h"
#include "pictures/layers.h"

namespace talus::exports {

/// Returns the maps that fill grains, in the order in which they are listed to users.
std::vector<pictures::MapKind> filling_maps(const PageRun& run);

/// The texts of one map over all frames of the page.
class MapTexts {
 public:
  MapTexts(const PageRun& run, pictures::MapKind kind);
  /// Adds the next frame; `layer` is the layer of the map.
  void add(const PageFrame& frame, const pictures::MapLayer& layer);
  std::string json() const;

 private:
  pictures::MapKind kind_;
  std::string over_;  ///< colour of lines over the map
  std::string ramp_;  ///< fills and rims from end to end, if grains are coloured by a value
  DistinctTexts titles_, legends_, scales_, looks_;
};

/// The texts of lines between grains or at contacts over all frames: their titles, and their legends for each
/// colour of lines (over a map, or over outlines).
class LineTexts {
 public:
  LineTexts(const PageRun& run, pictures::MapKind kind);
  void add(const PageRun& run, const PageFrame& frame);
  std::string json() const;

 private:
  pictures::MapKind kind_;
  std::vector<pictures::OverColour> over_;
  DistinctTexts titles_;
  std::vector<std::string> legends_;  ///< one for each of these colours
};

/// Returns "#rrggbbaa".
std::string colour_text(const render::Colour& colour);

}  // namespace talus::exports
