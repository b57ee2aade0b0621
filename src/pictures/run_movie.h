#pragma once
/// Maps of a run as a movie: which frames it shows, and for how long.

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
  /// s for which the first and the last frame stay; without it the last stays for a second where there is a
  /// speed
  std::optional<double> hold;
};

/// A frame of the run, and how many frames of the movie show it.
struct MovieFrame {
  std::size_t frame = 0;
  int times = 1;
};

/// `clock` (rad, ascending, not empty) tells of each frame of the run when it is. With a speed, frame j of
/// the movie shows the last one with clock <= clock[0] + j speed / fps.
std::vector<MovieFrame> movie_frames(const std::vector<double>& clock, const MovieTiming& timing);

struct MovieAsked {
  MovieTiming timing;
  int height = 0;      ///< px; 0: as high as the maps beside each other are
  std::string output;  ///< FILE.mp4, FILE.webm or FILE.gif
};

struct MovieDrawn {
  std::size_t frames = 0;
  int most_times = 1;  ///< that a frame of the run between the first and the last is shown
};

/// Draws the maps of the plan into a movie (render/movie.h). Throws as Movie and arrange do, and
/// Error(stopped) where it was stopped, with nothing left behind.
MovieDrawn draw_movie(DrawnRun& run, const MovieAsked& asked, const Watch& watch);

}  // namespace talus::pictures
