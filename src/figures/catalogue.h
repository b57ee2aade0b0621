#pragma once
/// All figures that Talus makes of runs, in the order of the paper, then those beyond it.

#include <optional>
#include <span>
#include <string_view>

#include "figures/figure.h"
#include "figures/run_group.h"
#include "figures/shown_frames.h"

namespace talus::figures {

/// What a figure is made from.
enum class Material {
  values,         ///< numbers of runs and of their frames, which ensemble.h5 has of all members
  distributions,  ///< of each frame, which an ensemble keeps beside the runs of its members
  frames,         ///< maps and series, which are in the files of runs only
};

/// What a figure is about.
enum class Subject { packing, overload, walls, further };

/// Makes a figure; no value where there is no run of the kind it needs.
struct FigureMaker {
  using Plain = std::optional<Figure>(std::span<const RunGroup>);
  using OfFrames = std::optional<Figure>(std::span<const RunGroup>, const FrameWords&);
  constexpr FigureMaker(Plain& make) : plain(&make) {}
  constexpr FigureMaker(OfFrames& make) : of_frames(&make) {}
  /// `at`: the frames of a figure that shows single ones, instead of its own.
  std::optional<Figure> operator()(std::span<const RunGroup> groups, const FrameWords& at = {}) const {
    return of_frames != nullptr ? of_frames(groups, at) : plain(groups);
  }

  Plain* plain = nullptr;
  OfFrames* of_frames = nullptr;
};

struct FigureRecipe {
  std::string_view name;   ///< Figure::name
  std::string_view title;  ///< Figure::title
  Material material;
  Subject subject;
  std::string_view needs;  ///< "a periodic bed that has failed": what a message says where it cannot be made
  FigureMaker make;

  bool shows_frames() const { return make.of_frames != nullptr; }
};

std::span<const FigureRecipe> figure_catalogue();

}  // namespace talus::figures
