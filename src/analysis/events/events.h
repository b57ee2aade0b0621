#pragma once
/// Rearrangements of a bed: bursts of motion separated by quiet periods, and the grains that move in each.

#include <span>
#include <vector>

#include "core/bed_frame.h"
#include "core/types.h"

namespace talus::analysis {

/// A burst of motion, given by indices into a series of steps.
struct Burst {
  std::size_t first = 0;  ///< the first step at or above the threshold
  std::size_t last = 0;   ///< the last such step before a quiet period or the end of the series
  bool is_over = false;   ///< whether a quiet period has followed
};

/// Returns the bursts of a series of velocities in order: steps at or above `threshold`, separated by fewer
/// than `quiet_steps` consecutive slower ones. quiet_steps >= 1. NaN counts as slow.
std::vector<Burst> find_bursts(std::span<const double> velocities, double threshold, std::size_t quiet_steps);

/// Returns the median of the velocities outside all bursts, due to solver residuals and slow rearrangement.
/// NaN if there are none.
double quiet_velocity(std::span<const double> velocities, std::span<const Burst> bursts);

/// Returns the displacement of the centre of mass of the free grains, m.
Vec2 mean_displacement(const Frame& before, const Frame& after, const RunStatics& statics);

/// Returns the work of gravity for a mean displacement of the free grains (m) at a tilt (rad), J per metre of
/// thickness: M g (sin(theta) dx - cos(theta) dy). Between two states at rest, contacts dissipate this
/// released potential energy. The work of rotating the bed is not included.
double gravity_work(const RunStatics& statics, Vec2 displacement, double tilt);

/// The grains displaced between two frames.
struct Movement {
  Index grains = 0;          ///< number of free grains displaced by `least` or more
  double depth = not_known;  ///< depth below `surface`, m, above which 95 % of the displacement lies
  Vec2 centre = {not_known, not_known};  ///< mean of the initial positions, weighted by displacement, m
};

/// Finds the displaced grains. `least` and the height `surface` of the mean free surface are in m. In a
/// periodic bed, x of the centre is a circular mean in [0, length).
Movement movement_between(const Frame& before, const Frame& after, const RunStatics& statics, double least,
                          double surface);

}  // namespace talus::analysis
