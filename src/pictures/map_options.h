#pragma once
/// What a user can choose about maps, as plain data.

#include <optional>
#include <string>
#include <vector>

namespace talus::pictures {

/// The words and numbers of the options that `talus render`, `animate`, `panel` and `run --pictures` share.
struct MapOptions {
  std::vector<std::string> maps;
  int width = 1600;                   ///< px
  std::optional<double> theta_c;      ///< deg
  std::string colours;                ///< empty: each map its own
  std::string context = "auto";       ///< or osmesa, egl
  std::optional<double> l_min;        ///< D
  std::optional<double> threshold;    ///< of Gamma_c
  std::optional<double> length;       ///< D
  std::optional<double> since;        ///< deg
  std::optional<std::string> joined;  ///< contacts or neighbours
  std::vector<double> range;          ///< low, high
  std::vector<double> crop;           ///< x0, y0, x1, y1 in D
  std::string traces;                 ///< with commas
  bool turned = false;
  bool transparent = false;
  bool bare = false;
  bool document = false;          ///< PDF or SVG: for paper, if nothing else is said
  std::string purpose;            ///< paper, slide or poster; empty: a screen, unless it is printed
  std::optional<double> printed;  ///< cm
};

}  // namespace talus::pictures
