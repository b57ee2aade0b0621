#include "runs/event_catalogue.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>

#include "analysis/events/events.h"
#include "analysis/failure/transition.h"
#include "analysis/packing/packing.h"
#include "core/snapshot.h"
#include "runs/run_view.h"

namespace talus::runs {
namespace {

constexpr double phase_of_tilt = 1.0;

/// The steps of the tilt: velocity[k] belongs to the state after step `first` + k.
struct TiltSteps {
  std::int64_t first = 0;
  std::vector<double> velocity;  ///< rms, m/s
  double h = 0.0;                ///< s
  std::vector<double> path;      ///< m; path[k] is the path length of the k steps before step k

  std::int64_t step(std::size_t k) const { return first + static_cast<std::int64_t>(k); }
  /// Returns the path length of the grains from one step to another, excluding the first of them, m.
  double path_between(std::int64_t from, std::int64_t to) const { return path_by(to) - path_by(from); }

 private:
  double path_by(std::int64_t step) const {
    const auto end = static_cast<std::int64_t>(velocity.size());
    return path[static_cast<std::size_t>(std::clamp(step - first + 1, std::int64_t{0}, end))];
  }
};

/// Returns the steps of the tilt; empty if the run has none, if one is missing, or if there are no two rows
/// to determine h.
std::optional<TiltSteps> tilt_steps(const io::RunFile& run, const std::vector<ObservableRow>& rows) {
  TiltSteps steps;
  for (const StepRow& row : run.steps()) {
    if (at(row, StepField::phase) != phase_of_tilt) continue;
    const auto number = static_cast<std::int64_t>(at(row, StepField::step));
    if (steps.velocity.empty()) steps.first = number;
    if (number != steps.step(steps.velocity.size())) return std::nullopt;
    steps.velocity.push_back(at(row, StepField::rms_velocity));
  }
  if (steps.velocity.empty() || rows.size() < 2) return std::nullopt;
  const double count = at(rows.back(), Observable::step) - at(rows.front(), Observable::step);
  steps.h = (at(rows.back(), Observable::time) - at(rows.front(), Observable::time)) / count;
  if (!(count > 0.0 && steps.h > 0.0)) return std::nullopt;
  steps.path.push_back(0.0);
  for (const double velocity : steps.velocity) steps.path.push_back(steps.path.back() + velocity * steps.h);
  return steps;
}

/// Rows by the number of their step.
struct StepSeries {
  const std::vector<ObservableRow>& rows;

  /// Return the last row at or before a step, and the first at or after it; beyond the series, the end of the
  /// series.
  const ObservableRow& not_after(std::int64_t step) const {
    const auto after = std::ranges::upper_bound(rows, static_cast<double>(step), {}, step_of);
    return after == rows.begin() ? rows.front() : *std::prev(after);
  }
  const ObservableRow& not_before(std::int64_t step) const {
    const auto found = std::ranges::lower_bound(rows, static_cast<double>(step), {}, step_of);
    return found == rows.end() ? rows.back() : *found;
  }
  /// Interpolates a value after a step between two rows.
  double value(std::int64_t step, Observable field) const {
    const ObservableRow &low = not_after(step), &high = not_before(step);
    const double width = step_of(high) - step_of(low);
    if (!(width > 0.0)) return at(low, field);
    return std::lerp(at(low, field), at(high, field), (static_cast<double>(step) - step_of(low)) / width);
  }

