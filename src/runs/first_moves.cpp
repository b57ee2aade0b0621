#include "runs/first_moves.h"

#include <algorithm>
#include <cmath>

#include "analysis/events/events.h"
#include "analysis/packing/packing.h"

namespace talus::runs {

std::vector<FirstMove> first_moves(const io::RunFile& run, double distance) {
  const RunStatics& statics = run.header().statics;
  const auto free_count = static_cast<std::size_t>(statics.free_count);
  // Displacements are added from frame to frame, because a grain can cross a periodic bed more than once.
  std::vector<Vec2> moved(free_count);
  std::vector<bool> has_moved(free_count, false);
  std::vector<FirstMove> moves;
  Frame before;
  for (std::size_t k = 0; k < run.all_frame_tilts().size(); ++k) {
    Frame now = run.positions(k);
    if (k > 0) {
      const std::size_t first = moves.size();
      const double surface = analysis::frame_volume({now, statics}) / statics.length;
      for (Index i = 0; i < statics.free_count; ++i) {
        const Vec2 step = analysis::displacement_of(before, now, statics, i);
        Vec2& total = moved[i];
        total = {total.x + step.x, total.y + step.y};
        const double size = std::hypot(total.x, total.y);
        if (has_moved[i] || size < distance) continue;
        has_moved[i] = true;
        moves.push_back({i, k, now.time, now.tilt, now.x[i], now.y[i], surface - now.y[i], size});
      }
      std::stable_sort(
          moves.begin() + static_cast<std::ptrdiff_t>(first), moves.end(),
          [](const FirstMove& a, const FirstMove& b) { return a.displacement > b.displacement; });
    }
    before = std::move(now);
  }
  return moves;
}

}  // namespace talus::runs
