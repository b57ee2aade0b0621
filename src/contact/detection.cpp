#include "contact/detection.h"

#include <algorithm>
#include <cmath>

namespace talus::contact {

namespace {

/// Local frames (T3) of some candidates: the normal from a to b, and the gap. The tangent is the normal
/// turned by +90 degrees.
struct LocalFrames {
  static constexpr std::size_t most = 256;
  double dx[most], dy[most];  ///< vector from the centre of a to that of b, for grains
  double nx[most], ny[most], gap[most];
  double room[most];  ///< positive if the gap is below the margin
};

void take_distances(const NeighbourList& list, const Grains& grains, double length, std::size_t first,
                    std::size_t count, LocalFrames& frames) {
  const double offset[] = {-length, 0.0, length};
  const double *const x = grains.x.data(), *const y = grains.y.data();
  const Index *const as = list.pairs.a.data() + first, *const bs = list.pairs.b.data() + first;
  const std::int8_t* const shift = list.pairs.shift.data() + first;
  const Index last = grains.count() - 1;
  for (std::size_t k = 0; k < count; ++k) {
    const Index a = as[k], b = std::min(bs[k], last);  // the result for a plane is not used
    frames.dx[k] = x[b] + offset[shift[k] + 1] - x[a];
    frames.dy[k] = y[b] - y[a];
  }
}

/// Computes the frames of pairs of grains together, so that the compiler vectorises the slow operations.
void frame_grains(const double* contact_distances, double margin, std::size_t count, LocalFrames& frames) {
  for (std::size_t k = 0; k < count; ++k) {
    const double dx = frames.dx[k], dy = frames.dy[k], contact_distance = contact_distances[k];
    const double limit = contact_distance + margin;
    const double square = dx * dx + dy * dy;
    const double distance = std::sqrt(square);
    const double divisor = distance > 0.0 ? distance : 1.0;
    const double ny = dy / divisor;
    frames.nx[k] = dx / divisor;
    frames.ny[k] = distance > 0.0 ? ny : 1.0;
    frames.gap[k] = distance - contact_distance;
    frames.room[k] = limit * limit - square;
  }
}

void frame_planes(const NeighbourList& list, const Grains& grains, const Boundary& boundary, double margin,
                  std::size_t first, std::size_t count, LocalFrames& frames) {
  if (boundary.planes.empty()) return;
  for (std::size_t k = 0; k < count; ++k) {
    if (list.pairs.b[first + k] < grains.count()) continue;
    const Index a = list.pairs.a[first + k];
    const Plane& plane = boundary.planes[list.pairs.b[first + k] - grains.count()];
    const double distance = plane.normal.x * grains.x[a] + plane.normal.y * grains.y[a] - plane.offset;
    frames.nx[k] = -plane.normal.x;  // from the grain to the plane
    frames.ny[k] = -plane.normal.y;
    frames.gap[k] = distance - grains.radius[a];
    frames.room[k] = margin - frames.gap[k];
  }
}

/// Writes the candidates whose gap is below the margin from `written` on, and returns their end. Each
/// candidate is written and then kept or overwritten, without a branch, because a branch would be
/// unpredictable.
std::size_t keep_near(const NeighbourList& list, const LocalFrames& frames, std::size_t first,
                      std::size_t count, std::size_t written, Contacts& contacts) {
  const Index *const as = list.pairs.a.data() + first, *const bs = list.pairs.b.data() + first;
  const std::int8_t* const shifts = list.pairs.shift.data() + first;
  // Copies, because the compiler must otherwise assume that the stores below change the pointers.
  Index *const a = contacts.a.data(), *const b = contacts.b.data();
  double *const nx = contacts.nx.data(), *const ny = contacts.ny.data(), *const gap = contacts.gap.data();
  std::int8_t* const shift = contacts.shift.data();
  for (std::size_t k = 0; k < count; ++k) {
    a[written] = as[k];
    b[written] = bs[k];
    nx[written] = frames.nx[k];
    ny[written] = frames.ny[k];
    gap[written] = frames.gap[k];
    shift[written] = shifts[k];
    written += frames.room[k] > 0.0 ? 1 : 0;
  }
  return written;
}

/// Writes the near pairs among candidates first ... last - 1 from position `first` on; returns their end.
std::size_t write_near(const NeighbourList& list, const Grains& grains, const Boundary& boundary,
                       double margin, std::size_t first, std::size_t last, Contacts& contacts) {
  std::size_t written = first;
  LocalFrames frames;
  while (first < last) {
    const std::size_t count = std::min(LocalFrames::most, last - first);
    take_distances(list, grains, boundary.length, first, count, frames);
    frame_grains(list.pairs.contact_distance.data() + first, margin, count, frames);
    frame_planes(list, grains, boundary, margin, first, count, frames);
    written = keep_near(list, frames, first, count, written, contacts);
    first += count;
  }
  return written;
}

/// Moves contacts first ... last - 1 to positions from `to` on; returns their end.
std::size_t move_down(std::size_t first, std::size_t last, std::size_t to, Contacts& contacts) {
  const auto move = [=](auto& field) {
    std::copy(field.begin() + static_cast<std::ptrdiff_t>(first),
              field.begin() + static_cast<std::ptrdiff_t>(last),
              field.begin() + static_cast<std::ptrdiff_t>(to));
  };
  if (first != to) {
    for (auto* field : {&contacts.a, &contacts.b}) move(*field);
    for (auto* field : {&contacts.nx, &contacts.ny, &contacts.gap}) move(*field);
    move(contacts.shift);
  }
  return to + (last - first);
}

}  // namespace

void detect_contacts(NeighbourList& list, const Grains& grains, const Boundary& boundary, double margin,
                     Contacts& contacts, ThreadTeam* team) {
  update_neighbour_list(list, grains, boundary, margin, team);
  const std::size_t candidates = list.pairs.count();
  contacts.resize(candidates);
  const std::size_t parts = team ? static_cast<std::size_t>(team->size()) : 1;
  const auto begin_of = [candidates, parts](std::size_t part) { return candidates * part / parts; };
  list.part_end.resize(parts);
  distribute(team, parts, [&](std::size_t part, std::size_t) {
    list.part_end[part] =
        write_near(list, grains, boundary, margin, begin_of(part), begin_of(part + 1), contacts);
  });
  std::size_t count = 0;
  for (std::size_t part = 0; part < parts; ++part)
    count = move_down(begin_of(part), list.part_end[part], count, contacts);
  contacts.resize(count);
}

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
    const Index begin = begin_of_pair(contacts, first);
    const Index end = begin_of_pair(contacts, last);
    if (moments)
      recall<true>(previous, contacts, begin, end);
    else
      recall<false>(previous, contacts, begin, end);
  });
}

}  // namespace talus::contact
