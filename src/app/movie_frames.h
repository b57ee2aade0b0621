#pragma once
/// Which frames of a run a movie shows, and for how long.

#include <cstddef>
#include <optional>
#include <vector>

#include "app/mapped_run.h"

namespace talus {

struct MovieTiming {
  double every = 0.0;           ///< deg between frames of the run that are drawn; 0: all
  double fps = 10.0;            ///< frames of the movie a second
  std::optional<double> speed;  ///< deg of tilt a second; without it each frame drawn is shown once
};

/// A frame of the run, and how many frames of the movie show it.
struct MovieFrame {
  std::size_t frame = 0;
  int times = 1;
};

/// When each frame of a run is, in rad: its tilt; and after failure, the tilt that would have been reached
/// had it gone on rising.
std::vector<double> clock_tilts(const MappedRun& run);

/// `clock` (rad, ascending, not empty) tells of each frame of the run when it is. With a speed, frame j of
/// the movie shows the last one with clock <= clock[0] + j speed / fps, and the end is held for a second.
std::vector<MovieFrame> movie_frames(const std::vector<double>& clock, const MovieTiming& timing);

}  // namespace talus
