#include "pictures/frame_choice.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fmt/core.h>
#include <utility>

#include "analysis/failure/last_rise.h"
#include "base/errors.h"
#include "base/nearest_word.h"
#include "base/text.h"
#include "base/visible_text.h"
#include "core/trigonometry.h"

namespace talus::pictures {
namespace {

/// Returns the spacing of the frames, rad: their largest step, because single frames lie in between (at
/// failure); 1 degree if there is only one frame.
double frame_spacing(const std::vector<double>& tilts) {
  if (tilts.size() < 2) return radians(1.0);
  double spacing = 0.0;
  for (std::size_t k = 1; k < tilts.size(); ++k)
    spacing = std::max(spacing, std::abs(tilts[k] - tilts[k - 1]));
  return spacing;
}

/// Adds the frames nearest to multiples of `every` degrees on one rise or fall, which begins at frame
/// `first`.
void add_every(const std::vector<double>& way, std::size_t first, double every, double spacing,
               FrameChoice& choice) {
  const auto [low, high] = std::ranges::minmax(way);
  const auto multiple = [&](double angle) { return degrees(angle) / every; };
  const long begin = std::lround(std::ceil(multiple(low - 0.5 * spacing)));
  const long end = std::lround(std::floor(multiple(high + 0.5 * spacing)));
  for (long k = begin; k <= end; ++k)
    if (const auto frame = frame_near(way, radians(static_cast<double>(k) * every)))
      choice.push_back(first + *frame);
}

/// Returns the frame of an entry "frame42"; nothing for another entry.
std::optional<std::size_t> frame_numbered(const std::vector<double>& tilts, const std::string& entry) {
  constexpr std::string_view word = "frame";
  if (!entry.starts_with(word)) return std::nullopt;
  std::size_t frame = 0;
  const char* const last = entry.data() + entry.size();
  const auto [end, error] = std::from_chars(entry.data() + word.size(), last, frame);
  if (error != std::errc() || end != last) return std::nullopt;
  if (frame >= tilts.size())
    throw Error(ExitCode::bad_data, fmt::format("--at {}: the tilt of the run has {} frames, frame0 to "
                                                "frame{}",
                                                entry, tilts.size(), tilts.size() - 1));
  return frame;
}

std::size_t frame_at_angle(const std::vector<double>& tilts, const std::string& entry) {
  if (const auto numbered = frame_numbered(tilts, entry)) return *numbered;
  double angle = 0.0;
  const auto [end, error] = std::from_chars(entry.data(), entry.data() + entry.size(), angle);
  if (error != std::errc() || end != entry.data() + entry.size() || !std::isfinite(angle))
    throw Error(ExitCode::usage,
                fmt::format("--at {}: expected an angle in degrees, repose, or a frame such as "
                            "frame7{}",
                            visible_word(entry), did_you_mean(entry, {"repose"})));
  const auto frame = frame_near(tilts, radians(angle));
  if (!frame)
    throw Error(ExitCode::bad_data,
                fmt::format("--at {}: the run has no frame there; its {} frames run "
                            "from {} to {} deg, every {:.3g} deg",
                            entry, tilts.size(), degrees_text(std::ranges::min(tilts), 2),
                            degrees_text(std::ranges::max(tilts), 2), degrees(frame_spacing(tilts))));
  return *frame;
}

/// Returns the first and last frame of "0-10", or of "7".
std::pair<std::size_t, std::size_t> range_of(const std::string& entry) {
  std::size_t first = 0, last = 0;
  const char* const end = entry.data() + entry.size();
  auto parsed = std::from_chars(entry.data(), end, first);
  last = first;
  if (parsed.ec == std::errc() && parsed.ptr != end && *parsed.ptr == '-')
    parsed = std::from_chars(parsed.ptr + 1, end, last);
  if (parsed.ec != std::errc() || parsed.ptr != end || last < first)
    throw Error(ExitCode::usage,
                fmt::format("--frames {}: expected frame numbers such as --frames 0-10,20", entry));
  return {first, last};
}

FrameChoice sorted(FrameChoice choice) {
  std::sort(choice.begin(), choice.end());
  choice.erase(std::unique(choice.begin(), choice.end()), choice.end());
  return choice;
}

}  // namespace

std::optional<std::size_t> nearest_frame(const std::vector<double>& tilts, double tilt) {
  if (tilts.empty() || std::isnan(tilt)) return std::nullopt;
  const auto nearest =
      std::ranges::min_element(tilts, {}, [tilt](double frame_tilt) { return std::abs(frame_tilt - tilt); });
  return static_cast<std::size_t>(nearest - tilts.begin());
}

std::optional<std::size_t> reference_frame(std::size_t k, std::optional<std::size_t> since) {
  if (k == 0) return std::nullopt;
  const std::size_t frame = since.value_or(k - 1);
  return frame < k ? std::optional(frame) : std::nullopt;
}

std::optional<std::size_t> frame_near(const std::vector<double>& tilts, double tilt) {
  const double reach = 0.5 * frame_spacing(tilts) + 1e-9;
  const auto distance = [&](std::size_t k) { return std::abs(tilts[k] - tilt); };
  for (std::size_t k = 0; k < tilts.size(); ++k) {
    if (distance(k) > reach) continue;
    std::size_t nearest = k;
    for (; k + 1 < tilts.size() && distance(k + 1) <= distance(k); ++k)
      if (distance(k + 1) < distance(nearest)) nearest = k + 1;
    return nearest;
  }
  return std::nullopt;
}

FrameChoice frames_at(const std::vector<double>& tilts, const std::vector<std::string>& entries,
                      double theta_c) {
  FrameChoice choice;
  for (const std::string& entry : entries) {
    if (entry == "repose" && !std::isfinite(theta_c))
      throw Error(ExitCode::bad_data,
                  "--at repose: the angle of repose is unknown because the slope has not failed in "
                  "this run; give it with --theta-c DEG");
    choice.push_back(entry == "repose" ? frame_at_repose(tilts, theta_c) : frame_at_angle(tilts, entry));
  }
  return sorted(choice);
}

FrameChoice frames_listed(const std::vector<std::string>& entries, std::size_t count) {
  FrameChoice choice;
  for (const std::string& entry : entries) {
    const auto [first, last] = range_of(entry);
    if (last >= count)
      throw Error(ExitCode::bad_data,
                  fmt::format("--frames {}: the run has {} frames, 0 to {}; there is no frame {}", entry,
                              count, count - 1, last));
    for (std::size_t k = first; k <= last; ++k) choice.push_back(k);
  }
  return sorted(choice);
}

FrameChoice frames_every(const std::vector<double>& tilts, double every) {
  FrameChoice choice;
  const double spacing = frame_spacing(tilts);
  if (every < degrees(spacing) - 1e-9) {
    for (std::size_t k = 0; k < tilts.size(); ++k) choice.push_back(k);
    return choice;
  }
  if (!std::ranges::is_sorted(tilts)) {
    for (std::size_t first = 0; first + 1 < tilts.size();) {
      const bool up = tilts[first + 1] >= tilts[first];
      std::size_t last = first + 1;
      while (last + 1 < tilts.size() && (tilts[last + 1] >= tilts[last]) == up) ++last;
      add_every(analysis::SeriesPart{first, last + 1}.slice(tilts), first, every, spacing, choice);
      choice.push_back(last);
      first = last;
    }
    return sorted(choice);
  }
  const auto count = static_cast<long>(std::floor((tilts.back() + 0.5 * spacing) / radians(every)));
  for (long k = 0; k <= count; ++k)
    if (const auto frame = frame_near(tilts, radians(static_cast<double>(k) * every)))
      choice.push_back(*frame);
  return sorted(choice);
}

std::size_t frame_at_repose(const std::vector<double>& tilts, double theta_c) {
  const analysis::SeriesPart rise = analysis::last_rise(tilts);
  const std::vector<double> angles = analysis::magnitudes(tilts, rise);
  const auto above = std::upper_bound(angles.begin(), angles.end(), theta_c + 1e-9);
  return rise.first + (above == angles.begin() ? 0 : static_cast<std::size_t>(above - angles.begin()) - 1);
}

std::string angle_name(double tilt, int decimals) {
  const bool is_zero = degrees_text(tilt, decimals) == fixed_text(0.0, decimals);
  return fmt::format("{:0{}.{}f}", is_zero ? 0.0 : degrees(tilt), 4 + decimals, decimals);
}

int angle_decimals(const std::vector<double>& tilts, const FrameChoice& choice) {
  constexpr int max_decimals = 9;
  std::vector<std::string> names;
  for (int decimals = 2; decimals <= max_decimals; ++decimals) {
    names.clear();
    for (const std::size_t k : choice)
      if (k < tilts.size()) names.push_back(angle_name(tilts[k], decimals));
    if (std::ranges::adjacent_find(names) == names.end()) return decimals;
  }
  throw Error(ExitCode::bad_data,
              fmt::format("two frames of the run have the same angle, {} deg", names.front()));
}

}  // namespace talus::pictures
