#pragma once
/// Texts of frames, most of which are the same: each is kept once.

#include <algorithm>
#include <string>
#include <vector>

#include "scenario/json.h"

namespace talus {

class Distinct {
 public:
  void add(const std::string& text) {
    const auto found = std::ranges::find(texts_, text);
    places_.push_back(static_cast<int>(found - texts_.begin()));
    if (found == texts_.end()) texts_.push_back(text);
  }
  /// {"kinds": [...], "of": [place of that of each frame]}; the texts are JSON already.
  std::string json() const {
    std::vector<std::string> places;
    for (const int place : places_) places.push_back(std::to_string(place));
    return json::line({{"kinds", json::list(texts_)}, {"of", json::list(places)}});
  }

 private:
  std::vector<std::string> texts_;
  std::vector<int> places_;
};

}  // namespace talus
