#pragma once
/// All figures that Talus makes of runs, in the order of the paper, then those beyond it.

#include <optional>
#include <span>
#include <string_view>

#include "figures/figure.h"
#include "figures/run_group.h"

namespace talus::figures {

/// What a figure is made from.
enum class Material {
  values,         ///< numbers of runs and of their frames, which ensemble.h5 has of all members
  distributions,  ///< of each frame, which an ensemble keeps beside the runs of its members
  frames,         ///< maps and series, which are in the files of runs only
};

/// What a figure is about.
enum class Subject { packing, overload, walls, further };

struct FigureRecipe {
  std::string_view name;   ///< Figure::name
  std::string_view title;  ///< Figure::title
  Material material;
  Subject subject;
  std::string_view needs;  ///< "a periodic bed that has failed": what a message says where it cannot be made
  /// No value where there is no run of the kind it needs.
  std::optional<Figure> (*make)(std::span<const RunGroup> groups);
};

std::span<const FigureRecipe> figure_catalogue();

}  // namespace talus::figures
