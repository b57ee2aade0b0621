#pragma once
/// The state of a simulation. It can be copied, compared by its hash, saved and restored.

#include <cstdint>

#include "core/boundary.h"
#include "core/contacts.h"
#include "core/grains.h"

namespace talus {

/// Everything on which the next step depends. This includes the forces of the last step, because a frictional
/// packing with more contacts than balance needs has many admissible sets of forces, and memory selects one.
struct World {
  Grains grains;
  Boundary boundary;
  Contacts contacts;      ///< contacts of the last step, with their forces
  double gravity = 9.81;  ///< m/s^2
  double tilt = 0.0;      ///< rad; gravity is g (sin tilt, -cos tilt) in the frame of the bed
  double time = 0.0;      ///< s
  std::int64_t step = 0;  ///< number of steps since the beginning
};

/// Returns gravity in the frame of the bed (T1), m/s^2.
Vec2 gravity_vector(const World& world);

/// Returns a hash of everything on which the future of the world depends, to the last bit.
std::uint64_t state_hash(const World& world);

/// Returns the root mean square velocity of the free grains, m/s, including the rim velocity r omega.
double rms_velocity(const Grains& grains);

/// Returns the translational and rotational kinetic energy of the free grains, J (per metre of thickness).
double kinetic_energy(const Grains& grains);

/// Motion of the free grains.
struct Motion {
  double rms_velocity = 0.0;      ///< m/s, see rms_velocity()
  double kinetic_energy = 0.0;    ///< J, see kinetic_energy()
  double largest_velocity = 0.0;  ///< largest velocity of a centre, m/s
  double mass = 0.0;              ///< mass of all free grains, kg
};
/// Computes all fields of Motion in one pass, with the same bits as the functions above.
Motion motion_of(const Grains& grains);

}  // namespace talus
