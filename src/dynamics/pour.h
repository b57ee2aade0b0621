#pragma once
/// Deposition by pouring: grains arrive one after another, each meets the bed as it is then.
///
/// A grain falls along a vertical line through nothing until it first touches, so until then it is not a body
/// of the problem: it enters the world where it touches, with the speed of its arrival. A rain on a bed in
/// Contact Dynamics; the dynamic counterpart of random deposition from a source line (Bratberg, Radjai and
/// Hansen 2002).

#include <span>
#include <vector>

#include "dynamics/bed.h"

namespace talus::dynamics {

/// A grain that has not arrived yet.
struct Arrival {
  double radius = 0.0;  ///< m
  double x = 0.0;       ///< m, the line along which it falls
};

/// How grains arrive.
struct PourRule {
  double speed = 0.0;     ///< m/s, downwards, when a grain first touches
  double interval = 0.0;  ///< s between one arrival and the next; the first arrives at time 0
  double density = 0.0;   ///< kg/m^3
};

/// Sizes and places of all grains of a plan, in the order in which they arrive: uniform along the bed,
/// between walls as far from them as their size asks. The same for the same plan, everywhere.
std::vector<Arrival> pour_arrivals(const BedPlan& plan);

/// How many of `count` grains have arrived by a time (s).
Index arrived_by(double time, const PourRule& rule, Index count);

/// The grains as they are, with those of the arrivals that are not among them yet behind the free ones; for
/// their sizes and masses, not for where they are.
Grains with_all_arrivals(Grains grains, std::span<const Arrival> arrivals, double density);

/// Lets the arrivals that are due by the time of the world enter it, before a step of length h (s): the free
/// grains of the world are the arrivals before them. Each gets the next id of a free grain; the ids of floor
/// grains and planes move up, in the contacts as well. A grain stands h/2 of its fall above the first body in
/// its way, so that the step finds it touching at its midpoint.
void let_arrive(std::span<const Arrival> arrivals, const PourRule& rule, double h, World& world);

}  // namespace talus::dynamics
