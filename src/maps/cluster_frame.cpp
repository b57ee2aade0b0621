#include "maps/cluster_frame.h"

#include "analysis/free_grains.h"
#include "analysis/links.h"
#include "maps/layers.h"
#include "stress/overload.h"

namespace talus {

double overload_threshold(const MapSettings& settings) {
  return settings.threshold_factor * gamma_c_of(settings);
}

Clusters overloaded_clusters(const Frame& frame, const RunStatics& statics, const MapSettings& settings) {
  const double threshold = overload_threshold(settings);
  std::vector<bool> overloaded(static_cast<std::size_t>(statics.free_count));
  for (std::size_t i = 0; i < overloaded.size(); ++i)
    overloaded[i] = is_overloaded(frame.gamma[i], threshold);
  const auto links =
      settings.joined_by_neighbours ? neighbour_links(frame, statics) : force_links(frame, statics);
  return find_clusters(overloaded, links, frame.x, period_of(statics));
}

}  // namespace talus
