#pragma once
/// A movie of maps of a run: the frames that it shows, and for how long.

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pictures/picture_files.h"
#include "render/renderer.h"

namespace talus::pictures {

struct MovieTiming {
  double every = 0.0;           ///< deg between frames of the run that are drawn; 0: all
  double fps = 10.0;            ///< movie frames per second
  std::optional<double> speed;  ///< deg of tilt per second; if not set, each frame drawn is shown once
  /// s for which the first and the last frame are held; if not set, 1 s for the last if there is a speed
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
  std::string output;  ///< FILE.mp4, FILE.webm or FILE.gif
};

struct MovieResult {
  std::size_t frames = 0;
  int max_times = 1;  ///< maximum for frames of the run between the first and the last
};

/// Returns the views of a frame; the same number of each.
using ViewsOf = std::function<std::vector<render::FrameView>(std::size_t frame)>;

/// Writes a movie of these frames, all in one layout. `views_of` is called twice for each, because captions
/// and legends differ in length, and some frames may have colour. With height 0 (px) it follows from the
/// views. Nothing is left behind if `watch` stops it, or one of its functions throws. Throws the errors of
/// Movie and arrange.
void write_movie(render::Renderer& renderer, const std::string& path, std::span<const MovieFrame> frames,
                 const ViewsOf& views_of, int width, int height, double fps, const Watch& watch);

/// Draws the maps of the plan into a movie (render/movie.h). Throws the errors of Movie and arrange, and
/// Error(stopped) if it was stopped, without leaving files behind.
MovieResult draw_movie(DrawnRun& run, const MovieRequest& asked, const Watch& watch);

}  // namespace talus::pictures
