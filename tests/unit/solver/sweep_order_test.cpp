// Order in which contacts are swept, on random contact graphs.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <numeric>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "core/random.h"
#include "solver/linearisation.h"
#include "unit/solver/small_problems.h"

namespace talus::solver {
namespace {

struct Graph {
  ContactProblem problem;
  std::vector<Index> first_a;
  std::vector<std::uint8_t> moves, swept;
};

/// Returns contacts of each body with some of the `reach` next ones; every tenth body is immobile, and every
/// seventh contact is not swept.
Graph graph(Index bodies, Index contacts_each, Index reach) {
  Random random(11);
  Graph graph;
  graph.first_a.assign(static_cast<std::size_t>(bodies) + 1, 0);
  for (auto* field : {&graph.problem.vx, &graph.problem.vy})
    field->assign(static_cast<std::size_t>(bodies), 0.0);
  for (Index i = 0; i < bodies; ++i) {
    graph.moves.push_back(i % 10 == 3 ? 0 : 1);
    std::set<Index> others;
    for (Index k = 0; k < contacts_each; ++k)
      others.insert(std::min(bodies - 1, i + 1 + static_cast<Index>(random.uniform() * reach)));
    for (const Index b : others) {
      if (b == i) continue;
      graph.problem.a.push_back(i);
      graph.problem.b.push_back(b);
      graph.swept.push_back(graph.problem.a.size() % 7 == 2 ? 0 : 1);
    }
    graph.first_a[i + 1] = graph.problem.contact_count();
  }
  return graph;
}

/// Returns the same for the columns of a ring.
Graph ring(Index columns, Index bodies_each) {
  Graph graph{test::columns_problem(5, columns, bodies_each), {}, {}, {}};
  graph.first_a.assign(graph.problem.vx.size() + 1, 0);
  for (const Index a : graph.problem.a) ++graph.first_a[a + 1];
  std::partial_sum(graph.first_a.begin(), graph.first_a.end(), graph.first_a.begin());
  for (Index i = 0; i < graph.problem.body_count(); ++i)
    graph.moves.push_back(graph.problem.inverse_mass[i] > 0.0 ? 1 : 0);
  for (Index c = 0; c < graph.problem.contact_count(); ++c) graph.swept.push_back(c % 7 == 2 ? 0 : 1);
  return graph;
}

/// Returns the order made by a team, last member first: no member may need the results of another.
SweepOrder order_of(const Graph& graph, int size = 1) {
  SweepOrder order;
  begin_order(graph.problem, graph.first_a, size, order);
  for (int member = size - 1; member >= 0; --member)
    find_parts(graph.problem, graph.moves, graph.swept, member, size, order);
  open_order(graph.problem, graph.moves, graph.swept, order);
  for (int member = size - 1; member >= 0; --member)
    order_parts(graph.problem, graph.moves, graph.swept, member, size, order);
  end_order(order);
  place_slots(graph.swept, 0, graph.swept.size(), order);
  return order;
}

/// Graph created only by the test that uses it, because the program is restarted for each test.
struct NamedGraph {
  const char* name;
  Graph (*make)();
};
constexpr NamedGraph graphs[] = {{"none", [] { return graph(0, 1, 1); }},
                                 {"small", [] { return graph(40, 1, 3); }},
                                 {"bed", [] { return graph(3000, 2, 60); }},
                                 {"large_bed", [] { return graph(20000, 2, 400); }},
                                 {"of_far_contacts", [] { return graph(3000, 2, 3000); }},
                                 {"ring", [] { return ring(100, 80); }},
                                 {"ring_of_tall_columns", [] { return ring(10, 800); }},
                                 {"ring_of_too_few_columns", [] { return ring(7, 500); }}};
void PrintTo(const NamedGraph& graph, std::ostream* out) { *out << graph.name; }

class OrderOfSweep : public testing::TestWithParam<NamedGraph> {
 protected:
  const Graph graph_ = GetParam().make();
  const SweepOrder order_ = order_of(graph_);

