#include "pictures/frame_choice.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fmt/core.h>

#include "analysis/failure/transition.h"
#include "base/errors.h"
#include "base/text.h"
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

/// Adds the frames nearest to multiples of `every` degrees on a rise or fall from frame `first` on.
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

/// Returns the number of an entry "frame42"; nothing for another entry.
std::optional<std::size_t> frame_number(std::string_view entry) {
  constexpr std::string_view word = "frame";
  if (!entry.starts_with(word)) return std::nullopt;
  std::size_t frame = 0;
  const char* const last = entry.data() + entry.size();
  const auto [end, error] = std::from_chars(entry.data() + word.size(), last, frame);
  return error == std::errc() && end == last ? std::optional(frame) : std::nullopt;
}

/// Adds the frames of an entry "frame42" or "frame0-frame10". Returns false for another entry.
bool add_numbered(const std::string& entry, std::size_t count, const char* whose, FrameChoice& choice) {
  const std::size_t dash = std::min(entry.find('-'), entry.size());
  const auto first = frame_number(std::string_view(entry).substr(0, dash));
  const auto last = dash == entry.size() ? first : frame_number(std::string_view(entry).substr(dash + 1));
  if (!first || !last || *last < *first) return false;
  if (*last >= count)
    throw Error(ExitCode::bad_data, "--at {}: {} has {} frames, frame0 to frame{}", entry, whose, count,
                count - 1);
  for (std::size_t k = *first; k <= *last; ++k) choice.push_back(k);
  return true;
}

std::size_t frame_at_angle(const std::vector<double>& tilts, const std::string& entry) {
  double angle = 0.0;
  const auto [end, error] = std::from_chars(entry.data(), entry.data() + entry.size(), angle);
  if (error != std::errc() || end != entry.data() + entry.size() || !std::isfinite(angle))
    throw Error(ExitCode::usage,
                "--at {}: expected an angle in degrees, repose, or frames such as frame7 or frame0-frame10{}",
                visible_word(entry), did_you_mean(entry, {"repose"}));
  const auto frame = frame_near(tilts, radians(angle));
  if (!frame)
    throw Error(ExitCode::bad_data,
                "--at {}: the run has no frame there; its {} frames run from {} to {} deg, every {:.3g} deg",
                entry, tilts.size(), degrees_text(std::ranges::min(tilts), 2),
                degrees_text(std::ranges::max(tilts), 2), degrees(frame_spacing(tilts)));
  return *frame;
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
                      double theta_c, std::optional<std::size_t> count) {
  FrameChoice choice;
  for (const std::string& entry : entries) {
    if (entry == "repose" && !std::isfinite(theta_c))
      throw Error(ExitCode::bad_data,
                  "--at repose: the slope has not failed in this run, so its angle of repose is unknown; "
                  "give an angle, or a frame such as frame42");
    if (entry == "repose")
      choice.push_back(frame_at_repose(tilts, theta_c));
    else if (!add_numbered(entry, count.value_or(tilts.size()), count ? "the run" : "the tilt of the run",
                           choice))
      choice.push_back(frame_at_angle(tilts, entry));
  }
  return sorted(choice);
}

std::size_t single_frame(const FrameChoice& choice, const std::string& entry) {
  if (choice.size() != 1)
    throw Error(ExitCode::usage, "--at {}: expected one frame, found {}", entry, choice.size());
  return choice.front();
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
  throw Error(ExitCode::bad_data, "two frames of the run have the same angle, {} deg", names.front());
}

}  // namespace talus::pictures
