#pragma once
/// The contacts of all frames of a page: which pairs ever touch, and how hard they press in each frame.

#include <array>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "exports/page/page_run.h"
#include "exports/page/tables.h"

namespace talus::exports {

/// Forces are kept up to this over the mean of their frame, finer where they are small: lines are no wider.
double force_of(std::uint32_t code);
/// 1 to 255; 0 is for no contact.
std::uint32_t force_code(double force_over_mean);

/// A plane that grains touch, and the normal towards it.
struct TouchedPlane {
  Index id = 0;
  double nx = 0.0, ny = 0.0;
};

struct ContactTables {
  CodeTable a, b, shift;  ///< one column: ids of each pair, by ascending keys; shift is 0, 1, or 255 for -1
  CodeTable force, sliding;  ///< a row for each pair: code of f_n over the mean of the frame; 1: sliding
  std::vector<TouchedPlane> planes;
};

/// Takes in frame after frame.
class ContactCollector {
 public:
  explicit ContactCollector(const PageRun& run) : run_(run) {}
  void add(const PageFrame& frame);
  ContactTables tables() const;

 private:
  struct Entry {
    std::uint32_t column = 0;
    std::uint8_t force = 0;
    bool sliding = false;
  };
  using Key = std::tuple<Index, Index, std::int8_t>;

  const PageRun& run_;
  std::map<Key, std::vector<Entry>> pairs_;
  std::map<Index, TouchedPlane> planes_;
};

}  // namespace talus::exports
