#pragma once
/// A map of a run as a movie: which frames it shows, and for how long.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "pictures/picture_files.h"

namespace talus::pictures {

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

/// `clock` (rad, ascending, not empty) tells of each frame of the run when it is. With a speed, frame j of
/// the movie shows the last one with clock <= clock[0] + j speed / fps, and the end is held for a second.
std::vector<MovieFrame> movie_frames(const std::vector<double>& clock, const MovieTiming& timing);

/// Draws the first map of the plan into a movie (render/movie.h). Returns how many frames the movie has.
/// Throws as Movie does, and Error(stopped) where it was stopped, with nothing left behind.
std::size_t draw_movie(DrawnRun& run, const MovieTiming& timing, const std::string& output,
                       const Watch& watch);

}  // namespace talus::pictures
