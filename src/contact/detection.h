#pragma once
/// The contact room finds the contacts of a World: candidate pairs from a list that outlives several steps
/// (neighbour_list.h), then gaps and local frames (T3), then the forces of the step before, which are the
/// first guess of the solver.
///
/// Narrow phase: gaps and local frames (T3).

#include "base/thread_team.h"
#include "contact/neighbour_list.h"
#include "core/world.h"

namespace talus::contact {

/// Writes all pairs with a gap below `margin` (m) at the present positions, sorted by key, with normals and
/// gaps in the conventions of Contacts; recall_forces sets their forces. Two coincident centres get the
/// normal (0, 1). A team, if given, does the work together; the result is the same.
void detect_contacts(NeighbourList& list, const Grains& grains, const Boundary& boundary, double margin,
                     Contacts& contacts, ThreadTeam* team = nullptr);

// Contact memory: forces that persist from step to step (T18).

/// Gives each contact the force that the contact of the same two bodies carried in `previous`, and a new
/// contact zero force. Moments are recalled likewise if `contacts` has them; they must be zero before. Both
/// lists are sorted by key, so this is a merge. The shift is ignored, because it changes when a grain wraps
/// around the periodic edge. If one pair has several contacts through different images, in a bed a few grains
/// long, they are matched in order. A team, if given, does the work together.
void recall_forces(const Contacts& previous, Contacts& contacts, ThreadTeam* team = nullptr);

}  // namespace talus::contact
