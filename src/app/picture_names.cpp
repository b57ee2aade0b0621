#include "app/picture_names.h"

#include <cstdio>

#include "core/trigonometry.h"

namespace talus {

std::string tilt_name(const std::string& map, double tilt, int decimals) {
  char text[32];
  std::snprintf(text, sizeof text, "%0*.*f", 4 + decimals, decimals, degrees(tilt));
  return map + "_" + text + ".png";
}

std::string flow_name(const std::string& map, double time) {
  char text[32];
  std::snprintf(text, sizeof text, "%08.4f", time);
  return map + "_flow_" + text + "s.png";
}

std::vector<std::string> picture_names(const MappedRun& run, const FrameChoice& choice, std::size_t rising,
                                       const std::string& map) {
  const FrameChoice frames(choice.begin(), choice.begin() + static_cast<std::ptrdiff_t>(rising));
  std::vector<std::string> names = frame_names(run.file().frame_tilts(), frames, map);
  const double failure = run.instants()[run.file().frame_count() - 1].time;
  for (std::size_t k = rising; k < choice.size(); ++k)
    names.push_back(flow_name(map, run.instants()[choice[k]].time - failure));
  return names;
}

}  // namespace talus
