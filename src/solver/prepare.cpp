// Data that are constant during a solve: the contacts of each body, and the units of the single precision.

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "solver/linearisation.h"

namespace talus::solver {
namespace {

/// Copies `now` to `known` if they differ; returns whether they were equal.
template <typename Value>
bool follow(const Value& now, Value& known) {
  if (now == known) return true;
  known = now;
  return false;
}

bool follow_contacts(const ContactProblem& now, ContactProblem& known) {
  const bool same[] = {follow(now.a, known.a), follow(now.b, known.b), follow(now.mu, known.mu),
                       follow(now.rolling_friction, known.rolling_friction)};
  return std::ranges::find(same, false) == std::end(same);
}

bool follow_bodies(const ContactProblem& now, ContactProblem& known) {
  const bool same[] = {follow(now.inverse_mass, known.inverse_mass),
                       follow(now.inverse_inertia, known.inverse_inertia), follow(now.lever, known.lever),
                       follow(now.column, known.column), follow(now.columns, known.columns)};
  return std::ranges::find(same, false) == std::end(same);
}

/// Counts the contacts of each body i as a, in first_a[i + 1], and as b, in first_own_side[i], and sets
/// whether it can move. Each member of the team processes some of the bodies, and reads all contacts.
void count_contacts(const ContactProblem& problem, ThreadTeam* team, Linearisation& w) {
  distribute(team, w.moves.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      w.moves[i] = problem.inverse_mass[i] > 0.0 || problem.inverse_inertia[i] > 0.0 ? 1 : 0;
    for (const Index a : problem.a)
      if (first <= static_cast<std::size_t>(a) && static_cast<std::size_t>(a) < last) ++w.first_a[a + 1];
    for (const Index b : problem.b)
      if (first <= static_cast<std::size_t>(b) && static_cast<std::size_t>(b) < last) ++w.first_own_side[b];
  });
}

/// Computes the beginning of the contacts of each body from the numbers of contacts.
void place_contacts(Linearisation& w) {
  for (std::size_t i = 0; i < w.moves.size(); ++i) {
    const Index sides = w.first_own_side[i] + w.first_a[i + 1];
    w.first_own_side[i] += w.first_side[i];
    w.first_a[i + 1] += w.first_a[i];
    w.first_side[i + 1] = w.first_side[i] + (sides + sides_at_once - 1) / sides_at_once * sides_at_once;
  }
}

/// Lists the contacts of each body. Each member of the team processes some of the bodies, and reads all
/// contacts.
void list_sides(const ContactProblem& problem, ThreadTeam* team, Linearisation& w) {
  const auto none = 2 * static_cast<std::uint32_t>(problem.a.size());
  distribute(team, w.moves.size(), [&](std::size_t first, std::size_t last) {
    std::copy(w.first_side.data() + first, w.first_side.data() + last, w.next_side.data() + first);
    for (std::size_t c = 0; c < problem.b.size(); ++c) {
      const std::size_t b = problem.b[c];
      if (first <= b && b < last) w.sides[w.next_side[b]++] = 2 * static_cast<std::uint32_t>(c);
    }
    for (std::size_t i = first; i < last; ++i) {
      std::uint32_t* side = w.sides.data() + w.first_own_side[i];
      for (Index c = w.first_a[i]; c < w.first_a[i + 1]; ++c) *side++ = 2 * static_cast<std::uint32_t>(c) + 1;
      std::fill(side, w.sides.data() + w.first_side[i + 1], none);
    }
  });
}

/// Links each body to its contacts, unless contacts and bodies are those of the last problem.
void link(const ContactProblem& problem, bool were_loaded, ThreadTeam* team, Linearisation& w) {
  const std::size_t bodies = problem.body_count();
  const bool same_contacts = follow_contacts(problem, w.linked);
  const bool same_bodies = follow_bodies(problem, w.linked);
  w.are_loaded = were_loaded && w.first_a.size() == bodies + 1 && same_contacts && same_bodies;
  w.are_new = !w.are_loaded;
  if (!w.are_new) return;
  w.ordered_swept.clear();
  w.moves.resize(bodies);
  for (auto* field : {&w.first_a, &w.first_side, &w.first_own_side}) field->assign(bodies + 1, 0);
  count_contacts(problem, team, w);
  place_contacts(w);
  w.sides.resize(w.first_side[bodies]);
  w.next_side.resize(bodies);
  list_sides(problem, team, w);
}

/// Returns the sum of squares, in four strands, because a single one would wait for each addition.
double sum_of_squares(const std::vector<double>& values) {
  std::array<double, 4> strand{};
  const std::size_t fours = values.size() / 4;  // computed before the loop, so that it vectorises
  for (std::size_t i = 0; i < fours; ++i)
#pragma GCC unroll 4
    for (std::size_t k = 0; k < 4; ++k) strand[k] += values[4 * i + k] * values[4 * i + k];
  for (std::size_t i = 4 * fours; i < values.size(); ++i) strand[0] += values[i] * values[i];
  return (strand[0] + strand[1]) + (strand[2] + strand[3]);
}

/// Computes the number of moving bodies and their mean mobility.
void take_mean_body(const ContactProblem& problem, Linearisation& w) {
  double inverse_mass = 0.0;
  w.moving = 0;
  for (double each : problem.inverse_mass) {
    inverse_mass += each;
    w.moving += each > 0.0 ? 1 : 0;
  }
  w.mobility_unit = w.moving > 0 ? inverse_mass / w.moving : 1.0;
}

bool have_same_friction(const ContactProblem& problem) {
  const auto count = static_cast<std::ptrdiff_t>(problem.mu.size());
  return count == 0 || std::ranges::count(problem.mu, problem.mu.front()) == count;
}

/// Whether all bodies are disks in single precision.
bool are_disks(const ContactProblem& problem, double mobility_unit) {
  const double unit = 1.0 / mobility_unit;
  Index others = 0;
  for (Index i = 0; i < problem.body_count(); ++i)
    others += static_cast<float>(spin_mobility(problem, i) * unit) !=
              2.0F * static_cast<float>(problem.inverse_mass[i] * unit);
  return others == 0;
}

/// Chooses units in which neither impulses nor velocities are large, because increments become small: single
/// precision reaches down to 1e-38.
void choose_units(const ContactProblem& problem, const ContactSolution& guess, ThreadTeam* team,
                  Linearisation& w) {
  bool same_friction = false, all_disks = false;
  double vx = 0.0, vy = 0.0, cn = 0.0, ct = 0.0, pn = 0.0, pt = 0.0;
  run_both(
      team,
      [&] {
        if (w.are_new) {
          take_mean_body(problem, w);
          all_disks = are_disks(problem, w.mobility_unit);
        }
        vx = sum_of_squares(problem.vx);
        pn = sum_of_squares(guess.pn);
        pt = sum_of_squares(guess.pt);
      },
      [&] {
        if (w.are_new) same_friction = have_same_friction(problem);
        vy = sum_of_squares(problem.vy);
        cn = sum_of_squares(problem.cn);
        ct = sum_of_squares(problem.ct);
      });
  if (w.are_new) w.are_alike = same_friction && all_disks;
  const double velocity = std::sqrt(vx + vy + cn + ct);
  const double impulse =
      std::sqrt((pn + pt) / static_cast<double>(std::max<std::size_t>(1, guess.pn.size())));
  const double largest = std::max(impulse, velocity / w.mobility_unit / std::sqrt(std::max(1, w.moving)));
  w.impulse_unit = largest > 0.0 ? largest : 1.0;
  w.velocity_unit = w.impulse_unit * w.mobility_unit;
}

}  // namespace

void prepare(const ContactProblem& problem, const ContactSolution& guess, ThreadTeam* team,
             Linearisation& w) {
  const bool were_loaded = std::exchange(w.are_loaded, false);  // false while an allocation may fail
  const std::size_t contacts = problem.contact_count();
  w.exact_velocity.resize(problem.body_count());
  w.exact_force.resize(contacts + 1);
  w.exact_force[contacts] = {};
  for (auto* field : {&w.pn, &w.pt, &w.un, &w.ut, &w.wn, &w.wt}) field->resize(contacts);
  w.swept.assign(contacts, 0);
  w.sums.resize((contacts + contacts_per_block - 1) / contacts_per_block);
  size_rolling(problem, w.rolling);
  link(problem, were_loaded, team, w);
  choose_units(problem, guess, team, w);
}

}  // namespace talus::solver
