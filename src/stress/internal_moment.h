#pragma once
/// Grain stresses: the internal moments of Moreau (1997; paper, Eq. 4; docs/theory.md).

#include <vector>

#include "core/contacts.h"
#include "core/grains.h"
#include "core/types.h"

namespace talus::stress {

/// Computes the internal moment of each grain, M_ij = - sum_a r_i f_j - (1/2) I omega^2 delta_ij (T19), with
/// r from the centre of the grain to the contact and f the force on the grain: one tensor for each grain,
/// floor included, in J per metre of thickness. Compression is positive. yx - xy is the torque of the contact
/// forces on the grain, counter-clockwise positive; at rest it vanishes, and M is symmetric, unless contacts
/// resist rolling. The moment of a set of grains is the sum of their moments.
void internal_moments(const Grains& grains, const Contacts& contacts, std::vector<Tensor2>& moments);

/// Returns the sum of the moments of grains first ... last - 1, in that order.
Tensor2 sum_of_moments(const std::vector<Tensor2>& moments, Index first, Index last);

}  // namespace talus::stress
