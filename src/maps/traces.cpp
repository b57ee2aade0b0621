#include "maps/traces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/errors.h"
#include "core/trigonometry.h"
#include "maps/cluster_frame.h"
#include "maps/texts.h"
#include "stress/overload.h"

namespace talus {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct TraceEntry {
  TraceKind kind;
  std::string_view name, help;
  std::string_view title;
  double factor = 1.0;  ///< from the unit of the observable to that of the title
};

constexpr auto entries = std::to_array<TraceEntry>({
    {TraceKind::overloaded, "overloaded", "p_o, overloaded grains over those that carry something",
     "p_o, share of overloaded grains", 1.0},
    {TraceKind::largest_cluster, "largest_cluster", "share of the overloaded grains in their largest cluster",
     "Share of overloaded grains in their largest cluster", 1.0},
    {TraceKind::stress_ratio, "stress_ratio", "Gamma, stress ratio Q/P of the packing",
     "Γ = Q/P of the packing", 1.0},
    {TraceKind::volume_strain, "volume_strain", "volume strain, negative where the bed contracts",
     "Volume strain ΔV/V in %", 100.0},
});

constexpr auto kinds = [] {
  std::array<TraceKind, entries.size()> all{};
  for (std::size_t k = 0; k < entries.size(); ++k) all[k] = entries[k].kind;
  return all;
}();

const TraceEntry& entry_of(TraceKind kind) { return entries[static_cast<std::size_t>(kind)]; }

TraceKind kind_of(std::string_view name) {
  const auto found = std::ranges::find(entries, name, &TraceEntry::name);
  if (found != entries.end()) return found->kind;
  std::string message = std::string("trace '").append(name).append("': expected");
  for (const TraceEntry& entry : entries)
    message.append(&entry == &entries.front()  ? " "
                   : &entry == &entries.back() ? " or "
                                               : ", ")
        .append(entry.name);
  throw Error(ExitCode::usage, message);
}

std::vector<AxisTick> axis_ticks(double low, double high, int most) {
  std::vector<AxisTick> ticks;
  for (const RoundTick& tick : round_ticks(low, high, most)) ticks.push_back({tick.value, tick.label});
  return ticks;
}

struct Range {
  double low = 0.0, high = 0.0;
};

/// Of the finite values; widened by `margin` on either side where they are all the same, and 0 to 1 where
/// there are none.
Range range_of(std::span<const double> values, double margin) {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const double value : values)
    if (std::isfinite(value)) range = {std::min(range.low, value), std::max(range.high, value)};
  if (range.low > range.high) return {0.0, 1.0};
  if (range.low == range.high) return {range.low - margin, range.high + margin};
  return range;
}

/// To whole steps of its ticks.
Range rounded(const Range& range, int most) {
  const double step = round_step(range.high - range.low, most);
  return {step * std::floor(range.low / step + 1e-9), step * std::ceil(range.high / step - 1e-9)};
}

}  // namespace

std::span<const TraceKind> trace_kinds() { return kinds; }

std::string_view trace_name(TraceKind kind) { return entry_of(kind).name; }

std::string_view trace_help(TraceKind kind) { return entry_of(kind).help; }

std::vector<TraceKind> trace_kinds(std::string_view name) {
  std::vector<TraceKind> chosen;
  for (std::string_view rest = name;;) {
    const auto end = rest.find_first_of(",+");
    const TraceKind kind = kind_of(rest.substr(0, end));
    if (std::ranges::find(chosen, kind) != chosen.end())
      throw Error(ExitCode::usage, std::string("trace '").append(name).append("': twice the same trace"));
    chosen.push_back(kind);
    if (end == std::string_view::npos) return chosen;
    rest.remove_prefix(end + 1);
  }
}

bool trace_from_frames(TraceKind kind) {
  return kind == TraceKind::overloaded || kind == TraceKind::largest_cluster;
}

bool needs_theta_c(TraceKind kind) { return trace_from_frames(kind); }

double frame_value(TraceKind kind, const Frame& frame, const RunStatics& statics,
                   const MapSettings& settings) {
  if (kind == TraceKind::overloaded)
    return count_overloaded(frame, statics, overload_threshold(settings)).fraction();
  if (kind == TraceKind::largest_cluster) {
    const Clusters clusters = overloaded_clusters(frame, statics, settings);
    return clusters.members == 0 ? nan : static_cast<double>(clusters.size[0]) / clusters.members;
  }
  throw Error(ExitCode::internal, std::string("trace '").append(trace_name(kind)).append("' of a frame"));
}

Observable trace_column(TraceKind kind) {
  if (kind == TraceKind::stress_ratio) return Observable::stress_ratio;
  if (kind == TraceKind::volume_strain) return Observable::volume_strain;
  throw Error(ExitCode::internal, std::string("trace '").append(trace_name(kind)).append("' has no column"));
}

Trace make_trace(TraceKind kind, std::span<const double> tilts_rad, std::span<const double> values,
                 const MapSettings& settings, double tilt_now) {
  constexpr int most_x = 8, most_y = 3;
  const TraceEntry& entry = entry_of(kind);
  Trace trace;
  trace.title = entry.title;
  if (trace_from_frames(kind)) trace.title += ", " + reading_text(settings);
  trace.x_title = "θ in °";
  for (const double tilt : tilts_rad) trace.x.push_back(degrees(tilt));
  for (const double value : values) trace.y.push_back(entry.factor * value);
  trace.mark = degrees(tilt_now);

  const Range x = range_of(trace.x, 0.5);
  const Range y = rounded(range_of(trace.y, 0.05), most_y);
  trace.x_min = x.low;
  trace.x_max = x.high;
  trace.y_min = y.low;
  trace.y_max = y.high;
  trace.x_ticks = axis_ticks(x.low, x.high, most_x);
  trace.y_ticks = axis_ticks(y.low, y.high, most_y + 1);
  const double theta_c = degrees(settings.theta_c);
  if (theta_c > x.low && theta_c <= x.high) {
    trace.event = theta_c;
    trace.event_label = "θ_c";
  }
  return trace;
}

}  // namespace talus
