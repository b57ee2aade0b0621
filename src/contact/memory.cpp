#include "contact/memory.h"

#include <algorithm>

namespace talus {
namespace {

/// Whether the pair of contact c of one list comes before that of contact d of the other.
bool before(const Contacts& one, Index c, const Contacts& other, Index d) {
  return one.a[c] < other.a[d] || (one.a[c] == other.a[d] && one.b[c] < other.b[d]);
}

/// The number of consecutive contacts, from c and from d on, that belong to the same pairs.
Index persisting(const Contacts& contacts, Index c, const Contacts& previous, Index d) {
  const Index longest = std::min(contacts.count() - c, previous.count() - d);
  Index run = 0;
  while (run < longest && contacts.a[c + run] == previous.a[d + run] &&
         contacts.b[c + run] == previous.b[d + run])
    ++run;
  return run;
}

template <bool moments>
void copy_forces(const Contacts& previous, Index d, Index run, Contacts& contacts, Index c) {
  std::copy_n(previous.fn.begin() + d, run, contacts.fn.begin() + c);
  std::copy_n(previous.ft.begin() + d, run, contacts.ft.begin() + c);
  if constexpr (moments) std::copy_n(previous.moment.begin() + d, run, contacts.moment.begin() + c);
}

template <bool moments>
void recall(const Contacts& previous, Contacts& contacts) {
  const Index count = contacts.count();
  const Index old_count = previous.count();
  Index c = 0;
  Index old = 0;
  while (c < count) {
    // Nearly all contacts persist, so the merge proceeds in long runs.
    const Index run = persisting(contacts, c, previous, old);
    copy_forces<moments>(previous, old, run, contacts, c);
    c += run;
    old += run;
    while (old < old_count && c < count && before(previous, old, contacts, c)) ++old;
    while (c < count && (old == old_count || before(contacts, c, previous, old))) {
      contacts.fn[c] = contacts.ft[c] = 0.0;
      ++c;
    }
  }
}

}  // namespace

void recall_forces(const Contacts& previous, Contacts& contacts) {
  if (contacts.moment.empty() || previous.moment.empty())
    recall<false>(previous, contacts);
  else
    recall<true>(previous, contacts);
}

}  // namespace talus
