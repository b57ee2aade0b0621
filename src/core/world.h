#pragma once
/// Core holds the nouns of the whole program, without behaviour. The World is the state of a simulation:
/// grains, boundary and contacts; it can be copied, compared by its hash, saved and restored. A Frame
/// (snapshot.h) is what a run records of it. Read next: contact/detection.h, solver/problem.h,
/// dynamics/step.h.

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/types.h"

namespace talus {

// The boundary of the grains: a periodic direction, and planes.

/// A fixed plane (a line in two dimensions): the half space { r : n.r >= offset } is free.
struct Plane {
  Vec2 normal;          ///< unit, into the free space
  double offset = 0.0;  ///< m
  bool wall = true;     ///< side wall, with the friction of walls; else a smooth floor, with that of grains
};

/// The boundary of a bed. In contact records, plane k has the body id grains.count() + k.
struct Boundary {
  bool periodic = false;  ///< periodic along x, with period `length`
  double length = 0.0;    ///< m: period, or distance between the side walls
  std::vector<Plane> planes;
};

/// Returns the offset from one position along the bed to another, m; in a periodic bed the shorter one.
inline double offset_along(const Boundary& boundary, double from, double to) {
  const double offset = to - from;
  return boundary.periodic ? std::remainder(offset, boundary.length) : offset;
}

// The grains: disks in structure-of-arrays form, grouped by frequency of access.

/// Disks by their stable ids: the free grains come first (0 ... free_count - 1), then the grains glued to the
/// floor, which never move. All quantities are per metre of thickness.
struct Grains {
  Index free_count = 0;

  // Read and written in each step.
  std::vector<double> x, y;    ///< centre, m; in a periodic bed x lies in [0, length)
  std::vector<double> vx, vy;  ///< velocity, m/s
  std::vector<double> omega;   ///< rotation velocity, rad/s, counter-clockwise positive

  // Read in each step.
  std::vector<double> radius;           ///< m
  std::vector<double> inverse_mass;     ///< 1/kg; 0 for a grain that does not move
  std::vector<double> inverse_inertia;  ///< 1/(kg m^2); 0 for a grain that does not rotate

  // Read by output and analysis.
  std::vector<double> mass;     ///< kg
  std::vector<double> inertia;  ///< kg m^2, about the centre; m r^2 / 2
  std::vector<double> angle;    ///< rad, rotation since the beginning, counter-clockwise positive
  std::vector<Index> image;  ///< number of exits through the right periodic edge minus those through the left

  Index count() const { return radius.size(); }
};

/// Reserves memory for `count` grains; up to this number the arrays are not moved.
void reserve(Grains& grains, std::size_t count);

/// Appends a disk at rest and returns its id. A free grain must not follow a floor grain. `density` is in
/// kg/m^3; a fixed disk has the mass of its size, but the inverse mass 0.
Index add_disk(Grains& grains, Vec2 centre, double radius, double density, bool fixed);

// The contacts of one step. With their forces they are the contact memory.

/// Status of a solved contact.
enum class ContactStatus : std::int8_t {
  open = 0,      ///< no force
  sticking = 1,  ///< |f_t| < mu f_n
  sliding = 2,   ///< |f_t| = mu f_n, friction fully mobilised ("critical contact")
};

/// Contacts and near contacts in structure-of-arrays form, sorted by key (a, b, shift) with a < b. The normal
/// points from a to b; the tangent is the normal turned by +90 degrees, t = (-n_y, n_x). The force acts on b
/// (and its opposite on a), so that a compressive f_n is positive. Relative velocities are those of b
/// relative to a, so that contacts with U_n > 0 separate.
struct Contacts {
  std::vector<Index> a, b;         ///< body ids; b may be a plane (see Boundary)
  std::vector<std::int8_t> shift;  ///< periodic image: b touches a from x_b + shift * length
  std::vector<double> nx, ny;      ///< normal, unit
  std::vector<double> gap;         ///< m; negative if the bodies overlap
  std::vector<double> fn, ft;      ///< mean force over the step, P / h, in N (per metre of thickness)

  /// Mean moment on b over the step, N m (per metre of thickness), counter-clockwise; its opposite acts on a.
  /// Empty if no contact resists rolling.
  std::vector<double> moment;

  Index count() const { return a.size(); }
  void resize(std::size_t size);
};

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
