#pragma once
/// Curves of an observable over the tilt, or over time, to be shown under a map.

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
  overloaded,       ///< p_o: overloaded grains over those that carry something
  largest_cluster,  ///< share of the overloaded grains in their largest cluster
  stress_ratio,     ///< Gamma = Q/P of the packing
  volume_strain,    ///< (V - V0)/V0; negative where the bed contracts
};

/// All of them, in the order in which they are listed to users.
std::span<const TraceKind> trace_kinds();

std::string_view trace_name(TraceKind kind);
/// What the trace shows.
const analysis::Quantity& trace_quantity(TraceKind kind);

/// The traces of a name: "overloaded", or several with commas or + between. Throws Error(usage) with the
/// names that there are at an unknown one, and where there is twice the same.
std::vector<TraceKind> trace_kinds(std::string_view name);

/// Whether its values come from frames (frame_value); else they are a column of the observables.
bool trace_from_frames(TraceKind kind);
/// Whether it depends on theta_c, or on the threshold.
bool needs_theta_c(TraceKind kind);

/// The value of a frame of mapped_frame; NaN where nothing is carried, or overloaded. Throws Error(internal)
/// where trace_from_frames is false.
double frame_value(TraceKind kind, const BedFrame& bed, const OverloadRule& rule);

/// Its column. Throws Error(internal) where trace_from_frames is true.
Observable trace_column(TraceKind kind);

/// What a trace is drawn over: the tilt, or, where this goes up and down, the time since it began.
enum class TraceAxis { tilt, time };

/// The curve of `values` (in the unit of the observables; NaN makes a gap) over `places` (rad or s,
/// ascending, as many), with the range of all of them, a mark at the place of the frame shown, and over the
/// tilt theta_c where it is known and in the range. The tilt is given in degrees.
render::Trace make_trace(TraceKind kind, std::span<const double> places, std::span<const double> values,
                         const OverloadRule& rule, double place_now, TraceAxis axis = TraceAxis::tilt);

}  // namespace talus::pictures