 private:
  static double step_of(const ObservableRow& row) { return at(row, Observable::step); }
};

/// State of an event while frames are read.
struct EventSpan {
  std::int64_t first = 0, last = 0;       ///< steps
  std::shared_ptr<const Frame> before{};  ///< the last frame before the event, once it has been read
  double surface = 0.0;                   ///< height of the mean free surface in this frame, m
};

double threshold_of(const io::RunFile& run, const analysis::AnalysisParameters& parameters, double h) {
  const double fall = run.header().statics.gravity * h;
  if (parameters.event_velocity) return *parameters.event_velocity * fall;
  const double tolerance = stored_scenario(run.header(), "the scenario of the run").solver.tolerance;
  return event_threshold_factor * solver_velocity_error * tolerance * fall;
}

analysis::EventRecord record_of(const analysis::Burst& burst, const TiltSteps& steps,
                                const StepSeries& series) {
  analysis::EventRecord event;
  const std::int64_t before = steps.step(burst.first) - 1, last = steps.step(burst.last);
  event.begin = series.value(before, Observable::tilt);
  event.end = series.value(last, Observable::tilt);
  event.time = series.value(before, Observable::time);
  event.duration = static_cast<double>(burst.last - burst.first + 1) * steps.h;
  event.path = steps.path_between(before, last);
  for (std::size_t k = burst.first; k <= burst.last; ++k)
    event.peak_velocity = std::fmax(event.peak_velocity, steps.velocity[k]);
  const ObservableRow &from = series.not_after(before), &to = series.not_before(last);
  const auto change = [&](Observable field) { return at(to, field) - at(from, field); };
  event.volume_strain = change(Observable::volume_strain);
  event.centre_of_mass_strain = change(Observable::centre_of_mass_strain);
  event.coordination_number = change(Observable::coordination_number);
  return event;
}

/// Returns the number of the first step of the last rise of the tilt.
double begin_of_last_rise(const std::vector<ObservableRow>& rows) {
  std::vector<double> tilts;
  for (const ObservableRow& row : rows) tilts.push_back(at(row, Observable::tilt));
  return at(rows[analysis::last_rise(tilts).first], Observable::step);
}

/// Returns the angle by which the bed is tilted from one step to another, up or down, rad.
double angle_turned(const StepSeries& series, std::int64_t from, std::int64_t to) {
  double angle = 0.0, tilt = series.value(from, Observable::tilt);
  const auto turn_to = [&](double next) {
    angle += std::abs(next - tilt);
    tilt = next;
  };
  for (const ObservableRow& row : series.rows)
    if (at(row, Observable::step) > static_cast<double>(from) &&
        at(row, Observable::step) < static_cast<double>(to))
      turn_to(at(row, Observable::tilt));
  turn_to(series.value(to, Observable::tilt));
  return angle;
}

/// Returns the kind of an event. Failure is the event of the last rise that begins before theta_c and ends
/// after it, and all later ones.
analysis::EventKind kind_of(const analysis::Burst& burst, const analysis::EventRecord& event, double theta_c,
                            bool in_last_rise) {
  if (in_last_rise && std::abs(event.end) >= theta_c) return analysis::EventKind::failure;
  return burst.is_over ? analysis::EventKind::rearrangement : analysis::EventKind::unfinished;
}

/// Reads the frames in order and assigns the motion between two frames to the events between them.
class EventFrames {
 public:
  EventFrames(const io::RunFile& run, const TiltSteps& steps, const analysis::AnalysisParameters& parameters,
              std::span<EventSpan> spans, analysis::Analysis& analysis)
      : statics_(run.header().statics),
        steps_(steps),
        least_(parameters.event_displacement * statics_.mean_diameter),
        spans_(spans),
        analysis_(analysis) {
    std::shared_ptr<const Frame> before;
    for (std::size_t k = 0; k < run.frame_count(); ++k) {
      const auto now = std::make_shared<const Frame>(run.positions(k));
      if (before) take_interval(before, *now, analysis.frames[k - 1].volume / statics_.length);
      before = now;
    }
  }

 private:
  /// Assigns the motion between two frames. `surface`: height of the mean free surface in the earlier frame,
  /// m.
  void take_interval(const std::shared_ptr<const Frame>& before, const Frame& now, double surface) {
    while (next_ < spans_.size() && spans_[next_].last <= before->step) ++next_;
    std::size_t end = next_;
    while (end < spans_.size() && spans_[end].first <= now.step) ++end;
    if (end == next_) return;
    const double work = analysis::gravity_work(statics_, analysis::mean_displacement(*before, now, statics_),
                                               0.5 * (before->tilt + now.tilt));
    const double path = steps_.path_between(before->step, now.step);
    const auto sharing = static_cast<Index>(end - next_);
    for (std::size_t e = next_; e < end; ++e) {
      analysis::EventRecord& event = analysis_.events[e];
      const double of_event = steps_.path_between(std::max(spans_[e].first - 1, before->step),
                                                  std::min(spans_[e].last, now.step));
      event.energy = (std::isnan(event.energy) ? 0.0 : event.energy) + work * of_event / path;
      event.sharing = std::max(event.sharing, sharing);
      if (!spans_[e].before) {
        spans_[e].before = before;
        spans_[e].surface = surface;
        event.frame_tilt[0] = before->tilt;
      }
      if (now.step >= spans_[e].last) measure_movement(now, spans_[e], event);
    }
  }

  void measure_movement(const Frame& now, EventSpan& span, analysis::EventRecord& event) const {
    const analysis::Movement movement =
        analysis::movement_between(*span.before, now, statics_, least_, span.surface);
    event.grains = movement.grains;
    event.depth = movement.depth;
    event.centre = {movement.centre.x, movement.centre.y};
    event.frame_tilt[1] = now.tilt;
    span.before.reset();
  }

