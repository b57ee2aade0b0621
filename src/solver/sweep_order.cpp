#include <algorithm>
#include <array>
#include <cstdlib>
#include <numeric>

#include "base/thread_team.h"
#include "solver/linearisation.h"

namespace talus::solver {
namespace {

constexpr Index lanes = lane_count * groups_abreast;
constexpr Index of_two_domains = -1;  // part of a contact between two domains, until it is determined

struct Domains {
  Index count;
  bool by_columns;
};

/// Chooses the domains: few, so that changes travel through the bed in one sweep, but enough to give several
/// threads work in a phase. A domain has at least two columns, so that contacts join neighbouring domains
/// only; a large number of domains of consecutive bodies would be too thin for that.
Domains domains_of(const ContactProblem& problem) {
  constexpr Index contacts_for_four = 1000, contacts_for_a_pair = 8000;
  constexpr Index least = 4, most_of_bodies = 64;
  const Index contacts = problem.contact_count();
  if (contacts < contacts_for_four) return {1, false};
  const bool by_columns = problem.columns >= 2 * least;
  const Index most = by_columns ? std::min(problem.columns / 4 * 2, SweepOrder::max_domains) : most_of_bodies;
  return {std::clamp(2 * (contacts / contacts_for_a_pair), least, most), by_columns};
}

/// Returns the domain of the body or column that begins after `contacts_before` contacts, given that of its
/// predecessor: contacts_before domains / contacts, found without division because contacts_before never
/// falls.
Index domain_after(long long contacts_before, long long contacts, Index domains, Index domain) {
  while (domain < domains - 1 && contacts_before * domains >= (domain + 1) * contacts) ++domain;
  return domain;
}

/// Assigns consecutive bodies to domains.
void share_bodies(const std::vector<Index>& first_a, long long contacts, Index domains, SweepOrder& order) {
  Index domain = 0;
  for (std::size_t i = 0; i < order.domain.size(); ++i)
    order.domain[i] = domain = domain_after(first_a[i], contacts, domains, domain);
}

/// Assigns consecutive columns to domains.
void share_columns(const ContactProblem& problem, const std::vector<Index>& first_a, Index domains,
                   SweepOrder& order) {
  const std::vector<Index>& column = problem.column;
  order.contacts_of_column.assign(problem.columns, 0);
  for (std::size_t i = 0; i < column.size(); ++i)
    order.contacts_of_column[column[i]] += first_a[i + 1] - first_a[i];
  order.domain_of_column.resize(order.contacts_of_column.size());
  Index domain = 0;
  long long before = 0;
  for (std::size_t k = 0; k < order.domain_of_column.size(); ++k) {
    order.domain_of_column[k] = domain = domain_after(before, problem.contact_count(), domains, domain);
    before += order.contacts_of_column[k];
  }
  for (std::size_t i = 0; i < column.size(); ++i) order.domain[i] = order.domain_of_column[column[i]];
}

/// Whether two domains are neighbours.
bool are_neighbours(Index a, Index b, const SweepOrder& order) {
  const Index apart = std::abs(a - b);
  return apart == 1 || (order.by_columns && apart == order.domain_count() - 1);
}

/// The domains of the two bodies of a contact. A body that does not move belongs to that of the other.
struct TwoDomains {
  Index a, b;
};
TwoDomains two_domains(const ContactProblem& problem, const std::vector<std::uint8_t>& moves, std::size_t c,
                       const SweepOrder& order) {
  const Index a = problem.a[c], b = problem.b[c];
  return {order.domain[moves[a] ? a : b], order.domain[moves[b] ? b : a]};
}

/// Returns the part of a contact between two domains: that of the even domain, if the body in the odd domain
/// has no contact with its other even neighbour yet; else the remaining part.
Index part_between(const ContactProblem& problem, std::size_t c, TwoDomains in, SweepOrder& order) {
  const Index left = order.domain_count();
  if (!are_neighbours(in.a, in.b, order)) return left;
  // A body of an odd domain may be used by one even neighbour only in the first phase.
  const Index even = in.a % 2 == 0 ? in.a : in.b;
  Index& owner = order.owner[in.a % 2 == 0 ? problem.b[c] : problem.a[c]];
  if (owner < 0) owner = even;
  return owner == even ? order.part_of(even) : left;
}

/// Assigns rows to the bodies by domain and run, within a run in the order of the bodies. Rows changed by one
/// member of a team are thus adjacent, and rows changed by two members are separate from the rest.
void place_rows(SweepOrder& order) {
  const auto run_of = [&order](std::size_t i) {
    const Index domain = order.domain[i], owner = order.owner[i];
    // If neither body of a contact moves, one in an even domain may have an owner too: its own domain.
    const auto run = owner < 0 || domain % 2 == 0 ? SweepOrder::meets_none
                     : owner == domain - 1        ? SweepOrder::meets_before
                                                  : SweepOrder::meets_after;
    return SweepOrder::runs * domain + run;
  };
  order.first_row.assign(static_cast<std::size_t>(SweepOrder::runs * order.domain_count()) + 1, 0);
  for (std::size_t i = 0; i < order.row.size(); ++i) ++order.first_row[run_of(i)];
  std::partial_sum(order.first_row.begin(), order.first_row.end(),
                   order.first_row.begin());  // ends of the runs
  for (std::size_t i = order.row.size(); i-- > 0;) order.row[i] = --order.first_row[run_of(i)];
}

/// Returns the first place from `place` on that has room; a full place points to a later one.
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

/// Reserves for each part one place per contact, and one more, which remains empty.
void make_places(std::size_t contacts, Index parts, SweepOrder& order) {
  order.first_place.assign(static_cast<std::size_t>(parts) + 1, 0);
  for (Index part = 0; part < parts; ++part) {
    Index places = 1;
    for (const auto& share : order.shares) places += share[part];
    order.first_place[part + 1] = order.first_place[part] + places;
  }
  const auto places = static_cast<std::size_t>(order.first_place[parts]);
  order.room.reserve(contacts + static_cast<std::size_t>(parts));
  order.fill.reserve(contacts + static_cast<std::size_t>(parts));
  order.room.resize(places);
  std::iota(order.room.begin(), order.room.end(), 0);
  order.fill.assign(places, 0);
}

}  // namespace

void begin_order(const ContactProblem& problem, const std::vector<Index>& first_a, int size,
                 SweepOrder& order) {
  const std::size_t bodies = problem.body_count();
  const auto [domains, by_columns] = domains_of(problem);
  for (auto* field : {&order.slot, &order.row_a, &order.row_b, &order.part}) field->resize(problem.a.size());
  order.shares.resize(static_cast<std::size_t>(size));
  for (auto* field : {&order.domain, &order.row}) field->resize(bodies);
  order.by_columns = by_columns;
  if (by_columns)
    share_columns(problem, first_a, domains, order);
  else
    share_bodies(first_a, problem.contact_count(), domains, order);
  order.phase_begin = {0, (domains + 1) / 2, domains, domains + 1};
  order.owner.assign(bodies, -1);
  // Places count from the first of a part, so 0 is right for a body without a contact in the part yet.
  for (auto& next : order.next_place) next.assign(bodies, 0);
  order.row_count = SweepOrder::still_row(problem.body_count(), domains + 1, 0, 0);
}

void find_parts(const ContactProblem& problem, const std::vector<std::uint8_t>& moves,
                const std::vector<std::uint8_t>& swept, int member, int size, SweepOrder& order) {
  std::array<Index, SweepOrder::max_parts> share{};
  const auto last = static_cast<std::size_t>(part_begin(problem.contact_count(), member + 1, size));
  for (auto c = static_cast<std::size_t>(part_begin(problem.contact_count(), member, size)); c < last; ++c) {
    if (!swept[c]) continue;
    const TwoDomains in = two_domains(problem, moves, c, order);
    order.part[c] = in.a == in.b ? order.part_of(in.a) : of_two_domains;
    if (in.a == in.b) ++share[order.part[c]];
  }
  order.shares[member] = share;
}

void open_order(const ContactProblem& problem, const std::vector<std::uint8_t>& moves,
                const std::vector<std::uint8_t>& swept, SweepOrder& order) {
  for (std::size_t c = 0; c < swept.size(); ++c) {
    if (order.part[c] != of_two_domains || !swept[c]) continue;
    order.part[c] = part_between(problem, c, two_domains(problem, moves, c, order), order);
    ++order.shares.front()[order.part[c]];
  }
  place_rows(order);
  make_places(swept.size(), order.domain_count() + 1, order);
}

void order_parts(const ContactProblem& problem, const std::vector<std::uint8_t>& moves,
                 const std::vector<std::uint8_t>& swept, int member, int size, SweepOrder& order) {
  const Index bodies = problem.body_count();
  std::array<bool, SweepOrder::max_parts> is_mine{};
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
    // A body that does not move may have contacts in several parts of a phase.
    if (moves[a]) next[a] = place - first + 1;
    if (moves[b]) next[b] = place - first + 1;
    order.row_a[c] = moves[a] ? order.row[a] : SweepOrder::still_row(bodies, part, 0, lane % lane_count);
    order.row_b[c] = moves[b] ? order.row[b] : SweepOrder::still_row(bodies, part, 1, lane % lane_count);
  }
}

void end_order(SweepOrder& order) {
  const auto parts = static_cast<Index>(order.first_place.size()) - 1;
  // The empty places, the last ones of each part, are removed.
  order.part_begin.assign(1, 0);
  for (Index part = 0; part < parts; ++part) {
    const auto begin = order.fill.begin() + order.first_place[part];
    const auto end = std::find(begin, order.fill.begin() + order.first_place[part + 1], 0);
    order.part_begin.push_back(order.part_begin.back() + groups_abreast * static_cast<Index>(end - begin));
  }
}

void place_slots(const std::vector<std::uint8_t>& swept, std::size_t first, std::size_t last,
                 SweepOrder& order) {
  for (std::size_t c = first; c < last; ++c)
    if (swept[c]) order.slot[c] += lane_count * order.part_begin[order.part[c]];
}

int max_members(const ContactProblem& problem) { return (domains_of(problem).count + 1) / 2; }

}  // namespace talus::solver
