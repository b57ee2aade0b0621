#include "analysis/failure/transition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace talus::analysis {

SeriesPart last_rise(std::span<const double> tilts) {
  const auto rises = [&](std::size_t k) { return std::abs(tilts[k]) > std::abs(tilts[k - 1]); };
  const auto falls = [&](std::size_t k) { return std::abs(tilts[k]) < std::abs(tilts[k - 1]); };
  std::size_t top = tilts.empty() ? 0 : tilts.size() - 1;
  while (top > 0 && !rises(top)) --top;
  if (top == 0) return {0, tilts.size()};
  SeriesPart part{top, top + 1};
  while (part.first > 0 && !falls(part.first)) --part.first;
  while (part.end < tilts.size() && !falls(part.end)) ++part.end;
  return part;
}

std::vector<double> magnitudes(std::span<const double> tilts, const SeriesPart& part) {
  std::vector<double> found;
  for (const double tilt : tilts.subspan(part.first, part.size())) found.push_back(std::abs(tilt));
  return found;
}

bool slopes_backwards(std::span<const double> tilts, const SeriesPart& part) {
  return part.size() > 0 && tilts[part.end - 1] < 0.0;
}

bool has_side(const Quantity& quantity) {
  return quantity.member == QuantityMember(&FrameRecord::sigma_t_over_n) ||
         quantity.member == QuantityMember(&FrameRecord::texture_axis);
}

double number_on_one_side(const Quantity& quantity, const FrameRecord& frame, std::size_t f,
                          bool mirrored_slope) {
  return (mirrored_slope && has_side(quantity) ? -1.0 : 1.0) * number_of(quantity, frame, f);
}

FramesOfRise last_rise(std::span<const FrameRecord> frames) {
  std::vector<double> tilts;
  for (const FrameRecord& frame : frames) tilts.push_back(frame.tilt);
  const SeriesPart part = last_rise(tilts);
  FramesOfRise rise{part.first, {}, magnitudes(tilts, part), slopes_backwards(tilts, part)};
  for (const FrameRecord& frame : frames.subspan(part.first, part.size())) rise.frames.push_back(&frame);
  return rise;
}

std::vector<ObservableRow> rows_of_last_rise(std::span<const ObservableRow> rows) {
  std::vector<double> tilts;
  for (const ObservableRow& row : rows) tilts.push_back(at(row, Observable::tilt));
  const SeriesPart part = last_rise(tilts);
  const auto rise_rows = rows.subspan(part.first, part.size());
  std::vector<ObservableRow> rise(rise_rows.begin(), rise_rows.end());
  if (!slopes_backwards(tilts, part)) return rise;
  for (ObservableRow& row : rise)
    for (const Observable field :
         {Observable::tilt, Observable::sigma_t_over_n, Observable::surface_displacement})
      at(row, field) = -at(row, field);
  return rise;
}

