#pragma once
/// Deposition by pouring: grains arrive one after another on the bed in its state at that time.
///
/// A grain falls freely along a vertical line until it first touches a body. Until then it is not a body of
/// the problem: it enters the world at its first contact, with the speed of its arrival. This is the dynamic
/// counterpart of random deposition from a source line (Bratberg, Radjai and Hansen 2002).

#include <span>
#include <vector>

#include "dynamics/bed.h"

namespace talus::dynamics {

/// A grain that has not arrived yet.
struct Arrival {
  double radius = 0.0;  ///< m
  double x = 0.0;       ///< m, position of the line along which it falls
};

/// Rule of the arrivals.
struct PourRule {
  double speed = 0.0;     ///< m/s, downwards, at the first contact of a grain
  double interval = 0.0;  ///< s between two arrivals; the first grain arrives at time 0
  double density = 0.0;   ///< kg/m^3
};

/// Returns sizes and positions of all grains of a plan in the order of their arrival. Positions are uniform
/// along the bed, at least the radius away from walls. The same plan gives the same arrivals on every
/// platform.
std::vector<Arrival> pour_arrivals(const BedPlan& plan);

/// Returns how many of `count` grains have arrived by a time (s).
Index arrived_by(double time, const PourRule& rule, Index count);

/// Returns the grains with all arrivals that are missing inserted after the free ones. Only sizes and masses
/// of the inserted grains are meaningful, not their positions.
Grains with_remaining_grains(Grains grains, std::span<const Arrival> arrivals, double density);

/// Adds the arrivals that are due at the time of the world, before a step of length h (s). The free grains of
/// the world must be the arrivals before them. Each gets the next id of a free grain; the ids of floor grains
/// and planes increase, in the contacts as well. A grain is placed above the first body in its way by the
/// distance that it falls in h/2, so that it touches at the midpoint of the step.
void add_due_grains(std::span<const Arrival> arrivals, const PourRule& rule, double h, World& world);

}  // namespace talus::dynamics
