#include "pictures/run_movie.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/errors.h"
#include "core/trigonometry.h"
#include "render/arrange.h"
#include "render/movie.h"
#include "render/renderer.h"

namespace talus::pictures {

namespace {

/// The fastest that the tilt changes from one frame to the next, rad/s; 1 deg/s where it never does.
double fastest_rate(const std::vector<FrameInstant>& instants) {
  double fastest = 0.0;
  for (std::size_t k = 1; k < instants.size(); ++k)
    if (const double time = instants[k].time - instants[k - 1].time; time > 0.0)
      fastest = std::max(fastest, std::abs(instants[k].tilt - instants[k - 1].tilt) / time);
  return fastest > 0.0 ? fastest : radians(1.0);
}

/// When each frame of a run is, in rad: its tilt; and after failure, the tilt that would have been reached
/// had it gone on rising. With a programme, the tilt that would have been reached had it always risen at its
/// fastest.
std::vector<double> clock_tilts(const PictureSeries& series) {
  if (series.has_program) {
    std::vector<double> clock;
    const double rate = fastest_rate(series.met.instants);
    for (const FrameInstant& instant : series.met.instants)
      clock.push_back(rate * (instant.time - series.met.instants.front().time));
    return clock;
  }
  const FrameInstant &first = series.met.instants.front(), &last = series.met.instants[series.met.highest];
  const double rate = last.time > first.time ? (last.tilt - first.tilt) / (last.time - first.time) : 0.0;
  std::vector<double> clock;
  for (std::size_t k = 0; k < series.met.instants.size(); ++k)
    clock.push_back(k <= series.met.highest ? series.met.instants[k].tilt
                                            : last.tilt + rate * (series.met.instants[k].time - last.time));
  return clock;
}

/// What all frames of a movie have in common.
struct MovieFormat {
  render::LayoutLimits limits;  ///< font size, and where the bed stands
  int height = 0;               ///< px
  bool coloured = false;
};

/// The smallest font size, the lowest bed, the largest height, and colour where one of the frames has it:
/// captions and legends of some are longer than those of others.
MovieFormat common_format(DrawnRun& run, const std::vector<MovieFrame>& frames, const render::Font& font) {
  MovieFormat format;
  std::vector<render::FrameView> views;
  for (const MovieFrame& frame : frames) {
    render::FrameView& view = views.emplace_back(picture(run, frame.frame, 0));
    format.limits.largest_em =
        std::min(format.limits.largest_em, render::lay_out(view, run.series.plan.width, font).em);
    format.coloured = format.coloured || render::pixel_format(view) == render::PixelFormat::colour;
    // The layout needs no more of it.
    view.discs = {};
    view.lines = {};
    for (render::Trace& trace : view.traces) trace.x = trace.y = {};
  }
  format.limits = render::level(views, run.series.plan.width, font, format.limits);
  for (const render::FrameView& view : views)
    format.height =
        std::max(format.height, render::lay_out(view, run.series.plan.width, font, format.limits).height);
  return format;
}

void make_movie(DrawnRun& run, const std::vector<MovieFrame>& frames, double fps, const std::string& output,
                const Watch& watch) {
  const int width = run.series.plan.width;
  render::Renderer renderer(render::make_context(run.series.plan.context));
  const MovieFormat format = common_format(run, frames, renderer.font());
  render::Movie movie(output, width, format.height, format.coloured ? 3 : 1, fps);
  for (std::size_t k = 0; k < frames.size() && !watch.stopped(); ++k) {
    render::FrameView view = picture(run, frames[k].frame, 0);
    view.coloured = format.coloured;
    const render::Image image = render::padded(renderer.draw(view, width, format.limits), format.height);
    for (int shown = 0; shown < frames[k].times && !watch.stopped(); ++shown) movie.add(image);
    if (watch.progress) watch.progress(k + 1, frames.size());
  }
  if (!watch.stopped()) movie.finish();
}

}  // namespace

std::vector<MovieFrame> movie_frames(const std::vector<double>& clock, const MovieTiming& timing) {
  std::vector<MovieFrame> frames;
  for (std::size_t k : frames_every(clock, timing.every)) frames.push_back({k, 1});
  if (!timing.speed) return frames;

  // The movie frame from which on a frame of the run may be seen; a little early, so that round-off in an
  // angle does not cost it a frame.
  const auto first_seen = [&](const MovieFrame& frame) {
    constexpr double early = 1e-6;
    const double seconds = degrees(clock[frame.frame] - clock[frames.front().frame]) / *timing.speed;
    return std::ceil(seconds * timing.fps - early);
  };
  for (std::size_t k = 0; k + 1 < frames.size(); ++k)
    frames[k].times = static_cast<int>(first_seen(frames[k + 1]) - first_seen(frames[k]));
  frames.back().times = 1 + static_cast<int>(std::lround(timing.fps));
  std::erase_if(frames, [](const MovieFrame& frame) { return frame.times == 0; });
  return frames;
}

std::size_t draw_movie(DrawnRun& run, const MovieTiming& timing, const std::string& output,
                       const Watch& watch) {
  const std::vector<MovieFrame> frames = movie_frames(clock_tilts(run.series), timing);
  FrameChoice shown;  // one range for all, each of which counts once however long it is shown
  std::size_t count = 0;
  for (const MovieFrame& frame : frames) {
    shown.push_back(frame.frame);
    count += static_cast<std::size_t>(frame.times);
  }
  fit_to_frames(run, shown);
  try {
    make_movie(run, frames, timing.fps, output, watch);
  } catch (const Error&) {
    if (!watch.stopped()) throw;  // Ctrl-C ends ffmpeg too: that is no error of the movie
  }
  if (watch.stopped())
    throw Error(ExitCode::stopped, "stopped; the movie was not finished, and nothing of it is kept");
  return count;
}

}  // namespace talus::pictures
