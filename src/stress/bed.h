#pragma once
/// Scalars of the whole bed.

#include <span>
#include <vector>

#include "core/contacts.h"
#include "core/types.h"
#include "core/world.h"

namespace talus::stress {

/// Area of the free grains, m^2.
double solid_area(const Grains& grains);

/// Height of the centre of mass of the free grains above y = 0, m.
double centre_of_mass_height(const Grains& grains);

/// How a contact is loaded, from the forces it carries. Sliding means |f_t| = mu f_n within `tolerance` f_n.
ContactStatus contact_status(double fn, double ft, double friction, double tolerance = 1e-6);

/// For each of the first `free_count` grains, in how many contacts with force it is. A contact between bodies
/// a[c] and b[c] carries the normal force fn[c].
std::vector<Index> loaded_contacts(std::span<const Index> a, std::span<const Index> b,
                                   std::span<const double> fn, Index free_count);

/// Coordination number z: mean number of contacts with force of the grains that have any; 0 where none has.
double coordination_number(std::span<const Index> loaded_contacts);
double coordination_number(const Grains& grains, const Contacts& contacts);

}  // namespace talus::stress
