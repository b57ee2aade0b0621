#pragma once
/// The state of a simulation, a value that can be copied, compared by its hash, saved and restored.

#include <cstdint>

#include "core/boundary.h"
#include "core/contacts.h"
#include "core/grains.h"

namespace talus {

/// Everything the next step depends on. The forces of the last step belong to it: a frictional packing with
/// more contacts than it needs has many admissible sets of forces, and memory decides between them.
struct World {
  Grains grains;
  Boundary boundary;
  Contacts contacts;      ///< of the last step, with their forces
  double gravity = 9.81;  ///< m/s^2
  double tilt = 0.0;      ///< rad; gravity is g (sin tilt, -cos tilt) in the frame of the bed
  double time = 0.0;      ///< s
  std::int64_t step = 0;  ///< steps taken since the beginning
};

/// Gravity in the frame of the bed (T1), m/s^2.
Vec2 gravity_vector(const World& world);

/// A hash of everything that the future of the world depends on, to the last bit.
std::uint64_t state_hash(const World& world);

/// sqrt of the mean squared velocity of the free grains, m/s; rotation counts with its rim velocity r omega.
double rms_velocity(const Grains& grains);

/// Translational and rotational kinetic energy of the free grains, J (per metre of thickness).
double kinetic_energy(const Grains& grains);

/// How the free grains move.
struct Motion {
  double rms_velocity = 0.0;      ///< as above, m/s
  double kinetic_energy = 0.0;    ///< as above, J
  double largest_velocity = 0.0;  ///< of a centre, m/s
  double mass = 0.0;              ///< of all free grains, kg
};
/// All of it in one pass, to the bits of the functions above.
Motion motion_of(const Grains& grains);

}  // namespace talus
