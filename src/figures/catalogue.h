#pragma once
/// Catalogue of all figures of runs, in the order of the paper, followed by further figures.

#include <optional>
#include <span>
#include <string_view>

#include "figures/figure.h"
#include "figures/run_group.h"
#include "figures/shown_frames.h"

namespace talus::figures {

/// Data required by a figure.
enum class Material {
  values,  ///< scalars of runs and of their frames, which ensemble.h5 contains for all members
  /// Distributions of each frame, which an ensemble stores in addition to the files of its members.
  distributions,
  frames,  ///< maps and series, which only the files of runs contain
};

/// Topic of a figure.
enum class Subject { packing, overload, walls, further };

/// Function that makes a figure; it returns no value if there is no run of the required kind.
struct FigureMaker {
  using Plain = std::optional<Figure>(std::span<const RunGroup>);
  using OfFrames = std::optional<Figure>(std::span<const RunGroup>, const FrameWords&);
  constexpr FigureMaker(Plain& make) : plain(&make) {}
  constexpr FigureMaker(OfFrames& make) : of_frames(&make) {}
  /// Makes the figure. `at`: frames to show instead of the default frames, for a figure that shows single
  /// frames.
  std::optional<Figure> operator()(std::span<const RunGroup> groups, const FrameWords& at = {}) const {
    return of_frames != nullptr ? of_frames(groups, at) : plain(groups);
  }

  Plain* plain = nullptr;
  OfFrames* of_frames = nullptr;
};

/// An entry of the catalogue.
struct FigureRecipe {
  std::string_view name;   ///< Figure::name
  std::string_view title;  ///< Figure::title
  Material material;
  Subject subject;
  std::string_view needs;  ///< required runs, for messages: "a periodic bed that has failed"
  FigureMaker make;

  /// Whether the figure shows single frames, which can be chosen.
  bool shows_frames() const { return make.of_frames != nullptr; }
};

/// Returns the catalogue.
std::span<const FigureRecipe> figure_catalogue();

}  // namespace talus::figures
