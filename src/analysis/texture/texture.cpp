#include "analysis/texture/texture.h"

#include <cmath>

#include "analysis/texture/contact_moment.h"
#include "stress/stress_state.h"

namespace talus::analysis {
namespace {

/// Returns the direction of the major principal stress of the contact forces, rad; NaN without contacts.
double stress_axis(const BedFrame& bed) {
  Tensor2 sum;
  for (Index c = 0; c < bed.frame.contacts.count(); ++c) add_moment(bed, c, sum);
  return bed.frame.contacts.count() > 0 ? stress::stress_state(sum).axis : not_known;
}

}  // namespace

Texture texture_of(const BedFrame& bed) {
  const FrameContacts& contacts = bed.frame.contacts;
  Texture texture;
  texture.axis = stress_axis(bed);
  const double axis_x = std::cos(2.0 * texture.axis), axis_y = std::sin(2.0 * texture.axis);
  double cosines = 0.0, forces = 0.0, force_cosines = 0.0, friction_sines = 0.0, lengths = 0.0,
         length_cosines = 0.0;
  for (Index c = 0; c < contacts.count(); ++c) {
    const double nx = contacts.nx[c], ny = contacts.ny[c];
    const double x = nx * nx - ny * ny, y = 2.0 * nx * ny;  // unit vector at twice the angle of the normal
    const double cosine = x * axis_x + y * axis_y;          // cosine and sine of twice the angle to the axis
    const double sine = y * axis_x - x * axis_y;
    const double length = branch_length(bed, c);
    cosines += cosine;
    forces += contacts.fn[c];
    force_cosines += contacts.fn[c] * cosine;
    friction_sines += contacts.ft[c] * sine;
    lengths += length;
    length_cosines += length * cosine;
  }
  texture.contacts = 2.0 * cosines / contacts.count();
  texture.normal_forces = 2.0 * force_cosines / forces - texture.contacts;
  texture.tangential_forces = -2.0 * friction_sines / forces;
  texture.branches = 2.0 * length_cosines / lengths - texture.contacts;
  return texture;
}

void measure_texture(const BedFrame& bed, FrameRecord& record) {
  const Texture texture = texture_of(bed);
  record.texture_axis = texture.axis;
  record.texture_contacts = texture.contacts;
  record.texture_normal_forces = texture.normal_forces;
  record.texture_tangential_forces = texture.tangential_forces;
  record.texture_branches = texture.branches;
  record.texture_stress_ratio = texture.stress_ratio();
}

}  // namespace talus::analysis
