#include "solver/sweep_order.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <numeric>

namespace talus {
namespace {

constexpr Index lanes = lane_count * groups_abreast;
constexpr Index most_domains = 64;

/// Few, so that waves run through the bed in one sweep; so many that a phase has work for several threads.
Index domains_for(Index contacts) {
  constexpr Index contacts_for_four = 1000, contacts_for_a_pair = 8000;
  if (contacts < contacts_for_four) return 1;
  return std::clamp(2 * (contacts / contacts_for_a_pair), 4, most_domains);
}

/// The domain of each body: with as many contacts before it as make whole domains.
void share_bodies(const std::vector<Index>& first_a, long long contacts, Index domains, SweepOrder& order) {
  const std::size_t bodies = first_a.size() - 1;
  order.domain.resize(bodies);
  Index domain = 0;
  for (std::size_t i = 0; i < bodies; ++i) {  // domain = first_a domains / contacts, without dividing
    while (domain < domains - 1 && static_cast<long long>(first_a[i]) * domains >= (domain + 1) * contacts)
      ++domain;
    order.domain[i] = domain;
  }
}

/// The part of each contact.
void share_out(const ContactProblem& problem, const std::vector<Index>& first_a,
               const std::vector<std::uint8_t>& moves, const std::vector<std::uint8_t>& swept, Index domains,
               SweepOrder& order) {
  const auto contacts = static_cast<std::size_t>(problem.contact_count());
  const Index even_domains = (domains + 1) / 2;
  share_bodies(first_a, problem.contact_count(), domains, order);
  const auto part_of = [&](Index domain) { return domain / 2 + (domain % 2 == 0 ? 0 : even_domains); };
  order.part.resize(contacts);
  order.owner.assign(static_cast<std::size_t>(problem.body_count()), -1);
  for (std::size_t c = 0; c < contacts; ++c) {
    if (!swept[c]) continue;
    const Index a = problem.a[c], b = problem.b[c];
    const Index in_a = order.domain[moves[a] ? a : b], in_b = order.domain[moves[b] ? b : a];
    order.part[c] = part_of(in_a);
    if (in_a == in_b) continue;
    order.part[c] = domains;
    if (std::abs(in_a - in_b) != 1) continue;
    // A body of an odd domain meets one even neighbour only, in its phase.
    const Index even = in_a % 2 == 0 ? in_a : in_b;
    Index& owner = order.owner[in_a % 2 == 0 ? b : a];
    if (owner < 0) owner = even;
    if (owner == even) order.part[c] = part_of(even);
  }
  order.phase_begin = {0, even_domains, domains, domains + 1};
}

/// The first place from `place` on that has room; one that has none points to a later one.
Index first_with_room(std::vector<Index>& room, Index place) {
  Index end = place;
  while (room[end] != end) end = room[end];
  while (room[place] != end) {
    const Index next = room[place];
    room[place] = end;
    place = next;
  }
  return end;
}

/// Gives each part as many places for groups side by side as it has contacts, and one more, which stays
/// empty.
void make_places(const std::vector<std::uint8_t>& swept, Index parts, SweepOrder& order) {
  order.first_place.assign(static_cast<std::size_t>(parts) + 1, 0);
  for (std::size_t c = 0; c < swept.size(); ++c)
    if (swept[c]) ++order.first_place[order.part[c] + 1];
  for (Index part = 0; part < parts; ++part) order.first_place[part + 1] += order.first_place[part] + 1;
  const auto places = static_cast<std::size_t>(order.first_place[parts]);
  order.room.reserve(swept.size() + static_cast<std::size_t>(parts));
  order.fill.reserve(swept.size() + static_cast<std::size_t>(parts));
  order.room.resize(places);
  std::iota(order.room.begin(), order.room.end(), 0);
  order.fill.assign(places, 0);
}

/// Leaves out the places that stay empty: the last ones of each part.
void close_ranks(SweepOrder& order) {
  const auto parts = static_cast<Index>(order.first_place.size()) - 1;
  order.part_begin.assign(1, 0);
  for (Index part = 0; part < parts; ++part) {
    const auto begin = order.fill.begin() + order.first_place[part];
    const auto end = std::find(begin, order.fill.begin() + order.first_place[part + 1], 0);
    order.part_begin.push_back(order.part_begin.back() + groups_abreast * static_cast<Index>(end - begin));
  }
}

}  // namespace

void begin_order(const ContactProblem& problem, const std::vector<Index>& first_a,
                 const std::vector<std::uint8_t>& moves, const std::vector<std::uint8_t>& swept,
                 SweepOrder& order) {
  const Index domains = domains_for(problem.contact_count()), parts = domains + 1;
  for (auto* field : {&order.slot, &order.row_a, &order.row_b}) field->resize(swept.size());
  share_out(problem, first_a, moves, swept, domains, order);
  make_places(swept, parts, order);
  // Places are counted from the first of a part: a body that the part has not met waits for none.
  for (auto& next : order.next_place) next.assign(static_cast<std::size_t>(problem.body_count()), 0);
  order.row_count = SweepOrder::still_row(problem.body_count(), parts, 0, 0);
}

void order_parts(const ContactProblem& problem, const std::vector<std::uint8_t>& moves,
                 const std::vector<std::uint8_t>& swept, int member, int size, SweepOrder& order) {
  const Index bodies = problem.body_count();
  std::array<bool, most_domains + 1> is_mine{};
  for (std::size_t part = 0; part < is_mine.size(); ++part)
    is_mine[part] = static_cast<int>(part) % size == member;
  for (std::size_t c = 0; c < swept.size(); ++c) {
    if (!swept[c] || !is_mine[order.part[c]]) continue;
    const Index part = order.part[c], a = problem.a[c], b = problem.b[c];
    const int phase = part < order.phase_begin[1] ? 0 : part < order.phase_begin[2] ? 1 : 2;
    std::vector<Index>& next = order.next_place[phase];
    const Index first = order.first_place[part];
    const Index earliest = first + std::max(moves[a] ? next[a] : 0, moves[b] ? next[b] : 0);
    const Index place = first_with_room(order.room, earliest);
    const Index lane = order.fill[place];
    order.slot[c] = (place - first) * lanes + lane;
    if (++order.fill[place] == lanes) order.room[place] = place + 1;
    // A body that does not move may be met by several parts of a phase.
    if (moves[a]) next[a] = place - first + 1;
    if (moves[b]) next[b] = place - first + 1;
    order.row_a[c] = moves[a] ? a : SweepOrder::still_row(bodies, part, 0, lane % lane_count);
    order.row_b[c] = moves[b] ? b : SweepOrder::still_row(bodies, part, 1, lane % lane_count);
  }
}

void end_order(const std::vector<std::uint8_t>& swept, SweepOrder& order) {
  close_ranks(order);
  for (std::size_t c = 0; c < swept.size(); ++c)
    if (swept[c]) order.slot[c] += lane_count * order.part_begin[order.part[c]];
}

int most_members(const ContactProblem& problem) { return (domains_for(problem.contact_count()) + 1) / 2; }

}  // namespace talus
