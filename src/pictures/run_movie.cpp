#include "pictures/run_movie.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/errors.h"
#include "core/trigonometry.h"
#include "render/movie.h"
#include "render/renderer.h"
#include "render/sheet.h"

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

/// The maps of a frame beside each other. Of several, the first has the angle, the last the scale bar, and
/// the curves stand once, in a view of their own.
std::vector<render::FrameView> movie_views(DrawnRun& run, std::size_t frame, bool curves_apart) {
  std::vector<render::FrameView> views;
  for (std::size_t map = 0; map < run.series.plan.maps.size(); ++map)
    views.push_back(picture(run, frame, map));
  for (std::size_t map = 1; map < views.size(); ++map) {
    views[map].caption.clear();
    views[map - 1].scale_label.clear();
  }
  if (!curves_apart || views.front().traces.empty()) return views;
  render::FrameView curves;
  curves.letters = views.front().letters;
  curves.most_letters = views.front().most_letters;
  curves.traces = views.front().traces;
  for (render::FrameView& view : views) view.traces.clear();
  views.push_back(std::move(curves));
  return views;
}

/// What all frames of a movie have in common.
struct MovieFormat {
  render::Arrangement arrangement;
  bool curves_apart = false;
  bool coloured = false;
};

/// Captions and legends of some frames are longer than those of others, and one of them may have colour.
MovieFormat common_format(DrawnRun& run, const std::vector<MovieFrame>& frames, int height,
                          const render::Font& font) {
  MovieFormat format;
  format.curves_apart = height > 0 || run.series.plan.maps.size() > 1;
  std::vector<std::vector<render::FrameView>> pictures;
  for (const MovieFrame& frame : frames) {
    std::vector<render::FrameView>& views =
        pictures.emplace_back(movie_views(run, frame.frame, format.curves_apart));
    for (render::FrameView& view : views) {
      format.coloured = format.coloured || render::pixel_format(view) == render::PixelFormat::colour;
      // The layout needs no more of it.
      view.discs = {};
      view.lines = {};
      for (render::Trace& trace : view.traces) trace.x = trace.y = {};
    }
  }
  format.arrangement = render::arrange(std::move(pictures), run.series.plan.width, height, font);
  return format;
}

void make_movie(DrawnRun& run, const std::vector<MovieFrame>& frames, const MovieAsked& asked,
                const Watch& watch) {
  render::Renderer renderer(render::make_context(run.series.plan.context));
  const MovieFormat format = common_format(run, frames, asked.height, renderer.font());
  render::Movie movie(asked.output, format.arrangement.width, format.arrangement.height,
                      format.coloured ? 3 : 1, asked.timing.fps);
  for (std::size_t k = 0; k < frames.size() && !watch.stopped(); ++k) {
    std::vector<render::FrameView> views = movie_views(run, frames[k].frame, format.curves_apart);
    for (render::FrameView& view : views) view.coloured = format.coloured;
    const render::Image image =
        renderer.draw(render::arranged(std::move(views), format.arrangement, renderer.font()));
    for (int shown = 0; shown < frames[k].times && !watch.stopped(); ++shown) movie.add(image);
    if (watch.progress) watch.progress(k + 1, frames.size());
  }
  if (!watch.stopped()) movie.finish();
}

}  // namespace

std::vector<MovieFrame> movie_frames(const std::vector<double>& clock, const MovieTiming& timing) {
  std::vector<MovieFrame> frames;
  for (std::size_t k : frames_every(clock, timing.every)) frames.push_back({k, 1});
  const auto held = [&timing](double seconds) { return static_cast<int>(std::lround(timing.fps * seconds)); };
  if (!timing.speed) {
    for (MovieFrame* end : {&frames.front(), &frames.back()})
      if (end != &frames.front() || frames.size() > 1) end->times += held(timing.hold.value_or(0.0));
    return frames;
  }

  // The movie frame from which on a frame of the run may be seen; a little early, so that round-off in an
  // angle does not cost it a frame.
  const auto first_seen = [&](const MovieFrame& frame) {
    constexpr double early = 1e-6;
    const double seconds = degrees(clock[frame.frame] - clock[frames.front().frame]) / *timing.speed;
    return std::ceil(seconds * timing.fps - early);
  };
  for (std::size_t k = 0; k + 1 < frames.size(); ++k)
    frames[k].times = static_cast<int>(first_seen(frames[k + 1]) - first_seen(frames[k]));
  frames.back().times = 1 + held(timing.hold.value_or(1.0));
  std::erase_if(frames, [](const MovieFrame& frame) { return frame.times == 0; });
  if (frames.size() > 1) frames.front().times += held(timing.hold.value_or(0.0));
  return frames;
}

MovieDrawn draw_movie(DrawnRun& run, const MovieAsked& asked, const Watch& watch) {
  const std::vector<MovieFrame> frames = movie_frames(clock_tilts(run.series), asked.timing);
  FrameChoice shown;  // one range for all, each of which counts once however long it is shown
  MovieDrawn drawn;
  for (const MovieFrame& frame : frames) {
    shown.push_back(frame.frame);
    drawn.frames += static_cast<std::size_t>(frame.times);
  }
  for (std::size_t k = 1; k + 1 < frames.size(); ++k)
    drawn.most_times = std::max(drawn.most_times, frames[k].times);
  fit_to_frames(run, shown);
  try {
    make_movie(run, frames, asked, watch);
  } catch (const Error&) {
    if (!watch.stopped()) throw;  // Ctrl-C ends ffmpeg too: that is no error of the movie
  }
  if (watch.stopped())
    throw Error(ExitCode::stopped, "stopped; the movie was not finished, and nothing of it is kept");
  return drawn;
}

}  // namespace talus::pictures
