#pragma once
/// The contacts of one step. With their forces they are the contact memory.

#include <cstdint>
#include <vector>

#include "core/types.h"

namespace talus {

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

  Index count() const { return static_cast<Index>(a.size()); }
  void resize(std::size_t size);
};

}  // namespace talus
