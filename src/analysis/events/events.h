#pragma once
/// Rearrangements of a bed: bursts of motion between which it is quiet, and what moves in each.

#include <span>
#include <vector>

#include "core/bed_frame.h"
#include "core/types.h"

namespace talus::analysis {

/// A burst of motion, by places in a series of steps.
struct Burst {
  std::size_t first = 0;  ///< the first step as fast as the threshold
  std::size_t last = 0;   ///< the last one, before a quiet time or the end of the series
  bool is_over = false;   ///< a quiet time has followed
};

/// The bursts of a series of velocities, in their order: steps at or above `threshold`, with less than
/// `quiet_steps` slower ones in a row between them. quiet_steps >= 1. NaN is slow.
std::vector<Burst> find_bursts(std::span<const double> velocities, double threshold, std::size_t quiet_steps);

/// Median of the velocities outside of all bursts: what the solver leaves, and slow rearrangement. NaN where
/// there are none.
double quiet_velocity(std::span<const double> velocities, std::span<const Burst> bursts);

/// Where free grain i went between two frames, m: to the nearest of its periodic images, so that one that
/// went half a period or more is told too near.
Vec2 displacement_of(const Frame& before, const Frame& after, const RunStatics& statics, Index i);

/// That of the centre of mass of the free grains.
Vec2 mean_displacement(const Frame& before, const Frame& after, const RunStatics& statics);

/// Work of gravity on the free grains that are displaced by a mean of `displacement` (m) at a tilt (rad), J
/// per metre of thickness: M g (sin(theta) dx - cos(theta) dy). Between two states at rest this is what
/// contacts dissipate: the potential energy that is released, without the work of the rotation of the bed.
double gravity_work(const RunStatics& statics, Vec2 displacement, double tilt);

/// The grains that moved between two frames.
struct Movement {
  Index grains = 0;                      ///< free grains displaced by `least` or more
  double depth = not_known;              ///< m below `surface`, above which lie 95 % of their displacement
  Vec2 centre = {not_known, not_known};  ///< m: mean of their places before, weighted by displacement
};

/// `least` and `surface`, the height of the mean free surface, in m. In a periodic bed x of the centre is a
/// circular mean, in [0, length).
Movement movement_between(const Frame& before, const Frame& after, const RunStatics& statics, double least,
                          double surface);

}  // namespace talus::analysis
