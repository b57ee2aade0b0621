#pragma once
/// Scalars of the whole bed.

#include <vector>

#include "core/contacts.h"
#include "core/types.h"
#include "core/world.h"

namespace talus {

/// Area below the free surface (free_surface.h) and above y = 0, m^2.
double bed_volume(const Grains& grains, const Boundary& boundary, double spacing);

/// Area of the free grains, m^2.
double solid_area(const Grains& grains);

/// Height of the centre of mass of the free grains above y = 0, m.
double centre_of_mass_height(const Grains& grains);

/// How a contact is loaded, from the forces it carries. Sliding means |f_t| = mu f_n within `tolerance` f_n.
ContactStatus contact_status(double fn, double ft, double friction, double tolerance = 1e-6);

/// Coordination number z: contacts with force per free grain with force; each contact counts for each free
/// grain it touches.
double coordination_number(const Grains& grains, const Contacts& contacts);

}  // namespace talus
