#include "pictures/run_movie.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/errors.h"
#include "core/trigonometry.h"
#include "pictures/panel.h"
#include "render/movie.h"
#include "render/sheet.h"

namespace talus::pictures {

namespace {

/// Returns the largest rate of tilt between successive frames, rad/s; 1 deg/s if the tilt never changes.
double fastest_rate(const std::vector<FrameInstant>& instants) {
  double fastest = 0.0;
  for (std::size_t k = 1; k < instants.size(); ++k)
    if (const double time = instants[k].time - instants[k - 1].time; time > 0.0)
      fastest = std::max(fastest, std::abs(instants[k].tilt - instants[k - 1].tilt) / time);
  return fastest > 0.0 ? fastest : radians(1.0);
}

/// Returns the movie clock of each frame, rad: its tilt and, after failure, the tilt that would have been
/// reached had it continued to rise. If the run goes by time, it is the tilt that would have been reached had
/// it always risen at its fastest.
std::vector<double> clock_tilts(const PictureSeries& series) {
  const std::vector<FrameInstant>& instants = series.seen_frames.instants;
  const std::size_t highest = series.seen_frames.highest;
  std::vector<double> clock;
  if (series.goes_by_time) {
    const double rate = fastest_rate(instants);
    for (const FrameInstant& instant : instants)
      clock.push_back(rate * (instant.time - instants.front().time));
    return clock;
  }
  const FrameInstant &first = instants.front(), &last = instants[highest];
  const double rate = last.time > first.time ? (last.tilt - first.tilt) / (last.time - first.time) : 0.0;
  for (std::size_t k = 0; k < instants.size(); ++k)
    clock.push_back(k <= highest ? instants[k].tilt : last.tilt + rate * (instants[k].time - last.time));
  return clock;
}

/// Returns the maps of a frame next to each other; the curves appear once, in a separate view.
std::vector<render::FrameView> movie_views(DrawnRun& run, std::size_t frame, bool curves_apart) {
  std::vector<render::FrameView> views;
  for (std::size_t map = 0; map < run.series.plan.maps.size(); ++map)
    views.push_back(picture(run, frame, map));
  share_row(views);
  if (!curves_apart || views.front().traces.empty()) return views;
  render::FrameView curves;
  curves.letters = views.front().letters;
  curves.max_letters = views.front().max_letters;
  curves.traces = views.front().traces;
  curves.trace_height = curves.traces.size() > 1 ? 3.0 : 4.0;  // more if there is room
  for (render::FrameView& view : views) view.traces.clear();
  views.push_back(std::move(curves));
  return views;
}

}  // namespace

void write_movie(render::Renderer& renderer, const std::string& path, std::span<const MovieFrame> frames,
                 const ViewsOf& views_of, int width, int height, double fps, const Watch& watch) {
  bool coloured = false;
  std::vector<std::vector<render::FrameView>> pictures;
  for (const MovieFrame& frame : frames)
    for (render::FrameView& view : pictures.emplace_back(views_of(frame.frame))) {
      coloured = coloured || render::pixel_format(view) == render::PixelFormat::colour;
      // The layout needs only the furniture.
      view.discs = {};
      view.lines = {};
      for (render::Trace& trace : view.traces) trace.x = trace.y = {};
    }
  const render::Arrangement arrangement =
      render::arrange(std::move(pictures), width, height, renderer.font());
  render::Movie movie(path, arrangement.width, arrangement.height, coloured ? 3 : 1, fps);
  for (std::size_t k = 0; k < frames.size() && !watch.stopped(); ++k) {
    std::vector<render::FrameView> views = views_of(frames[k].frame);
    for (render::FrameView& view : views) view.coloured = coloured;
    const render::Image image =
        renderer.draw(render::arranged(std::move(views), arrangement, renderer.font()));
    for (int shown = 0; shown < frames[k].times && !watch.stopped(); ++shown) movie.add(image);
    if (watch.progress) watch.progress(k + 1, frames.size());
  }
  if (!watch.stopped()) movie.finish();
}

std::vector<MovieFrame> movie_frames(const std::vector<double>& clock, const MovieTiming& timing) {
  std::vector<MovieFrame> frames;
  for (std::size_t k : frames_every(clock, timing.every)) frames.push_back({k, 1});
  const auto held = [&timing](double seconds) { return static_cast<int>(std::lround(timing.fps * seconds)); };
  if (!timing.speed) {
    for (MovieFrame* end : {&frames.front(), &frames.back()})
      if (end != &frames.front() || frames.size() > 1) end->times += held(timing.hold.value_or(0.0));
    return frames;
  }

  // Returns the first movie frame that may show a frame of the run; slightly early, so that round-off in an
  // angle does not delay it by one frame.
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

MovieResult draw_movie(DrawnRun& run, const MovieRequest& asked, const Watch& watch) {
  const std::vector<MovieFrame> frames = movie_frames(clock_tilts(run.series), asked.timing);
  FrameChoice shown;  // each counts once for the common range, however long it is shown
  MovieResult drawn;
  for (const MovieFrame& frame : frames) {
    shown.push_back(frame.frame);
    drawn.frames += static_cast<std::size_t>(frame.times);
  }
  for (std::size_t k = 1; k + 1 < frames.size(); ++k)
    drawn.max_times = std::max(drawn.max_times, frames[k].times);
  fit_to_frames(run, shown);
  try {
    const MapPlan& plan = run.series.plan;
    const bool curves_apart = plan.height > 0 || plan.maps.size() > 1;
    render::Renderer renderer(render::make_context(plan.context));
    write_movie(
        renderer, asked.output, frames, [&](std::size_t k) { return movie_views(run, k, curves_apart); },
        plan.width, plan.height, asked.timing.fps, watch);
  } catch (const Error&) {
    if (!watch.stopped()) throw;  // Ctrl-C also ends ffmpeg, which is not an error of the movie
  }
  if (watch.stopped())
    throw Error(ExitCode::stopped, "stopped; the movie was not finished and has been discarded");
  return drawn;
}

}  // namespace talus::pictures
