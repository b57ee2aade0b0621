#include "runs/first_moves.h"

#include <algorithm>
#include <cmath>

#include "analysis/packing/packing.h"
#include "core/bed_frame.h"

namespace talus::runs {

std::vector<FirstMove> first_moves(const io::RunFile& run, double distance) {
  const RunStatics& statics = run.header().statics;
  std::vector<bool> has_moved(static_cast<std::size_t>(statics.free_count), false);
  std::vector<FirstMove> moves;
  if (run.all_frame_tilts().empty()) return moves;
  const Frame begin = run.positions(0);
  for (std::size_t k = 1; k < run.all_frame_tilts().size(); ++k) {
    const Frame now = run.positions(k);
    const BedFrame bed{now, statics};
    const std::size_t first = moves.size();
    const double surface = analysis::frame_volume(bed) / statics.length;
    for (Index i = 0; i < statics.free_count; ++i) {
      const Vec2 moved = displacement(bed, begin, i);
      const double size = std::hypot(moved.x, moved.y);
      if (has_moved[i] || size < distance) continue;
      has_moved[i] = true;
      moves.push_back({i, k, now.time, now.tilt, now.x[i], now.y[i], surface - now.y[i], size});
    }
    std::stable_sort(moves.begin() + static_cast<std::ptrdiff_t>(first), moves.end(),
                     [](const FirstMove& a, const FirstMove& b) { return a.displacement > b.displacement; });
  }
  return moves;
}

}  // namespace talus::runs
