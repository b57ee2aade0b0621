#include "contact/memory.h"

namespace talus {

void recall_forces(const Contacts& previous, Contacts& contacts) {
  const Index old_count = previous.count();
  Index old = 0;
  for (Index c = 0; c < contacts.count(); ++c) {
    const Index a = contacts.a[c];
    const Index b = contacts.b[c];
    while (old < old_count && (previous.a[old] < a || (previous.a[old] == a && previous.b[old] < b))) ++old;
    // The shift is left out of the key: a bed is always long enough for a pair to touch through one image
    // only, and the shift changes when one of the two wraps around the edge.
    const bool known = old < old_count && previous.a[old] == a && previous.b[old] == b;
    contacts.fn[c] = known ? previous.fn[old] : 0.0;
    contacts.ft[c] = known ? previous.ft[old] : 0.0;
  }
}

}  // namespace talus
