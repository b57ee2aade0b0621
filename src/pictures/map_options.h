#pragma once
/// Options of maps that users can choose, as plain data.

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/snapshot.h"

namespace talus::pictures {

/// Content of a map: a name of `talus render --map`, or values of one's own.
using MapChoice = std::variant<std::string, OwnQuantity>;

/// The values of the options shared by `talus render`, `animate`, `panel` and `run --pictures`.
struct MapOptions {
  std::vector<std::string> maps = {"gamma", "overloaded"};  ///< default: the two of the paper
  int width = 1600;                                         ///< px
  int height = 0;                                           ///< px; 0: follows from the bed
  std::optional<double> theta_c;                            ///< deg
  std::string colours;                                      ///< empty: the default of each map
  std::string context = "auto";                             ///< or osmesa, egl
  std::optional<double> l_min;                              ///< D
  std::optional<double> threshold;                          ///< multiple of Gamma_c
  std::optional<double> length;                             ///< D
  std::optional<double> since;                              ///< deg
  std::optional<std::string> joined;                        ///< contacts or neighbours
  std::vector<double> range;                                ///< low, high
  std::vector<double> crop;                                 ///< x0, y0, x1, y1 in D
  std::string traces;                                       ///< separated by commas
  bool turned = false;
  bool transparent = false;
  bool bare = false;
  bool document = false;          ///< PDF or SVG, for paper by default
  std::string purpose;            ///< paper, slide or poster; empty: a screen, unless `printed`
  std::optional<double> printed;  ///< cm
};

}  // namespace talus::pictures