  /// Calls a function for each swept contact with each of its mobile bodies.
  template <typename Do>
  void for_each_end(const Do& what) const {
    for (Index c = 0; c < graph_.problem.contact_count(); ++c)
      for (const Index body : {graph_.problem.a[c], graph_.problem.b[c]})
        if (graph_.swept[c] && graph_.moves[body]) what(c, body);
  }
  Index part_of(Index c) const {
    const auto& begin = order_.part_begin;
    return static_cast<Index>(std::ranges::upper_bound(begin, order_.slot[c] / lane_count) - begin.begin()) -
           1;
  }
  int phase_of(Index c) const {
    int phase = 0;
    while (part_of(c) >= order_.phase_begin[phase + 1]) ++phase;
    return phase;
  }
};

INSTANTIATE_TEST_SUITE_P(Graphs, OrderOfSweep, testing::ValuesIn(graphs),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

TEST_P(OrderOfSweep, has_one_slot_for_each_contact) {
  std::set<Index> slots;
  Index swept = 0;
  for (Index c = 0; c < graph_.problem.contact_count(); ++c) {
    if (!graph_.swept[c]) continue;
    ++swept;
    slots.insert(order_.slot[c]);
    EXPECT_LT(order_.slot[c], order_.group_count() * lane_count);
  }
  EXPECT_EQ(static_cast<Index>(slots.size()), swept);
}

TEST_P(OrderOfSweep, is_that_of_a_team) {
  const SweepOrder order = order_of(graph_, 3);
  EXPECT_EQ(order.part_begin, order_.part_begin);
  EXPECT_EQ(order.first_row, order_.first_row);
  EXPECT_EQ(order.row_count, order_.row_count);
  for (Index c = 0; c < graph_.problem.contact_count(); ++c) {
    if (!graph_.swept[c]) continue;
    ASSERT_EQ(order.slot[c], order_.slot[c]) << "contact " << c;
    ASSERT_EQ(order.row_a[c], order_.row_a[c]) << "contact " << c;
    ASSERT_EQ(order.row_b[c], order_.row_b[c]) << "contact " << c;
  }
}

TEST_P(OrderOfSweep, never_has_a_body_twice_in_groups_side_by_side) {
  std::set<std::pair<Index, Index>> met;
  for_each_end([&](Index c, Index body) {
    EXPECT_TRUE(met.insert({order_.slot[c] / (lane_count * groups_abreast), body}).second) << "contact " << c;
  });
}

TEST_P(OrderOfSweep, never_has_a_body_in_two_parts_of_a_phase) {
  std::map<std::pair<int, Index>, Index> part;
  for_each_end([&](Index c, Index body) {
    EXPECT_EQ(part.try_emplace({phase_of(c), body}, part_of(c)).first->second, part_of(c)) << "contact " << c;
  });
}

TEST_P(OrderOfSweep, visits_the_contacts_of_a_body_as_they_come_in_the_problem) {
  std::map<std::pair<Index, Index>, Index> last;  // group of the last contact of a body in a part
  for_each_end([&](Index c, Index body) {
    const Index abreast = order_.slot[c] / (lane_count * groups_abreast);
    const auto [at, first] = last.try_emplace({part_of(c), body}, abreast);
    EXPECT_TRUE(first || at->second < abreast) << "contact " << c;
    at->second = abreast;
  });
}

TEST_P(OrderOfSweep, has_rows_of_their_own_for_bodies_that_do_not_move) {
  const Index bodies = graph_.problem.body_count();
  for (Index c = 0; c < graph_.problem.contact_count(); ++c) {
    if (!graph_.swept[c]) continue;
    const Index a = graph_.problem.a[c], b = graph_.problem.b[c];
    EXPECT_EQ(order_.row_a[c] < bodies, graph_.moves[a] != 0);
    EXPECT_EQ(order_.row_b[c] < bodies, graph_.moves[b] != 0);
    EXPECT_LT(std::max(order_.row_a[c], order_.row_b[c]), order_.row_count);
  }
}

TEST_P(OrderOfSweep, has_one_row_for_each_body_that_moves) {
  std::map<Index, Index> row_of_body, body_of_row;
  for_each_end([&](Index c, Index body) {
    const Index row = body == graph_.problem.a[c] ? order_.row_a[c] : order_.row_b[c];
    EXPECT_EQ(row_of_body.try_emplace(body, row).first->second, row);
    EXPECT_EQ(body_of_row.try_emplace(row, body).first->second, body);
  });
}

// This allows each part to extrapolate the bodies that its contacts change.
TEST_P(OrderOfSweep, has_the_rows_that_a_part_changes_in_its_domain_and_in_runs_of_the_two_next_to_it) {
  const Index domains = order_.domain_count();
  ASSERT_EQ(order_.first_row.size(), static_cast<std::size_t>(SweepOrder::runs * domains) + 1);
  EXPECT_EQ(order_.first_row.back(), graph_.problem.body_count());
  const auto is_in = [](SweepOrder::Rows rows, Index row) { return rows.first <= row && row < rows.last; };
  for_each_end([&](Index c, Index body) {
    const Index row = body == graph_.problem.a[c] ? order_.row_a[c] : order_.row_b[c];
    const Index part = part_of(c), odd = order_.phase_begin[1], left = order_.phase_begin[2];
    if (part == left) return;
    const Index domain = part < odd ? 2 * part : 2 * (part - odd) + 1;
    const bool is_own = is_in(order_.rows_of_domain(domain), row);
    const auto before = order_.rows_of_run((domain + domains - 1) % domains, SweepOrder::meets_after);
    const auto after = order_.rows_of_run((domain + 1) % domains, SweepOrder::meets_before);
    EXPECT_TRUE(is_own || (part < odd && (is_in(before, row) || is_in(after, row)))) << "contact " << c;
  });
}

// Parts of the same phase must not extrapolate the same bodies.
TEST_P(OrderOfSweep, has_all_rows_of_an_even_domain_in_one_run) {
  for (Index domain = 0; domain < order_.domain_count(); domain += 2) {
    const auto all = order_.rows_of_domain(domain);
    const auto run = order_.rows_of_run(domain, SweepOrder::meets_none);
    EXPECT_EQ(run.first, all.first);
    EXPECT_EQ(run.last, all.last);
  }
}

TEST(OrderOfSweep, fills_its_groups_on_a_large_bed) {
  const Graph large = graph(20000, 2, 400);
  const auto swept = std::ranges::count(large.swept, 1);
  EXPECT_GT(static_cast<double>(swept), 0.9 * lane_count * order_of(large).group_count());
}

// This allows several sweeps to run through the bed as a wave.
TEST(OrderOfSweep, of_columns_is_a_ring) {
  const Graph large = ring(100, 80);
  const SweepOrder order = order_of(large);
  const Index domains = order.domain_count();
  ASSERT_TRUE(order.is_ring());
  ASSERT_EQ(domains, 6);
  ASSERT_EQ(order.first_row.size(), static_cast<std::size_t>(SweepOrder::runs * domains) + 1);
  EXPECT_EQ(order.first_row.front(), 0);
  EXPECT_EQ(order.first_row.back(), large.problem.body_count());
  std::vector<Index> contacts(static_cast<std::size_t>(domains), 0);
  const auto domain_of_row = [&order](Index row) {
    return (static_cast<Index>(std::ranges::upper_bound(order.first_row, row) - order.first_row.begin()) -
            1) /
           SweepOrder::runs;
  };
  for (Index c = 0; c < large.problem.contact_count(); ++c) {
    const Index a = large.problem.a[c], b = large.problem.b[c];
    if (!large.swept[c] || !large.moves[a] || !large.moves[b]) continue;
    const Index in_a = domain_of_row(order.row_a[c]), in_b = domain_of_row(order.row_b[c]);
    const Index apart = std::abs(in_a - in_b);
    EXPECT_TRUE(apart <= 1 || apart == domains - 1) << in_a << " and " << in_b;
    // A domain consists of adjacent columns.
    for (const auto& [body, domain] : {std::pair(a, in_a), std::pair(b, in_b)})
      EXPECT_NEAR((large.problem.column[body] + 0.5) / 100.0, (domain + 0.5) / domains, 0.6 / domains);
    ++contacts[static_cast<std::size_t>(in_a)];
  }
  for (const Index of_domain : contacts)
    EXPECT_NEAR(of_domain * domains, std::ranges::count(large.swept, 1), 0.2 * 100 * 80 * 3);
}

// A tall bed with few columns: by its size, 27 000 contacts, it would have six domains.
TEST(OrderOfSweep, of_columns_has_two_of_them_in_a_domain_at_least) {
  const SweepOrder order = order_of(ring(10, 800));
  EXPECT_EQ(order.domain_count(), 4);
  EXPECT_TRUE(order.is_ring());
  EXPECT_FALSE(order_of(ring(7, 500)).is_ring()) << "too few: the order of the bodies";
}

TEST(OrderOfSweep, with_a_contact_across_columns_is_no_ring) {
  Graph graph = ring(100, 80);
  const Index far = 50;
  // Connects the first contact of a mobile body with a column half the ring away.
  const auto moving = std::ranges::find_if(graph.problem.a, [&](Index a) { return graph.moves[a] != 0; });
  const auto c = static_cast<std::size_t>(moving - graph.problem.a.begin());
  graph.swept[c] = 1;
  const Index column = (graph.problem.column[*moving] + far) % 100;
  Index b = graph.problem.body_count() - 1;
  while (graph.problem.column[b] != column) --b;
  graph.problem.b[c] = b;
  EXPECT_FALSE(order_of(graph).is_ring());
}

TEST(OrderOfSweep, has_work_for_several_threads_on_a_large_bed_only) {
  EXPECT_EQ(max_members(graph(300, 2, 20).problem), 1);
  const Graph large = graph(20000, 2, 400);
  const SweepOrder order = order_of(large);
  EXPECT_GE(max_members(large.problem), 2);
  EXPECT_EQ(max_members(large.problem), order.phase_begin[1]);
  const Index left = order.part_begin[order.phase_begin[3]] - order.part_begin[order.phase_begin[2]];
  EXPECT_LT(left, order.group_count() / 20) << "groups that no part of a phase can contain";
}

}  // namespace
}  // namespace talus::solver
