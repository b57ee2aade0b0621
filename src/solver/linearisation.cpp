#include "solver/linearisation.h"

#include <algorithm>
#include <cmath>

#include "solver/contact_law.h"

namespace talus {
namespace {

constexpr auto lanes = static_cast<std::size_t>(lane_count);
// The modes that limit the step are tangential: grains that turn like gears. Steps a little shorter along the
// tangent allow longer ones along the normal.
constexpr double tangential_step = 0.8;

/// The contacts of each body: as a they are consecutive, as b they are listed. From step to step they are
/// mostly the same.
void link(const ContactProblem& problem, Linearisation& w) {
  const auto bodies = static_cast<std::size_t>(problem.body_count());
  if (w.first_a.size() == bodies + 1 && w.linked_a == problem.a && w.linked_b == problem.b) return;
  w.linked_a = problem.a;
  w.linked_b = problem.b;
  w.first_a.assign(bodies + 1, 0);
  w.first_b.assign(bodies + 1, 0);
  w.b_force.resize(problem.b.size());
  for (std::size_t c = 0; c < problem.a.size(); ++c) {
    ++w.first_a[problem.a[c] + 1];
    ++w.first_b[problem.b[c] + 1];
  }
  for (std::size_t i = 0; i < bodies; ++i) {
    w.first_a[i + 1] += w.first_a[i];
    w.first_b[i + 1] += w.first_b[i];
  }
  for (std::size_t c = 0; c < problem.b.size(); ++c)
    w.b_force[w.first_b[problem.b[c]]++] = static_cast<std::uint32_t>(c * sizeof(Row));
  for (std::size_t i = bodies; i > 0; --i) w.first_b[i] = w.first_b[i - 1];
  w.first_b[0] = 0;
}

double sum_of_squares(const std::vector<double>& values) {
  double sum = 0.0;
  for (double value : values) sum += value * value;
  return sum;
}

/// Units in which neither impulses nor velocities are large: single precision has room below one, to 1e-38,
/// not above.
void choose_units(const ContactProblem& problem, const ContactSolution& guess, Linearisation& w) {
  double inverse_mass = 0.0;
  int moving = 0;
  for (double each : problem.inverse_mass) {
    inverse_mass += each;
    moving += each > 0.0 ? 1 : 0;
  }
  w.mobility_unit = moving > 0 ? inverse_mass / moving : 1.0;
  const double velocity = std::sqrt(sum_of_squares(problem.vx) + sum_of_squares(problem.vy) +
                                    sum_of_squares(problem.cn) + sum_of_squares(problem.ct));
  const double impulse = std::sqrt((sum_of_squares(guess.pn) + sum_of_squares(guess.pt)) /
                                   static_cast<double>(std::max<std::size_t>(1, guess.pn.size())));
  const double largest = std::max(impulse, velocity / w.mobility_unit / std::sqrt(std::max(1, moving)));
  w.impulse_unit = largest > 0.0 ? largest : 1.0;
  w.velocity_unit = w.impulse_unit * w.mobility_unit;
}

void load_bodies(const ContactProblem& problem, Linearisation& w) {
  const auto bodies = static_cast<std::size_t>(problem.body_count());
  const double unit = 1.0 / w.mobility_unit;
  w.mobility.resize(bodies);
  w.velocity.assign(bodies, {});
  w.exact_velocity.resize(bodies);
  for (std::size_t i = 0; i < bodies; ++i) {
    const auto mass = static_cast<float>(problem.inverse_mass[i] * unit);
    const double spin = problem.lever[i] * problem.lever[i] * problem.inverse_inertia[i];
    w.mobility[i] = {mass, static_cast<float>(-spin * unit), mass, 0.0F};
  }
}

ExactRow in_bed_axes(const ContactProblem& problem, std::size_t c, Impulse impulse) {
  const double nx = problem.nx[c];
  const double ny = problem.ny[c];
  return {impulse.normal * nx - impulse.tangential * ny, impulse.normal * ny + impulse.tangential * nx,
          impulse.tangential};
}

void load_contact(const ContactProblem& problem, std::size_t c, Linearisation& w) {
  ContactGroup& group = w.contacts[c / lanes];
  const int k = lane_of(c);
  const DelassusDiagonal diagonal = delassus_diagonal(problem, static_cast<Index>(c));
  // Between two bodies that cannot move nothing happens, whatever the impulse.
  w.wn[c] = diagonal.normal > 0.0 ? 1.0 / diagonal.normal : 0.0;
  w.wt[c] = diagonal.tangential > 0.0 ? 1.0 / diagonal.tangential : 0.0;
  group.nx[k] = static_cast<float>(problem.nx[c]);
  group.ny[k] = static_cast<float>(problem.ny[c]);
  group.mu[k] = static_cast<float>(problem.mu[c]);
  group.wn[k] = static_cast<float>(w.wn[c] * w.mobility_unit);
  group.wt[k] = static_cast<float>(tangential_step * w.wt[c] * w.mobility_unit);
  group.a[k] = static_cast<std::uint32_t>(problem.a[c]) * static_cast<std::uint32_t>(sizeof(Row));
  group.b[k] = static_cast<std::uint32_t>(problem.b[c]) * static_cast<std::uint32_t>(sizeof(Row));
  const Impulse impulse = admissible(w.pn[c], w.pt[c], problem.mu[c]);
  w.pn[c] = impulse.normal;
  w.pt[c] = impulse.tangential;
  w.exact_force[c] = in_bed_axes(problem, c, impulse);
}

/// y moves against P0, so that P0 + y stays.
void absorb(const ContactProblem& problem, std::size_t c, Linearisation& w) {
  const ContactGroup& group = w.contacts[c / lanes];
  ImpulseGroup& increment = w.increment[c / lanes];
  ImpulseGroup& ahead = w.ahead[c / lanes];
  const int k = lane_of(c);
  const Impulse impulse =
      admissible(w.pn[c] + w.impulse_unit * static_cast<double>(increment.n[k]),
                 w.pt[c] + w.impulse_unit * static_cast<double>(increment.t[k]), problem.mu[c]);
  w.pn[c] = impulse.normal;
  w.pt[c] = impulse.tangential;
  const float yn = ahead.n[k] -= increment.n[k];
  const float yt = ahead.t[k] -= increment.t[k];
  increment.n[k] = increment.t[k] = 0.0F;
  w.force[c / lanes].rows[c % lanes] = {yn * group.nx[k] - yt * group.ny[k], yt,
                                        yn * group.ny[k] + yt * group.nx[k], 0.0F};
  w.exact_force[c] = in_bed_axes(problem, c, impulse);
}

struct InverseUnits {
  double impulse, velocity;
};

/// Relative velocity, what is left until the contact slides, and its part of the residual.
void linearise(const ContactProblem& problem, std::size_t c, const InverseUnits& units, Linearisation& w,
               ResidualSums& sums) {
  const ExactRow& va = w.exact_velocity[problem.a[c]];
  const ExactRow& vb = w.exact_velocity[problem.b[c]];
  const double nx = problem.nx[c];
  const double ny = problem.ny[c];
  const double dvx = vb.x - va.x;
  const double dvy = vb.y - va.y;
  const double un = dvx * nx + dvy * ny + problem.cn[c];
  const double ut = dvy * nx - dvx * ny - (va.spin + vb.spin) + problem.ct[c];
  const double pn = w.pn[c];
  const double pt = w.pt[c];

  sums.add({pn, pt}, solve_contact(pn, pt, un, ut, w.wn[c], w.wt[c], problem.mu[c]));

  ContactGroup& group = w.contacts[c / lanes];
  const int k = lane_of(c);
  const double bound = problem.mu[c] * pn;
  group.un[k] = static_cast<float>(un * units.velocity);
  group.ut[k] = static_cast<float>(ut * units.velocity);
  group.pn[k] = static_cast<float>(pn * units.impulse);
  group.above[k] = static_cast<float>((bound - pt) * units.impulse);
  group.below[k] = static_cast<float>((bound + pt) * units.impulse);
}

/// The contacts of a block: [block_begin(block), block_begin(block + 1)).
std::size_t block_begin(const ContactProblem& problem, Index block) {
  return static_cast<std::size_t>(std::min(problem.contact_count(), block * contacts_per_block));
}

}  // namespace

void prepare(const ContactProblem& problem, const ContactSolution& guess, Linearisation& w) {
  const auto contacts = static_cast<std::size_t>(problem.contact_count());
  const std::size_t groups = (contacts + lanes - 1) / lanes;
  link(problem, w);
  choose_units(problem, guess, w);
  load_bodies(problem, w);
  w.contacts.resize(groups);
  if (groups > 0) w.contacts.back() = {};  // padding: no weight, no impulse, between body 0 and itself
  w.increment.resize(groups);
  w.ahead.resize(groups);
  w.force.resize(groups);
  w.exact_force.resize(contacts);
  w.pn = guess.pn;
  w.pt = guess.pt;
  w.wn.resize(contacts);
  w.wt.resize(contacts);
  w.sums.resize((groups + groups_per_block - 1) / groups_per_block);
}

void load_contacts(const ContactProblem& problem, Index first_block, Index last_block, Linearisation& w) {
  const std::size_t last = block_begin(problem, last_block);
  for (std::size_t c = block_begin(problem, first_block); c < last; ++c) load_contact(problem, c, w);
  const Index groups = std::min(static_cast<Index>(w.contacts.size()), last_block * groups_per_block);
  for (Index g = first_block * groups_per_block; g < groups; ++g) w.increment[g] = w.ahead[g] = {};
}

void absorb_increments(const ContactProblem& problem, Index first_block, Index last_block, Linearisation& w) {
  const std::size_t last = block_begin(problem, last_block);
  for (std::size_t c = block_begin(problem, first_block); c < last; ++c) absorb(problem, c, w);
}

void sum_exact_velocities(const ContactProblem& problem, Index first, Index last, Linearisation& w) {
  for (Index i = first; i < last; ++i) {
    ExactRow sum;
    for (Index k = w.first_b[i]; k < w.first_b[i + 1]; ++k) {
      const ExactRow& force = w.exact_force[w.b_force[k] / sizeof(Row)];
      sum.x += force.x;
      sum.y += force.y;
      sum.spin += force.spin;
    }
    for (Index c = w.first_a[i]; c < w.first_a[i + 1]; ++c) {
      const ExactRow& force = w.exact_force[c];
      sum.x -= force.x;
      sum.y -= force.y;
      sum.spin += force.spin;
    }
    const double lever = problem.lever[i];
    const double mobility = problem.inverse_mass[i];
    w.exact_velocity[i] = {problem.vx[i] + mobility * sum.x, problem.vy[i] + mobility * sum.y,
                           lever * (problem.omega[i] - problem.inverse_inertia[i] * lever * sum.spin)};
  }
}

void linearise_contacts(const ContactProblem& problem, Index first_block, Index last_block,
                        Linearisation& w) {
  const InverseUnits units{1.0 / w.impulse_unit, 1.0 / w.velocity_unit};
  for (Index block = first_block; block < last_block; ++block) {
    ResidualSums sums;
    const std::size_t last = block_begin(problem, block + 1);
    for (std::size_t c = block_begin(problem, block); c < last; ++c) linearise(problem, c, units, w, sums);
    w.sums[block] = sums;
  }
}

ExactResidual exact_residual(const Linearisation& w) {
  ResidualSums sum;
  for (const ResidualSums& block : w.sums) {
    sum.change += block.change;
    sum.impulse += block.impulse;
    sum.impulse_after += block.impulse_after;
    sum.largest = std::max(sum.largest, block.largest);
  }
  if (!(sum.scale() > 0.0)) return {};
  return {sum.residual(), std::sqrt(sum.scale()) / w.impulse_unit, !(sum.impulse > 0.0)};
}

void unload_solution(const ContactProblem& problem, const Linearisation& w, ContactSolution& solution) {
  const auto bodies = static_cast<std::size_t>(problem.body_count());
  solution.pn = w.pn;
  solution.pt = w.pt;
  for (auto* field : {&solution.vx, &solution.vy, &solution.omega}) field->resize(bodies);
  for (std::size_t i = 0; i < bodies; ++i) {
    const double lever = problem.lever[i];
    solution.vx[i] = w.exact_velocity[i].x;
    solution.vy[i] = w.exact_velocity[i].y;
    solution.omega[i] = lever > 0.0 ? w.exact_velocity[i].spin / lever : problem.omega[i];
  }
}

ContactArrays contact_arrays(Linearisation& w) {
  return {w.contacts.data(), w.increment.data(), w.ahead.data(), w.velocity.data(), w.force.data()};
}

BodyArrays body_arrays(Linearisation& w) {
  return {w.mobility.data(), w.force.data(),   w.first_a.data(),
          w.first_b.data(),  w.b_force.data(), w.velocity.data()};
}

}  // namespace talus
