#pragma once
/// Contact memory: forces that persist from step to step.

#include "core/contacts.h"

namespace talus {

/// Gives each contact the force that the contact of the same two bodies carried in `previous`; a new contact
/// has none. Both are sorted by key, so this is a merge.
/// The shift does not count: it changes when a grain wraps around the periodic edge. Contacts of one pair
/// through several images, in a bed of a few grains' length, are matched in their order.
void recall_forces(const Contacts& previous, Contacts& contacts);

}  // namespace talus
