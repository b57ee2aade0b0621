#include "app/movie_frames.h"

#include <algorithm>
#include <cmath>

#include "core/trigonometry.h"
#include "maps/frame_choice.h"

namespace talus {

std::vector<double> clock_tilts(const MappedRun& run) {
  std::vector<double> clock = run.file().frame_tilts();
  const FrameInstant& first = run.instants().front();
  const FrameInstant& last = run.instants()[clock.size() - 1];
  const double rate = last.time > first.time ? (last.tilt - first.tilt) / (last.time - first.time) : 0.0;
  for (std::size_t k = clock.size(); k < run.instants().size(); ++k)
    clock.push_back(last.tilt + rate * (run.instants()[k].time - last.time));
  return clock;
}

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

}  // namespace talus
