#include "maps/frame_choice.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "core/errors.h"
#include "core/trigonometry.h"

namespace talus {
namespace {

std::string format(const char* pattern, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), pattern, value);
  return text.data();
}

/// Spacing of the frames, rad: their largest step, as single frames lie between (where the slope fails); 1
/// degree where there is only one.
double frame_spacing(const std::vector<double>& tilts) {
  if (tilts.size() < 2) return radians(1.0);
  double spacing = 0.0;
  for (std::size_t k = 1; k < tilts.size(); ++k) spacing = std::max(spacing, tilts[k] - tilts[k - 1]);
  return spacing;
}

std::size_t nearest(const std::vector<double>& tilts, double tilt) {
  const auto above = std::lower_bound(tilts.begin(), tilts.end(), tilt);
  if (above == tilts.begin()) return 0;
  if (above == tilts.end()) return tilts.size() - 1;
  const auto below = above - 1;
  return static_cast<std::size_t>((tilt - *below <= *above - tilt ? below : above) - tilts.begin());
}

std::size_t frame_at_angle(const std::vector<double>& tilts, const std::string& entry) {
  double angle = 0.0;
  const auto [end, error] = std::from_chars(entry.data(), entry.data() + entry.size(), angle);
  if (error != std::errc() || end != entry.data() + entry.size() || !std::isfinite(angle))
    throw Error(ExitCode::usage, "--at " + entry + ": expected an angle in degrees, or repose");
  const auto frame = frame_near(tilts, radians(angle));
  if (!frame)
    throw Error(ExitCode::bad_data, "--at " + entry + ": the run has no frame there; its " +
                                        std::to_string(tilts.size()) + " frames go from " +
                                        format("%.2f", degrees(tilts.front())) + " to " +
                                        format("%.2f", degrees(tilts.back())) + " deg, every " +
                                        format("%.3g", degrees(frame_spacing(tilts))) + " deg");
  return *frame;
}

FrameChoice sorted(FrameChoice choice) {
  std::sort(choice.begin(), choice.end());
  choice.erase(std::unique(choice.begin(), choice.end()), choice.end());
  return choice;
}

std::vector<std::string> names_with(const std::vector<double>& tilts, const FrameChoice& choice,
                                    const std::string& map, int decimals) {
  std::vector<std::string> names;
  for (std::size_t frame : choice) {
    std::array<char, 64> angle{};
    std::snprintf(angle.data(), angle.size(), "%0*.*f", 4 + decimals, decimals, degrees(tilts[frame]));
    names.push_back(map + "_" + angle.data() + ".png");
  }
  return names;
}

}  // namespace

std::optional<std::size_t> frame_near(const std::vector<double>& tilts, double tilt) {
  const std::size_t frame = nearest(tilts, tilt);
  if (std::abs(tilts[frame] - tilt) > 0.5 * frame_spacing(tilts) + 1e-9) return std::nullopt;
  return frame;
}

FrameChoice frames_at(const std::vector<double>& tilts, const std::vector<std::string>& entries,
                      double theta_c) {
  FrameChoice choice;
  for (const std::string& entry : entries) {
    if (entry == "repose" && !std::isfinite(theta_c))
      throw Error(ExitCode::bad_data,
                  "--at repose: the angle of repose is not known, as the slope has not failed in "
                  "this run; give it with --theta-c DEG");
    choice.push_back(entry == "repose" ? frame_at_repose(tilts, theta_c) : frame_at_angle(tilts, entry));
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
  const auto count = static_cast<long>(std::floor((tilts.back() + 0.5 * spacing) / radians(every)));
  for (long k = 0; k <= count; ++k)
    if (const auto frame = frame_near(tilts, radians(static_cast<double>(k) * every)))
      choice.push_back(*frame);
  return sorted(choice);
}

std::size_t frame_at_repose(const std::vector<double>& tilts, double theta_c) {
  const auto above = std::upper_bound(tilts.begin(), tilts.end(), theta_c + 1e-9);
  return above == tilts.begin() ? 0 : static_cast<std::size_t>(above - tilts.begin()) - 1;
}

std::vector<std::string> frame_names(const std::vector<double>& tilts, const FrameChoice& choice,
                                     const std::string& map) {
  constexpr int most_decimals = 9;
  std::vector<std::string> names;
  for (int decimals = 2; decimals <= most_decimals; ++decimals) {
    names = names_with(tilts, choice, map, decimals);
    if (std::adjacent_find(names.begin(), names.end()) == names.end()) return names;
  }
  throw Error(ExitCode::bad_data, "two frames of the run have the same angle, " + names.front() + " and on");
}

}  // namespace talus
