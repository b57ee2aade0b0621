#include "analysis/events/events.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/trigonometry.h"

namespace talus::analysis {

namespace {

/// Returns the finite values from `minimum` upwards, ascending.
std::vector<double> ascending_from(std::span<const double> values, double minimum) {
  std::vector<double> tail;
  for (const double value : values)
    if (value >= minimum && std::isfinite(value)) tail.push_back(value);
  std::ranges::sort(tail);
  return tail;
}

/// Fits the law to `tail`, which ascends from the minimum.
PowerLaw law_of_tail(std::span<const double> tail, double minimum) {
  PowerLaw law;
  law.minimum = minimum;
  law.count = static_cast<int>(tail.size());
  double logarithms = 0.0;
  for (const double value : tail) logarithms += std::log(value / minimum);
  if (law.count < min_fitted_values || !(logarithms > 0.0)) return law;
  const auto n = static_cast<double>(tail.size());
  law.exponent = 1.0 + n / logarithms;
  law.error = (law.exponent - 1.0) / std::sqrt(n);
  law.distance = 0.0;
  for (std::size_t k = 0; k < tail.size(); ++k) {
    const double below = 1.0 - law.share_from(tail[k]);
    const double before = static_cast<double>(k) / n, after = static_cast<double>(k + 1) / n;
    law.distance = std::max({law.distance, std::fabs(below - before), std::fabs(below - after)});
  }
  return law;
}

}  // namespace

double PowerLaw::share_from(double x) const { return std::pow(x / minimum, 1.0 - exponent); }

PowerLaw power_law_from(std::span<const double> values, double minimum) {
  return law_of_tail(ascending_from(values, minimum), minimum);
}

PowerLaw power_law(std::span<const double> values) {
  std::vector<double> all = ascending_from(values, 0.0);
  std::erase(all, 0.0);
  PowerLaw best;
  best.count = static_cast<int>(all.size());
  for (std::size_t k = 0; k + min_fitted_values <= all.size(); ++k) {
    if (k > 0 && all[k] == all[k - 1]) continue;
    const PowerLaw law = law_of_tail(std::span(all).subspan(k), all[k]);
    if (std::isfinite(law.exponent) && !(law.distance >= best.distance)) best = law;
  }
  return best;
}

ExponentialLaw exponential_law(std::span<const double> values, double minimum) {
  const std::vector<double> waits = ascending_from(values, minimum);
  ExponentialLaw law;
  law.count = static_cast<int>(waits.size());
  if (law.count < min_fitted_values) return law;
  const auto n = static_cast<double>(waits.size());
  double sum = 0.0;
  for (const double wait : waits) sum += wait - minimum;
  law.mean = sum / n;
  law.error = law.mean / std::sqrt(n);
  return law;
}

namespace {

constexpr double share_above_depth = 0.95;

/// A displaced grain.
struct MovedGrain {
  double y = 0.0, distance = 0.0;  ///< m
};

/// Returns the height above which the given share of the total displacement lies.
double height_above_which(std::vector<MovedGrain> moved, double share) {
  std::ranges::stable_sort(moved, std::ranges::greater(), &MovedGrain::y);
  double sum = 0.0, above = 0.0;
  for (const MovedGrain& grain : moved) sum += grain.distance;
  for (const MovedGrain& grain : moved) {
    above += grain.distance;
    if (above >= share * sum) return grain.y;
  }
  return moved.back().y;
}

}  // namespace

std::vector<Burst> find_bursts(std::span<const double> velocities, double threshold,
                               std::size_t quiet_steps) {
  std::vector<Burst> bursts;
  for (std::size_t k = 0; k < velocities.size(); ++k) {
    if (!bursts.empty() && k - bursts.back().last >= quiet_steps) bursts.back().is_over = true;
    if (!(velocities[k] >= threshold)) continue;
    if (bursts.empty() || k - bursts.back().last > quiet_steps) bursts.push_back({k, k, false});
    bursts.back().last = k;
    bursts.back().is_over = false;
  }
  return bursts;
}

double quiet_velocity(std::span<const double> velocities, std::span<const Burst> bursts) {
  std::vector<double> quiet;
  std::size_t next = 0;
  for (const Burst& burst : bursts) {
    quiet.insert(quiet.end(), velocities.begin() + static_cast<std::ptrdiff_t>(next),
                 velocities.begin() + static_cast<std::ptrdiff_t>(burst.first));
    next = burst.last + 1;
  }
  quiet.insert(quiet.end(), velocities.begin() + static_cast<std::ptrdiff_t>(next), velocities.end());
  if (quiet.empty()) return not_known;
  const auto middle = quiet.begin() + static_cast<std::ptrdiff_t>(quiet.size() / 2);
  std::ranges::nth_element(quiet, middle);
  return *middle;
}

Vec2 mean_displacement(const Frame& before, const Frame& after, const RunStatics& statics) {
  Vec2 sum;
  double mass = 0.0;
  for (Index i = 0; i < statics.free_count; ++i) {
    const Vec2 moved = displacement({after, statics}, before, i);
    sum.x += statics.mass[i] * moved.x;
    sum.y += statics.mass[i] * moved.y;
    mass += statics.mass[i];
  }
  return {sum.x / mass, sum.y / mass};
}

double gravity_work(const RunStatics& statics, Vec2 displacement, double tilt) {
  double mass = 0.0;
  for (Index i = 0; i < statics.free_count; ++i) mass += statics.mass[i];
  return mass * statics.gravity * (sine(tilt) * displacement.x - cosine(tilt) * displacement.y);
}

Movement movement_between(const Frame& before, const Frame& after, const RunStatics& statics, double least,
                          double surface) {
  std::vector<MovedGrain> moved;
  double sum = 0.0, along = 0.0, height = 0.0;
  Vec2 circle;
  for (Index i = 0; i < statics.free_count; ++i) {
    const Vec2 by = displacement({after, statics}, before, i);
    const double distance = std::hypot(by.x, by.y);
    if (!(distance >= least)) continue;
    moved.push_back({before.y[i], distance});
    const double angle = 2.0 * pi * before.x[i] / statics.length;
    circle.x += distance * std::cos(angle);
    circle.y += distance * std::sin(angle);
    along += distance * before.x[i];
    height += distance * before.y[i];
    sum += distance;
  }
  Movement movement;
  movement.grains = static_cast<Index>(moved.size());
  if (!(sum > 0.0)) return movement;
  const double turned = std::atan2(circle.y, circle.x) / (2.0 * pi);
  movement.centre = {statics.periodic ? statics.length * (turned - std::floor(turned)) : along / sum,
                     height / sum};
  movement.depth = surface - height_above_which(std::move(moved), share_above_depth);
  return movement;
}

}  // namespace talus::analysis
