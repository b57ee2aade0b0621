#pragma once
/// Curves of an observable over tilt or time, shown below a map.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/quantities.h"
#include "core/observables.h"
#include "pictures/maps.h"
#include "render/frame_view.h"

namespace talus::pictures {

enum class TraceKind {
  overloaded,       ///< p_o: overloaded grains over those that carry force
  largest_cluster,  ///< share of the overloaded grains in their largest cluster
  stress_ratio,     ///< Gamma = Q/P of the packing
  volume_strain,    ///< (V - V0)/V0; negative if the bed contracts
};

/// Returns all traces, in the order in which they are listed to users.
std::span<const TraceKind> trace_kinds();

std::string_view trace_name(TraceKind kind);
/// Returns the quantity that the trace shows.
const analysis::Quantity& trace_quantity(TraceKind kind);

/// Returns the traces of a name: "overloaded", or several joined by commas or +. Throws Error(usage) for an
/// unknown name, listing the valid ones, and for a repeated trace.
std::vector<TraceKind> trace_kinds(std::string_view name);

/// Whether its values come from frames (frame_value); otherwise they are a column of the observables.
bool trace_from_frames(TraceKind kind);
/// Whether it depends on theta_c, or on the threshold.
bool needs_theta_c(TraceKind kind);

/// Returns the value at a frame of mapped_frame; NaN if no force is carried, or nothing is overloaded. Throws
/// Error(internal) if trace_from_frames is false.
double frame_value(TraceKind kind, const BedFrame& bed, const OverloadRule& rule);

/// Returns its column. Throws Error(internal) if trace_from_frames is true.
Observable trace_column(TraceKind kind);

/// The axis of a trace: the tilt or, if this goes up and down, the time since it began.
enum class TraceAxis { tilt, time };

/// Returns the curve of `values` (in the unit of the observables; NaN makes a gap) over `places` (rad or s,
/// ascending, as many), with the range of all of them and a mark at the frame shown; on the tilt axis also
/// theta_c, if it is known and in the range. The tilt is given in degrees.
render::Trace make_trace(TraceKind kind, std::span<const double> places, std::span<const double> values,
                         const OverloadRule& rule, double place_now, TraceAxis axis = TraceAxis::tilt);

}  // namespace talus::pictures