  const RunStatics& statics_;
  const TiltSteps& steps_;
  double least_;  ///< m
  std::span<EventSpan> spans_;
  analysis::Analysis& analysis_;
  std::size_t next_ = 0;  ///< first event that is not over before the present frames
};

}  // namespace

double mean_grain_mass(const RunStatics& statics) {
  return std::accumulate(statics.mass.begin(), statics.mass.begin() + statics.free_count, 0.0) /
         statics.free_count;
}

void find_event_laws(double size_minimum, analysis::Analysis& analysis) {
  std::vector<double> sizes, waits;
  double dilating = 0.0, energy = 0.0;
  for (const analysis::EventRecord& event : analysis.events) {
    if (event.kind != static_cast<Index>(analysis::EventKind::rearrangement)) continue;
    sizes.push_back(event.energy);
    waits.push_back(event.waiting);
    if (!std::isnan(event.energy)) energy += event.energy;
    if (event.centre_of_mass_strain > 0.0) dilating += 1.0;
  }
  const auto count = static_cast<double>(sizes.size());
  analysis.event_count = count;
  analysis.event_energy = energy;
  const double share = dilating / count;
  analysis.event_dilating_share = share;
  analysis.event_dilating_share_error = std::sqrt(share * (1.0 - share) / count);

  const analysis::PowerLaw size =
      std::isnan(size_minimum) ? analysis::power_law(sizes) : analysis::power_law_from(sizes, size_minimum);
  analysis.event_size_exponent = size.exponent;
  analysis.event_size_exponent_error = size.error;
  analysis.event_size_minimum = size.minimum;
  analysis.event_size_distance = size.distance;
  analysis.event_size_count = size.count;
  const analysis::PowerLaw wait = analysis::power_law(waits);
  analysis.event_waiting_exponent = wait.exponent;
  analysis.event_waiting_exponent_error = wait.error;
  analysis.event_waiting_minimum = wait.minimum;
  analysis.event_waiting_distance = wait.distance;
  analysis.event_waiting_count = wait.count;
  double shortest = not_known;
  for (const double angle : waits) shortest = std::fmin(shortest, angle);
  const analysis::ExponentialLaw law = analysis::exponential_law(waits, shortest);
  analysis.event_waiting_mean = law.mean;
  analysis.event_waiting_mean_error = law.error;
}

void find_events(const io::RunFile& run, const std::vector<ObservableRow>& rows,
                 const analysis::AnalysisParameters& parameters, analysis::Analysis& analysis) {
  const auto steps = tilt_steps(run, rows);
  if (!steps) return;
  const RunStatics& statics = run.header().statics;
  const StepSeries series{rows};
  analysis.event_threshold = threshold_of(run, parameters, steps->h);
  analysis.event_quiet_time = parameters.event_quiet * std::sqrt(statics.mean_diameter / statics.gravity);
  const auto quiet_steps =
      static_cast<std::size_t>(std::max(1.0, std::round(analysis.event_quiet_time / steps->h)));
  const std::vector<analysis::Burst> bursts =
      analysis::find_bursts(steps->velocity, analysis.event_threshold, quiet_steps);
  analysis.event_noise = analysis::quiet_velocity(steps->velocity, bursts);
  const double last_rise_begins = begin_of_last_rise(rows);
  std::vector<EventSpan> spans;
  for (const analysis::Burst& burst : bursts) {
    const std::int64_t first = steps->step(burst.first), last = steps->step(burst.last);
    analysis::EventRecord event = record_of(burst, *steps, series);
    event.kind = static_cast<Index>(
        kind_of(burst, event, analysis.theta_c, static_cast<double>(last) >= last_rise_begins));
    if (!spans.empty()) event.waiting = angle_turned(series, spans.back().last, first - 1);
    analysis.events.push_back(event);
    spans.push_back({first, last});
  }
  EventFrames(run, *steps, parameters, spans, analysis);
  const double unit = mean_grain_mass(statics) * statics.gravity * statics.mean_diameter;
  find_event_laws(parameters.event_size_min ? *parameters.event_size_min * unit : not_known, analysis);
}

std::vector<FirstMove> first_moves(const io::RunFile& run, double distance) {
  const RunStatics& statics = run.header().statics;
  std::vector<bool> has_moved(static_cast<std::size_t>(statics.free_count), false);
  std::vector<FirstMove> moves;
  if (run.all_frame_tilts().empty()) return moves;
  const Frame begin = run.positions(0);
  for (std::size_t k = 1; k < run.all_frame_tilts().size(); ++k) {
    const Frame now = run.positions(k);
    const BedFrame bed{now, statics};
    const std::size_t first = moves.size();
    const double surface = analysis::frame_volume(bed) / statics.length;
    for (Index i = 0; i < statics.free_count; ++i) {
      const Vec2 moved = displacement(bed, begin, i);
      const double size = std::hypot(moved.x, moved.y);
      if (has_moved[i] || size < distance) continue;
      has_moved[i] = true;
      moves.push_back({i, k, now.time, now.tilt, now.x[i], now.y[i], surface - now.y[i], size});
    }
    std::stable_sort(moves.begin() + static_cast<std::ptrdiff_t>(first), moves.end(),
                     [](const FirstMove& a, const FirstMove& b) { return a.displacement > b.displacement; });
  }
  return moves;
}

}  // namespace talus::runs
