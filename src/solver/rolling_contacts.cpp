#include <algorithm>

#include "solver/linearisation.h"

namespace talus::solver {
namespace {

// Under-relaxation of the rolling impulse.
constexpr double rolling_relaxation = 0.6;

}  // namespace

void size_rolling(const ContactProblem& problem, RollingContacts& w) {
  const std::size_t contacts = problem.resists_rolling() ? problem.a.size() : 0;
  for (auto* field : {&w.pr, &w.ur, &w.wr, &w.length}) field->resize(contacts);
  if (contacts == 0) return;
  const double largest = *std::ranges::max_element(problem.lever);
  w.unit_length = largest > 0.0 ? largest : 1.0;
}

void load_rolling(const ContactProblem& problem, std::size_t c, RollingContacts& w) {
  w.length[c] = rolling_length(problem, c);
  w.wr[c] = inverse_rolling_delassus(problem, c);
}

void load_rolling_group(const ContactProblem& problem, std::size_t c, Index slot, const RollingUnits& units,
                        RollingContacts& w) {
  RollingGroup& group = w.groups[slot / lane_count];
  const int k = slot % lane_count;
  const Index a = problem.a[c], b = problem.b[c];
  const double lever_a = problem.lever[a] / units.length, lever_b = problem.lever[b] / units.length;
  const double length = w.length[c] / units.length;
  const double square = units.length * units.length / units.mobility;
  const double inertia_a = problem.inverse_inertia[a] * square;
  const double inertia_b = problem.inverse_inertia[b] * square;
  group.mu[k] = static_cast<float>(problem.rolling_friction[c]);
  group.w[k] = static_cast<float>(rolling_relaxation * w.wr[c] * units.mobility);
  group.coupling[k] = static_cast<float>(length * (lever_a * inertia_a - lever_b * inertia_b));  // (T39)
  group.length[k] = static_cast<float>(length);
  group.lever_a[k] = static_cast<float>(lever_a);
  group.lever_b[k] = static_cast<float>(lever_b);
  group.inertia_a[k] = static_cast<float>(inertia_a);
  group.inertia_b[k] = static_cast<float>(inertia_b);
}

void start_rolling(Index slot, RollingContacts& w) {
  const int k = slot % lane_count;
  w.increment[slot / lane_count].r[k] = w.last_move[slot / lane_count].r[k] = 0.0F;
}

void linearise_rolling(const ContactProblem& problem, std::size_t c, Index slot, double pn,
                       const RollingUnits& units, RollingContacts& w) {
  RollingGroup& group = w.groups[slot / lane_count];
  const int k = slot % lane_count;
  const double bound = problem.rolling_friction[c] * pn;
  group.ur[k] = static_cast<float>(w.ur[c] * units.per_velocity);
  group.below[k] = static_cast<float>((-bound - w.pr[c]) * units.per_impulse);
  group.above[k] = static_cast<float>((bound - w.pr[c]) * units.per_impulse);
}

double take_rolling_increment(std::size_t c, Index slot, double impulse_unit, RollingContacts& w) {
  float& increment = w.increment[slot / lane_count].r[slot % lane_count];
  const double pr = w.pr[c] + impulse_unit * static_cast<double>(increment);
  increment = 0.0F;
  return pr;
}

void take_rolling(const ContactProblem& problem, RollingContacts& w, ResidualArrays& arrays) {
  arrays.length = w.length.data();
  arrays.mu_r = problem.rolling_friction.data();
  arrays.pr = w.pr.data();
  arrays.wr = w.wr.data();
  arrays.ur = w.ur.data();
}

}  // namespace talus::solver
