#pragma once
/// Contact memory: forces that persist from step to step (T18).

#include "base/thread_team.h"
#include "core/contacts.h"

namespace talus::contact {

/// Gives each contact the force that the contact of the same two bodies carried in `previous`; a new contact
/// has none. The same with moments, where `contacts` has room for them, which must be zero before. Both lists
/// are sorted by key, so this is a merge. The shift is ignored, since it changes when a grain wraps around
/// the periodic edge. Where one pair has several contacts through different images, in a bed of a few grains'
/// length, they are matched in order. Shared out to the team, if there is one.
void recall_forces(const Contacts& previous, Contacts& contacts, ThreadTeam* team = nullptr);

}  // namespace talus::contact
