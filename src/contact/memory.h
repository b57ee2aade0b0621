#pragma once
/// Contact memory: forces that persist from step to step (T18).

#include "base/thread_team.h"
#include "core/contacts.h"

namespace talus::contact {

/// Gives each contact the force that the contact of the same two bodies carried in `previous`, and a new
/// contact zero force. Moments are recalled likewise if `contacts` has them; they must be zero before. Both
/// lists are sorted by key, so this is a merge. The shift is ignored, because it changes when a grain wraps
/// around the periodic edge. If one pair has several contacts through different images, in a bed a few grains
/// long, they are matched in order. A team, if given, does the work together.
void recall_forces(const Contacts& previous, Contacts& contacts, ThreadTeam* team = nullptr);

}  // namespace talus::contact
