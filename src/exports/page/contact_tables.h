#pragma once
/// The contacts in all frames of a page: the pairs that ever touch, and their force in each frame.

#include <array>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "exports/page/page_run.h"
#include "exports/page/tables.h"

namespace talus::exports {

/// Returns the force of a code, over the mean of its frame. Forces are stored up to the value at which lines
/// reach their largest width, with finer steps at small values.
double force_of(std::uint32_t code);
/// Returns the code of a force, 1 to 255; 0 means no contact.
std::uint32_t force_code(double force_over_mean);

/// A plane that grains touch, and the normal towards it.
struct TouchedPlane {
  Index id = 0;
  double nx = 0.0, ny = 0.0;
};

struct ContactTables {
  CodeTable a, b, shift;  ///< one column: ids of each pair, by ascending keys; shift is 0, 1, or 255 for -1
  CodeTable force, sliding;  ///< one row per pair: code of f_n over the frame's mean; 1: sliding
  std::vector<TouchedPlane> planes;
};

/// Collects the contacts of frame after frame.
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
