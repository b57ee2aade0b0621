#include "pictures/traces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <limits>

#include "base/errors.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "pictures/scale.h"
#include "stress/stress.h"

namespace talus::pictures {
namespace {

struct TraceEntry {
  TraceKind kind;
  std::string_view name;
  analysis::QuantityMember member;
};

constexpr auto trace_entries = std::to_array<TraceEntry>({
    {TraceKind::overloaded, "overloaded", &analysis::FrameThreshold::overloaded_fraction},
    {TraceKind::largest_cluster, "largest_cluster", &analysis::FrameThreshold::largest_share},
    {TraceKind::stress_ratio, "stress_ratio", &analysis::FrameRecord::stress_ratio},
    {TraceKind::volume_strain, "volume_strain", &analysis::FrameRecord::volume_strain},
});

constexpr auto kinds = [] {
  std::array<TraceKind, trace_entries.size()> all{};
  for (std::size_t k = 0; k < trace_entries.size(); ++k) all[k] = trace_entries[k].kind;
  return all;
}();

const TraceEntry& trace_entry(TraceKind kind) { return trace_entries[static_cast<std::size_t>(kind)]; }

TraceKind kind_of(std::string_view name) {
  const auto found = std::ranges::find(trace_entries, name, &TraceEntry::name);
  if (found != trace_entries.end()) return found->kind;
  throw Error(ExitCode::usage, "trace '{}': expected {} or {}{}", visible_word(name),
              joined(std::span(trace_entries).first(trace_entries.size() - 1), ", ", &TraceEntry::name),
              trace_entries.back().name, did_you_mean(name, names_of(trace_entries)));
}

std::vector<render::AxisTick> axis_ticks(double low, double high, int most) {
  std::vector<render::AxisTick> ticks;
  for (const RoundTick& tick : round_ticks(low, high, most)) ticks.push_back({tick.value, tick.label});
  return ticks;
}

/// Returns the range of the finite values; widened by `margin` if all are equal; 0 to 1 without any.
ScaleRange range_of(std::span<const double> values, double margin) {
  ScaleRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const double value : values)
    if (std::isfinite(value)) range = {std::min(range.low, value), std::max(range.high, value)};
  if (range.low > range.high) return {0.0, 1.0};
  if (range.low == range.high) return {range.low - margin, range.high + margin};
  return range;
}

/// Extends a range to whole steps of its ticks.
ScaleRange rounded(const ScaleRange& range, int most) {
  const double step = round_step(range.high - range.low, most);
  return {step * std::floor(range.low / step + 1e-9), step * std::ceil(range.high / step - 1e-9)};
}

}  // namespace

std::span<const TraceKind> trace_kinds() { return kinds; }

std::string_view trace_name(TraceKind kind) { return trace_entry(kind).name; }

const analysis::Quantity& trace_quantity(TraceKind kind) {
  return analysis::quantity_of(trace_entry(kind).member);
}

std::vector<TraceKind> trace_kinds(std::string_view name) {
  std::vector<TraceKind> chosen;
  for (std::string_view rest = name;;) {
    const auto end = rest.find_first_of(",+");
    const TraceKind kind = kind_of(rest.substr(0, end));
    if (std::ranges::find(chosen, kind) != chosen.end())
      throw Error(ExitCode::usage, "trace '{}': the same trace twice", name);
    chosen.push_back(kind);
    if (end == std::string_view::npos) return chosen;
    rest.remove_prefix(end + 1);
  }
}

bool trace_from_frames(TraceKind kind) { return !trace_quantity(kind).display.observable; }

bool needs_theta_c(TraceKind kind) { return analysis::needs_threshold(trace_quantity(kind)); }

double frame_value(TraceKind kind, const BedFrame& bed, const OverloadRule& rule) {
  if (kind == TraceKind::overloaded) return stress::count_overloaded(bed, threshold_of(rule)).fraction();
  if (kind == TraceKind::largest_cluster) return analysis::largest_share(overloaded_clusters(bed, rule));
  throw Error(ExitCode::internal, "trace '{}' of a frame", trace_name(kind));
}

Observable trace_column(TraceKind kind) {
  if (const auto& column = trace_quantity(kind).display.observable) return *column;
  throw Error(ExitCode::internal, "trace '{}' has no column", trace_name(kind));
}

render::Trace make_trace(TraceKind kind, std::span<const double> places, std::span<const double> values,
                         const OverloadRule& rule, double place_now, TraceAxis axis) {
  const bool over_tilt = axis == TraceAxis::tilt;
  const auto shown_place = [over_tilt](double place) { return over_tilt ? degrees(place) : place; };
  constexpr int max_x = 8, max_y = 3;
  const analysis::Quantity& quantity = trace_quantity(kind);
  render::Trace trace;
  trace.title = analysis::shown_title(quantity);
  if (trace_from_frames(kind)) trace.title += ", " + reading_text(rule);
  trace.x_title = over_tilt ? analysis::axis_title("θ", "deg") : analysis::axis_title("t", "s");
  for (const double place : places) trace.x.push_back(shown_place(place));
  for (const double value : values) trace.y.push_back(analysis::shown(quantity, value, 1.0));
  trace.mark = shown_place(place_now);

  const ScaleRange x = range_of(trace.x, 0.5);
  const ScaleRange y = rounded(range_of(trace.y, 0.05), max_y);
  trace.x_min = x.low;
  trace.x_max = x.high;
  trace.y_min = y.low;
  trace.y_max = y.high;
  trace.x_ticks = axis_ticks(x.low, x.high, max_x);
  trace.y_ticks = axis_ticks(y.low, y.high, max_y + 1);
  const double theta_c = degrees(rule.theta_c);
  if (over_tilt && theta_c > x.low && theta_c <= x.high) {
    trace.event = theta_c;
    trace.event_label = "θ_c";
  }
  return trace;
}

}  // namespace talus::pictures