namespace {

/// Endings of the names of numbers, in the order of Place.
constexpr std::array<const char*, 6> place_words = {"",         "@0",           "@before_theta_d",
                                                    "@theta_d", "@percolation", "@theta_c"};

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
  return quantity_of(number.quantity).name + place_words.at(static_cast<std::size_t>(number.place));
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

namespace {

constexpr std::size_t lasting = 3;  // frames in which a cluster has to span the bed
constexpr std::size_t min_to_fit = 5;

/// Returns the number of tilts up to theta_c, or of all tilts if it is NaN.
std::size_t count_up_to(std::span<const double> tilts, double theta_c) {
  if (std::isnan(theta_c)) return tilts.size();
  return static_cast<std::size_t>(std::ranges::upper_bound(tilts, theta_c) - tilts.begin());
}

/// Returns means over an equal number of neighbours on either side, within `reach` and within the series.
std::vector<double> symmetric_means(std::span<const double> tilts, std::span<const double> strains,
                                    double reach) {
  std::vector<double> means;
  for (std::size_t i = 0; i < tilts.size(); ++i) {
    double sum = strains[i];
    std::size_t n = 1;
    for (; n <= i && i + n < tilts.size() && tilts[i + n] - tilts[i] <= reach &&
           tilts[i] - tilts[i - n] <= reach;
         ++n)
      sum += strains[i - n] + strains[i + n];
    means.push_back(sum / static_cast<double>(2 * n - 1));
  }
  return means;
}

}  // namespace

LengthJump length_jump(std::span<const double> tilts, std::span<const double> lengths, double theta_c,
                       double cut) {
  LengthJump jump{not_known, not_known, not_known};
  double largest = 0.0;
  for (std::size_t k = 1; k < count_up_to(tilts, theta_c) && !(lengths[k - 1] >= cut); ++k) {
    const double increase = lengths[k] - lengths[k - 1];
    if (!(increase > largest)) continue;
    largest = increase;
    jump = {tilts[k], tilts[k] - tilts[k - 1], increase};
  }
  return jump;
}

PercolationOnset percolation_onset(std::span<const double> tilts, std::span<const Index> spans,
                                   double theta_c) {
  const std::size_t count = count_up_to(tilts, theta_c);
  for (std::size_t k = 0; k < count && k + lasting <= spans.size(); ++k)
    if (std::ranges::count(spans.subspan(k, lasting), 0) == 0)
      return {tilts[k], k > 0 ? tilts[k] - tilts[k - 1] : not_known};
  return {not_known, not_known};
}

DilationOnset dilation_onset(std::span<const double> tilts, std::span<const double> strains, double theta_c,
                             double window) {
  const std::size_t count = count_up_to(tilts, theta_c);
  if (count == 0) return {not_known, not_known, not_known};
  const auto means = symmetric_means(tilts.first(count), strains.first(count), 0.5 * window);
  double squares = 0.0;
  for (std::size_t i = 0; i < count; ++i) squares += (strains[i] - means[i]) * (strains[i] - means[i]);
  const auto lowest = std::ranges::min_element(means);
  const double limit = *lowest + std::sqrt(squares / static_cast<double>(count));
  auto low = lowest, high = lowest;
  while (low != means.begin() && *std::prev(low) <= limit) --low;
  while (std::next(high) != means.end() && *std::next(high) <= limit) ++high;
  if (std::next(high) == means.end()) return {not_known, not_known, not_known};
  const auto tilt_of = [&](auto place) { return tilts[place - means.begin()]; };
  return {tilt_of(lowest), tilt_of(low), tilt_of(high)};
}

GrowthExponent growth_exponent(std::span<const double> tilts, std::span<const double> sizes, double theta_c,
                               double window) {
  std::vector<double> x, y;
  for (std::size_t k = 0; k < tilts.size(); ++k)
    if (const double left = theta_c - tilts[k]; left > 0.0 && left <= window && sizes[k] > 0.0) {
      x.push_back(std::log(left));
      y.push_back(std::log(sizes[k]));
    }
  if (x.size() < min_to_fit) return {not_known, not_known};
  const auto n = static_cast<double>(x.size());
  const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / n;
  const double mean_y = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xx = 0.0, xy = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += (x[k] - mean_x) * (x[k] - mean_x);
    xy += (x[k] - mean_x) * (y[k] - mean_y);
  }
  const double slope = xy / xx;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double residual = y[k] - mean_y - slope * (x[k] - mean_x);
    squares += residual * residual;
  }
  return {-slope, std::sqrt(squares / (n - 2.0) / xx)};
}

double first_slide(std::span<const double> tilts, std::span<const double> displacements, double distance,
                   double window) {
  std::size_t end = 0;  // last row within the window of row k
  for (std::size_t k = 0; k < tilts.size(); ++k) {
    while (end + 1 < tilts.size() && tilts[end + 1] - tilts[k] <= window) ++end;
    if (displacements[end] - displacements[k] >= distance) return tilts[k];
  }
  return not_known;
}

}  // namespace talus::analysis
