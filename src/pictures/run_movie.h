#pragma once
/// A movie of maps of a run: the frames that it shows, and for how long.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "pictures/picture_files.h"

namespace talus::pictures {

struct MovieTiming {
  double every = 0.0;           ///< deg between frames of the run that are drawn; 0: all
  double fps = 10.0;            ///< movie frames per second
  std::optional<double> speed;  ///< deg of tilt per second; if not set, each frame drawn is shown once
  /// s for which the first and the last frame are held; if not set and there is a speed, the last is held for
  /// a second
  std::optional<double> hold;
};

/// A frame of the run, and the number of movie frames that show it.
struct MovieFrame {
  std::size_t frame = 0;
  int times = 1;
};

/// Returns the frames of the movie. `clock` (rad, ascending, not empty) is the time of each frame of the run.
/// With a speed, frame j of the movie shows the last one with clock <= clock[0] + j speed / fps.
std::vector<MovieFrame> movie_frames(const std::vector<double>& clock, const MovieTiming& timing);

struct MovieRequest {
  MovieTiming timing;
  int height = 0;      ///< px; 0: height of the maps next to each other
  std::string output;  ///< FILE.mp4, FILE.webm or FILE.gif
};

struct MovieResult {
  std::size_t frames = 0;
  int max_times = 1;  ///< maximum for frames of the run between the first and the last
};

/// Draws the maps of the plan into a movie (render/movie.h). Throws the errors of Movie and arrange, and
/// Error(stopped) if it was stopped, without leaving files behind.
MovieResult draw_movie(DrawnRun& run, const MovieRequest& asked, const Watch& watch);

}  // namespace talus::pictures
