#pragma once
/// Narrow phase: gaps and local frames (T3).

#include "base/thread_team.h"
#include "contact/neighbour_list.h"
#include "core/contacts.h"

namespace talus::contact {

/// Writes all pairs with a gap below `margin` (m) at the present positions, sorted by key, with normals and
/// gaps in the conventions of Contacts; recall_forces sets their forces. Two coincident centres get the
/// normal (0, 1). A team, if given, does the work together; the result is the same.
void detect_contacts(NeighbourList& list, const Grains& grains, const Boundary& boundary, double margin,
                     Contacts& contacts, ThreadTeam* team = nullptr);

}  // namespace talus::contact
