#pragma once
/// Scalars of the entire bed.

#include <span>
#include <vector>

#include "core/contacts.h"
#include "core/types.h"
#include "core/world.h"

namespace talus::stress {

/// Returns the area of the free grains, m^2.
double solid_area(const Grains& grains);

/// Returns the height of the centre of mass of the free grains above y = 0, m.
double centre_of_mass_height(const Grains& grains);

/// Returns the status of a contact with given forces. Sliding means |f_t| = mu f_n within `tolerance` f_n.
ContactStatus contact_status(double fn, double ft, double friction, double tolerance = 1e-6);

/// Returns the number of contacts of each of the first `count` grains. Contact c is between the bodies a[c]
/// and b[c], and carries force, as all contacts of a frame.
std::vector<Index> contacts_of_grains(std::span<const Index> a, std::span<const Index> b, Index count);

/// Returns the coordination number z: mean number of contacts of the grains that have any; 0 if none has.
double coordination_number(std::span<const Index> contacts_of_grains);

}  // namespace talus::stress
