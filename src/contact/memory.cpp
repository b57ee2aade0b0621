#include "contact/memory.h"

#include <algorithm>

namespace talus::contact {
namespace {

/// Whether the pair of contact c of one list precedes that of contact d of the other.
bool before(const Contacts& one, Index c, const Contacts& other, Index d) {
  return one.a[c] < other.a[d] || (one.a[c] == other.a[d] && one.b[c] < other.b[d]);
}

/// Returns the number of consecutive contacts that belong to the same pairs in both lists: c ... last - 1 of
/// one, and from d on of the other.
Index persisting(const Contacts& contacts, Index c, Index last, const Contacts& previous, Index d) {
  const Index longest = std::min(last - c, previous.count() - d);
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

/// Returns the first contact from c on whose pair differs from that of the contact before it.
Index begin_of_pair(const Contacts& contacts, Index c) {
  while (0 < c && c < contacts.count() && !before(contacts, c - 1, contacts, c)) ++c;
  return c;
}

/// Returns the first contact in `previous` that does not precede contact c of the other list.
Index first_not_before(const Contacts& previous, const Contacts& contacts, Index c) {
  Index first = 0, last = previous.count();
  while (first < last) {
    const Index middle = first + (last - first) / 2;
    if (before(previous, middle, contacts, c))
      first = middle + 1;
    else
      last = middle;
  }
  return first;
}

/// Recalls the forces of contacts c ... count - 1, which must be complete pairs.
template <bool moments>
void recall(const Contacts& previous, Contacts& contacts, Index c, Index count) {
  const Index old_count = previous.count();
  Index old = c < count ? first_not_before(previous, contacts, c) : 0;
  while (c < count) {
    // Nearly all contacts persist, so the merge proceeds in long runs.
    const Index run = persisting(contacts, c, count, previous, old);
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

void recall_forces(const Contacts& previous, Contacts& contacts, ThreadTeam* team) {
  const bool moments = !contacts.moment.empty() && !previous.moment.empty();
  distribute(team, contacts.a.size(), [&](std::size_t first, std::size_t last) {
    const Index begin = begin_of_pair(contacts, static_cast<Index>(first));
    const Index end = begin_of_pair(contacts, static_cast<Index>(last));
    if (moments)
      recall<true>(previous, contacts, begin, end);
    else
      recall<false>(previous, contacts, begin, end);
  });
}

}  // namespace talus::contact
