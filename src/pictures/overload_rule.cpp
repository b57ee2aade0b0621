#include "pictures/overload_rule.h"

#include <utility>

#include "analysis/free_grains.h"
#include "analysis/overload/links.h"
#include "core/trigonometry.h"
#include "stress/overload.h"

namespace talus::pictures {

double threshold_of(const OverloadRule& rule) { return rule.threshold_factor * sine(rule.theta_c); }

Frame mapped_frame(Frame frame, const RunStatics& statics, double l_min) {
  return analysis::with_gamma_of_neighbourhoods(std::move(frame), statics, l_min * statics.mean_diameter);
}

analysis::Clusters overloaded_clusters(const BedFrame& bed, const OverloadRule& rule) {
  const double threshold = threshold_of(rule);
  std::vector<bool> overloaded(static_cast<std::size_t>(bed.statics.free_count));
  for (std::size_t i = 0; i < overloaded.size(); ++i)
    overloaded[i] = stress::is_overloaded(bed.frame.gamma[i], threshold);
  const auto links = rule.joined_by_neighbours ? analysis::neighbour_links(bed) : analysis::force_links(bed);
  return analysis::find_clusters(overloaded, links, bed.frame.x, analysis::period_of(bed.statics));
}

}  // namespace talus::pictures
