#include "analysis/failure/place.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace talus::analysis {
namespace {

const char* word_of(Place place) {
  switch (place) {
    case Place::run:
      break;
    case Place::start:
      return "@0";
    case Place::before_theta_d:
      return "@before_theta_d";
    case Place::theta_d:
      return "@theta_d";
    case Place::percolation:
      return "@percolation";
    case Place::theta_c:
      return "@theta_c";
  }
  return "";
}

std::vector<NumberOfRun> make_numbers() {
  std::vector<NumberOfRun> numbers;
  for (const Quantity& quantity : quantities())
    if (is_number_of_run(quantity)) numbers.push_back({quantity.member, Place::run});
  const auto add = [&](const QuantityMember& member, std::initializer_list<Place> places) {
    for (const Place place : places) numbers.push_back({member, place});
  };
  using enum Place;
  add(&FrameRecord::solid_fraction, {start, theta_c});
  add(&FrameRecord::coordination_number, {start, theta_d, theta_c});
  add(&FrameRecord::stress_ratio, {start, theta_d, theta_c});
  add(&FrameRecord::volume_strain, {theta_d, theta_c});
  add(&FrameRecord::centre_of_mass_strain, {theta_d, theta_c});
  add(&FrameThreshold::overloaded_fraction, {start, theta_d, percolation, theta_c});
  add(&FrameThreshold::overloaded_fraction_of_all, {start, theta_d, percolation, theta_c});
  add(&FrameThreshold::lc_mean, {start, theta_d, theta_c});
  add(&FrameThreshold::lc_max, {start, before_theta_d, theta_d, theta_c});
  return numbers;
}

std::optional<std::size_t> frame_at(const Analysis& analysis, const FramesOfRise& rise, Place place,
                                    std::size_t f) {
  const auto threshold_tilts = [&](double RunThreshold::*tilt) {
    return f < analysis.thresholds.size() ? frame_not_after(rise.tilts, analysis.thresholds[f].*tilt)
                                          : std::nullopt;
  };
  switch (place) {
    case Place::run:
      return std::nullopt;
    case Place::start:
      return rise.frames.empty() ? std::nullopt : std::optional<std::size_t>(0);
    case Place::before_theta_d: {
      const auto after = threshold_tilts(&RunThreshold::lc_jump);
      return after && *after > 0 ? std::optional(*after - 1) : std::nullopt;
    }
    case Place::theta_d:
      return threshold_tilts(&RunThreshold::lc_jump);
    case Place::percolation:
      return threshold_tilts(&RunThreshold::percolation);
    case Place::theta_c:
      return frame_not_after(rise.tilts, analysis.theta_c);
  }
  return std::nullopt;
}

}  // namespace

std::string name_of(const NumberOfRun& number) {
  return quantity_of(number.quantity).name + word_of(number.place);
}

std::span<const NumberOfRun> numbers_of_run() {
  static const std::vector<NumberOfRun> numbers = make_numbers();
  return numbers;
}

std::optional<std::size_t> frame_not_after(std::span<const double> tilts, double tilt) {
  const auto after = std::ranges::upper_bound(tilts, tilt + same_tilt);
  if (std::isnan(tilt) || after == tilts.begin()) return std::nullopt;
  return static_cast<std::size_t>(std::ranges::lower_bound(tilts, *(after - 1) - same_tilt) - tilts.begin());
}

double number_at(const Analysis& analysis, const NumberOfRun& number, std::size_t f) {
  const Quantity& quantity = quantity_of(number.quantity);
  if (number.place == Place::run) return number_of(quantity, analysis, f);
  const FramesOfRise rise = last_rise(analysis.frames);
  const auto k = frame_at(analysis, rise, number.place, f);
  return k ? number_on_one_side(quantity, *rise.frames[*k], f, rise.mirrored_slope) : not_known;
}

}  // namespace talus::analysis
