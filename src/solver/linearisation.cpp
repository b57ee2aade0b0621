#include "solver/linearisation.h"

#include <algorithm>
#include <cmath>

#include "solver/problem.h"

namespace talus::solver {
namespace {

// Under-relaxation of a contact. The modes that limit the momentum are tangential, grains that turn like
// gears, and sweeps leave the least noise with small tangential updates (docs/solver.md).
constexpr double normal_relaxation = 0.85;
constexpr double tangential_relaxation = 0.5;
// A contact without an impulse is swept if its bodies separate more slowly than the sum of their speeds and
// this, in velocity units.
constexpr double may_close = 0.2;
// If more than this share would be swept, all are, so that the order can stay the same from step to step.
constexpr double nearly_all = 0.85;

// Size of the data of a sweep up to which they stay in the caches: 120 000 contacts.
constexpr std::size_t cached_bytes = std::size_t{8} << 20;

constexpr auto row_bytes = static_cast<std::uint32_t>(sizeof(Row));

/// Position of a contact: its group, and its lane in the fields of that group.
struct Slot {
  std::size_t group, lane;
};
Slot slot_of(const Linearisation& w, std::size_t c) {
  const auto slot = static_cast<std::uint32_t>(w.order.slot[c]);  // division by eight is a shift
  return {slot / lane_count, slot % lane_count};
}

/// Makes the impulses of contacts first ... last - 1 admissible, and rotates them into the axes of the bed.
void admit_impulses(const ContactProblem& problem, std::size_t first, std::size_t last, Linearisation& w) {
  double *const pn = w.pn.data(), *const pt = w.pt.data();
  const double* const mu = problem.mu.data();
  for (std::size_t c = first; c < last; ++c) {
    const Impulse impulse = admissible(pn[c], pt[c], mu[c]);
    pn[c] = impulse.normal;
    pt[c] = impulse.tangential;
  }
  const double *const nx = problem.nx.data(), *const ny = problem.ny.data();
  ExactRow* const force = w.exact_force.data();
  for (std::size_t c = first; c < last; ++c)
    force[c] = {pn[c] * nx[c] - pt[c] * ny[c], pn[c] * ny[c] + pt[c] * nx[c], pt[c], 0.0};
}

/// Sets the rolling impulse of a contact, made admissible. Its normal impulse must be set before.
void set_rolling(const ContactProblem& problem, std::size_t c, double pr, Linearisation& w) {
  w.rolling.pr[c] = admissible_rolling(pr, problem.rolling_friction[c], w.pn[c]);
  w.exact_force[c].turn = w.rolling.length[c] * w.rolling.pr[c];
}

/// Computes the inverse diagonals of contacts first ... last - 1. The diagonals come first, so that the loop
/// of the inverses vectorises.
void load_diagonals(const ContactProblem& problem, std::size_t first, std::size_t last, Linearisation& w) {
  for (std::size_t c = first; c < last; ++c) {
    const DelassusDiagonal diagonal = delassus_diagonal(problem, c);
    w.wn[c] = diagonal.normal;
    w.wt[c] = diagonal.tangential;
  }
  // An impulse between two bodies that cannot move has no effect.
  for (double* const inverse : {w.wn.data(), w.wt.data()})
    for (std::size_t c = first; c < last; ++c) inverse[c] = inverse[c] > 0.0 ? 1.0 / inverse[c] : 0.0;
}

double speed(const ExactRow& velocity) { return std::fabs(velocity.x) + std::fabs(velocity.y); }

struct InverseUnits {
  double impulse, velocity, mobility;
};
InverseUnits inverse_units(const Linearisation& w) {
  return {1.0 / w.impulse_unit, 1.0 / w.velocity_unit, 1.0 / w.mobility_unit};
}

RollingUnits rolling_units(const Linearisation& w) {
  return {w.rolling.unit_length, 1.0 / w.impulse_unit, 1.0 / w.velocity_unit, w.mobility_unit};
}

/// Contacts of a block in single precision, before they are copied to their lanes. Computing them together
/// lets the compiler vectorise the loops.
struct BlockOfContacts {
  float nx[contacts_per_block], ny[contacts_per_block];
  float un[contacts_per_block], ut[contacts_per_block];
  float least[contacts_per_block], below[contacts_per_block], above[contacts_per_block];
};

/// Computes local frames, relative velocities at P0, and the increments at which contacts open or slide.
void linearise(const ContactProblem& problem, std::size_t first, std::size_t last, const Linearisation& w,
               BlockOfContacts& block) {
  const InverseUnits units = inverse_units(w);
  for (std::size_t k = 0; k < last - first; ++k) {
    block.nx[k] = static_cast<float>(problem.nx[first + k]);
    block.ny[k] = static_cast<float>(problem.ny[first + k]);
    block.un[k] = static_cast<float>(w.un[first + k] * units.velocity);
    block.ut[k] = static_cast<float>(w.ut[first + k] * units.velocity);
  }
  for (std::size_t k = 0; k < last - first; ++k) {
    const double pn = w.pn[first + k], pt = w.pt[first + k], bound = problem.mu[first + k] * pn;
    block.least[k] = static_cast<float>(-pn * units.impulse);
    block.below[k] = static_cast<float>((-bound - pt) * units.impulse);
    block.above[k] = static_cast<float>((bound - pt) * units.impulse);
  }
}

/// Loads the data of a contact that depend on contacts and bodies only.
void load_lane(const ContactProblem& problem, std::size_t c, double per_mobility, Linearisation& w) {
  const auto [g, k] = slot_of(w, c);
  ContactGroup& group = w.contacts[g];
  const Index a = problem.a[c], b = problem.b[c];
  group.wn[k] = static_cast<float>(normal_relaxation * w.wn[c] * w.mobility_unit);
  group.wt[k] = static_cast<float>(tangential_relaxation * w.wt[c] * w.mobility_unit);
  group.mass_a[k] = static_cast<float>(-problem.inverse_mass[a] * per_mobility);
  group.mass_b[k] = static_cast<float>(problem.inverse_mass[b] * per_mobility);
  if (!w.are_alike) {
    w.unlike[g].mu[k] = static_cast<float>(problem.mu[c]);
    w.unlike[g].spin_a[k] = static_cast<float>(-spin_mobility(problem, a) * per_mobility);
    w.unlike[g].spin_b[k] = static_cast<float>(-spin_mobility(problem, b) * per_mobility);
  }
  group.a[k] = static_cast<std::uint32_t>(w.order.row_a[c]) * row_bytes;
  group.b[k] = static_cast<std::uint32_t>(w.order.row_b[c]) * row_bytes;
}

/// Returns the first contact of a block.
std::size_t block_begin(const ContactProblem& problem, Index block) {
  return static_cast<std::size_t>(std::min(problem.contact_count(), block * contacts_per_block));
}

/// Calls `what` for each swept contact of blocks first_block ... last_block - 1.
template <typename Do>
void for_each_swept(const ContactProblem& problem, Index first_block, Index last_block,
                    const Linearisation& w, const Do& what) {
  const std::size_t last = block_begin(problem, last_block);
  for (std::size_t c = block_begin(problem, first_block); c < last; ++c)
    if (w.swept[c]) what(c);
}

/// Copies the swept contacts of a block to their lanes.
void spread(std::size_t first, std::size_t last, const BlockOfContacts& block, Linearisation& w) {
  ContactGroup* const groups = w.contacts.data();
  for (std::size_t k = 0; k < last - first; ++k) {
    if (!w.swept[first + k]) continue;
    const auto [g, lane] = slot_of(w, first + k);
    ContactGroup& group = groups[g];
    group.nx[lane] = block.nx[k];
    group.ny[lane] = block.ny[k];
    group.un[lane] = block.un[k];
    group.ut[lane] = block.ut[k];
    group.least[lane] = block.least[k];
    group.below[lane] = block.below[k];
    group.above[lane] = block.above[k];
  }
}

/// Sizes the groups for the order. Lanes with a contact are overwritten later.
void size_groups(Linearisation& w) {
  const std::size_t groups = w.order.group_count();
  const auto size = [groups](auto& field) {
    // The number of groups varies from step to step; the spare room avoids allocations in steady steps.
    if (field.capacity() < groups) field.reserve(groups + groups / 4);
    field.resize(groups);
  };
  size(w.contacts);
  size(w.increment);
  size(w.last_move);
  if (w.are_alike)
    w.unlike.clear();
  else
    size(w.unlike);
  if (!w.rolling.any()) return;
  size(w.rolling.groups);
  size(w.rolling.increment);
  size(w.rolling.last_move);
}

/// Clears a group of a part, and gives its lanes rows that do not move.
void clear_group(Index bodies, Index part, Index g, Linearisation& w) {
  w.contacts[g] = {};
  w.increment[g] = w.last_move[g] = {};
  if (!w.are_alike) w.unlike[g] = {};
  if (w.rolling.any()) {
    w.rolling.groups[g] = {};
    w.rolling.increment[g] = w.rolling.last_move[g] = {};
  }
  for (int k = 0; k < lane_count; ++k) {
    w.contacts[g].a[k] = static_cast<std::uint32_t>(SweepOrder::still_row(bodies, part, 0, k)) * row_bytes;
    w.contacts[g].b[k] = static_cast<std::uint32_t>(SweepOrder::still_row(bodies, part, 1, k)) * row_bytes;
  }
}

/// Clears the few groups that are not full.
void clear_groups(Index bodies, Linearisation& w) {
  constexpr Index full = lane_count * groups_abreast;
  for (Index part = 0; part < w.order.part_count(); ++part) {
    const Index first = w.order.part_begin[part], last = w.order.part_begin[part + 1];
    for (Index g = first; g < last; ++g)
      if (w.order.fill[w.order.first_place[part] + (g - first) / groups_abreast] < full)
        clear_group(bodies, part, g, w);
  }
}

}  // namespace

void load_contacts(const ContactProblem& problem, const ContactSolution& guess, Index first_block,
                   Index last_block, Linearisation& w) {
  const std::size_t first = block_begin(problem, first_block), last = block_begin(problem, last_block);
  if (w.are_new) load_diagonals(problem, first, last, w);
  std::copy(guess.pn.data() + first, guess.pn.data() + last, w.pn.data() + first);
  std::copy(guess.pt.data() + first, guess.pt.data() + last, w.pt.data() + first);
  admit_impulses(problem, first, last, w);
  if (!problem.resists_rolling()) return;
  for (std::size_t c = first; c < last; ++c) {
    if (w.are_new) load_rolling(problem, c, w.rolling);
    set_rolling(problem, c, guess.pr[c], w);
  }
}

void linearise_contacts(const ContactProblem& problem, const SweepKernels& kernels, Index first_block,
                        Index last_block, Linearisation& w) {
  ResidualArrays arrays{problem.a.data(),  problem.b.data(),  problem.nx.data(), problem.ny.data(),
                        problem.cn.data(), problem.ct.data(), problem.mu.data(), w.pn.data(),
                        w.pt.data(),       w.wn.data(),       w.wt.data(),       w.exact_velocity.data(),
                        w.un.data(),       w.ut.data()};
  if (problem.resists_rolling()) take_rolling(problem, w.rolling, arrays);
  const ResidualKernel kernel = problem.resists_rolling() ? kernels.rolling_residual : kernels.residual;
  for (Index block = first_block; block < last_block; ++block) {
    const std::size_t first = block_begin(problem, block), last = block_begin(problem, block + 1);
    ContactResidualSums sums;
    kernel(arrays, first, last, sums);
    Index pressed = 0;
    for (std::size_t c = first; c < last; ++c)
      pressed += static_cast<Index>(w.un[c] < 0.0) & static_cast<Index>(w.swept[c] == 0);
    w.sums[block] = {{sums.change, sums.impulse, sums.impulse_after, sums.largest}, pressed};
  }
}

void choose_swept(const ContactProblem& problem, Index first_block, Index last_block, Linearisation& w) {
  const std::size_t last = block_begin(problem, last_block);
  const double least = may_close * w.velocity_unit;
  for (std::size_t c = block_begin(problem, first_block); c < last; ++c) {
    const double change =
        least + speed(w.exact_velocity[problem.a[c]]) + speed(w.exact_velocity[problem.b[c]]);
    w.swept[c] = w.pn[c] > 0.0 || w.un[c] < change ? 1 : 0;
  }
}

void add_pressed(const ContactProblem& problem, Index first_block, Index last_block, Linearisation& w) {
  const std::size_t last = block_begin(problem, last_block);
  for (std::size_t c = block_begin(problem, first_block); c < last; ++c)
    if (w.un[c] < 0.0) w.swept[c] = 1;
}

void begin_order_of_contacts(const ContactProblem& problem, int size, Linearisation& w) {
  const auto chosen = std::count(w.swept.begin(), w.swept.end(), 1);
  if (static_cast<double>(chosen) > nearly_all * problem.contact_count()) std::ranges::fill(w.swept, 1);
  w.have_new_order = w.ordered_swept.empty() || w.ordered_swept != w.swept;
  if (!w.have_new_order) return;
  w.ordered_swept.clear();
  begin_order(problem, w.first_a, size, w.order);
}

void end_order_of_contacts(const ContactProblem& problem, Linearisation& w) {
  end_order(w.order);
  size_groups(w);
  clear_groups(problem.body_count(), w);
  for (auto* field : {&w.velocity, &w.before}) field->resize(w.order.row_count);
  w.ordered_swept = w.swept;
}

void load_groups(const ContactProblem& problem, Index first_block, Index last_block, Linearisation& w) {
  if (w.have_new_order) {
    place_slots(w.swept, block_begin(problem, first_block), block_begin(problem, last_block), w.order);
    const double per_mobility = inverse_units(w).mobility;
    for_each_swept(problem, first_block, last_block, w,
                   [&](std::size_t c) { load_lane(problem, c, per_mobility, w); });
  }
  for_each_swept(problem, first_block, last_block, w, [&](std::size_t c) {
    const auto [g, k] = slot_of(w, c);
    for (ImpulseGroup* impulse : {&w.increment[g], &w.last_move[g]}) impulse->n[k] = impulse->t[k] = 0.0F;
  });
  if (problem.resists_rolling()) {
    const RollingUnits scale = rolling_units(w);
    for_each_swept(problem, first_block, last_block, w, [&](std::size_t c) {
      if (w.have_new_order) load_rolling_group(problem, c, w.order.slot[c], scale, w.rolling);
      start_rolling(w.order.slot[c], w.rolling);
    });
  }
  linearise_groups(problem, first_block, last_block, w);
}

void clear_rows(Index first, Index last, Linearisation& w) {
  std::fill(w.velocity.begin() + first, w.velocity.begin() + last, Row{});
  std::fill(w.before.begin() + first, w.before.begin() + last, Row{});
}

void absorb_increments(const ContactProblem& problem, Index first_block, Index last_block, Linearisation& w) {
  const double unit = w.impulse_unit;
  for_each_swept(problem, first_block, last_block, w, [&](std::size_t c) {
    const auto [g, k] = slot_of(w, c);
    ImpulseGroup& increment = w.increment[g];
    w.pn[c] += unit * static_cast<double>(increment.n[k]);
    w.pt[c] += unit * static_cast<double>(increment.t[k]);
    increment.n[k] = increment.t[k] = 0.0F;
  });
  // Contacts that are not swept have no impulse, and this leaves them unchanged.
  admit_impulses(problem, block_begin(problem, first_block), block_begin(problem, last_block), w);
  if (!problem.resists_rolling()) return;
  for_each_swept(problem, first_block, last_block, w, [&](std::size_t c) {
    set_rolling(problem, c, take_rolling_increment(c, w.order.slot[c], unit, w.rolling), w);
  });
}

void average_impulses(const ContactProblem& problem, Index first_block, Index last_block,
                      const Linearisation& w, int count, ContactSolution& mean) {
  const double weight = 1.0 / count;
  const auto add = [&](const std::vector<double>& value, std::vector<double>& average) {
    const std::size_t last = block_begin(problem, last_block);
    for (std::size_t c = block_begin(problem, first_block); c < last; ++c)
      average[c] = count == 1 ? value[c] : average[c] + weight * (value[c] - average[c]);
  };
  add(w.pn, mean.pn);
  add(w.pt, mean.pt);
  if (problem.resists_rolling()) add(w.rolling.pr, mean.pr);
}

void absorb_velocities(Index first, Index last, Linearisation& w) {
  for (Index i = first; i < last; ++i) {
    Row& velocity = w.velocity[i];
    Row& before = w.before[i];
    before = {before.x - velocity.x, before.spin - velocity.spin, before.y - velocity.y,
              before.turn - velocity.turn};
    velocity = {};
  }
}

void linearise_groups(const ContactProblem& problem, Index first_block, Index last_block, Linearisation& w) {
  BlockOfContacts of_block;
  for (Index block = first_block; block < last_block; ++block) {
    const std::size_t first = block_begin(problem, block), last = block_begin(problem, block + 1);
    linearise(problem, first, last, w, of_block);
    spread(first, last, of_block, w);
  }
  if (!problem.resists_rolling()) return;
  const RollingUnits scale = rolling_units(w);
  for_each_swept(problem, first_block, last_block, w, [&](std::size_t c) {
    linearise_rolling(problem, c, w.order.slot[c], w.pn[c], scale, w.rolling);
  });
}

void sum_exact_velocities(const ContactProblem& problem, const SweepKernels& kernels, Index first, Index last,
                          Linearisation& w) {
  const BodySumArrays arrays{w.first_side.data(),         w.sides.data(),
                             w.exact_force.data(),        problem.vx.data(),
                             problem.vy.data(),           problem.omega.data(),
                             problem.inverse_mass.data(), problem.inverse_inertia.data(),
                             problem.lever.data(),        w.exact_velocity.data()};
  (problem.resists_rolling() ? kernels.rolling_body_sums : kernels.body_sums)(arrays, first, last);
}

ExactResidual exact_residual(const Linearisation& w) {
  ResidualSums sum;
  ExactResidual all;
  for (const auto& [block, pressed] : w.sums) {
    sum.change += block.change;
    sum.impulse += block.impulse;
    sum.impulse_after += block.impulse_after;
    sum.largest = std::max(sum.largest, block.largest);
    all.pressed += pressed;
  }
  if (sum.scale() == 0.0) return all;
  all.residual = sum.residual();
  all.norm = std::sqrt(sum.scale()) / w.impulse_unit;
  all.cold = !(sum.impulse > 0.0);
  return all;
}

void unload_impulses(const ContactProblem& problem, Index first_block, Index last_block,
                     const Linearisation& w, ContactSolution& solution) {
  const auto first = static_cast<std::ptrdiff_t>(block_begin(problem, first_block));
  const auto last = static_cast<std::ptrdiff_t>(block_begin(problem, last_block));
  std::copy(w.pn.begin() + first, w.pn.begin() + last, solution.pn.begin() + first);
  std::copy(w.pt.begin() + first, w.pt.begin() + last, solution.pt.begin() + first);
  if (problem.resists_rolling())
    std::copy(w.rolling.pr.begin() + first, w.rolling.pr.begin() + last, solution.pr.begin() + first);
}

void unload_velocities(const ContactProblem& problem, Index first, Index last, const Linearisation& w,
                       ContactSolution& solution) {
  for (Index i = first; i < last; ++i) {
    const double lever = problem.lever[i];
    solution.vx[i] = w.exact_velocity[i].x;
    solution.vy[i] = w.exact_velocity[i].y;
    solution.omega[i] = lever > 0.0 ? w.exact_velocity[i].spin / lever : problem.omega[i];
  }
}

ContactArrays contact_arrays(Linearisation& w) {
  const std::vector<double>& mu = w.linked.mu;
  ContactArrays arrays{w.contacts.data(), w.increment.data(), w.last_move.data(), w.velocity.data(),
                       mu.empty() ? 0.0F : static_cast<float>(mu.front())};
  if (!w.are_alike) arrays.unlike = w.unlike.data();
  arrays.reads_ahead = w.contacts.size() * (sizeof(ContactGroup) + 2 * sizeof(ImpulseGroup)) > cached_bytes;
  if (w.rolling.any()) {
    arrays.rolling = w.rolling.groups.data();
    arrays.rolling_increment = w.rolling.increment.data();
    arrays.rolling_move = w.rolling.last_move.data();
  }
  return arrays;
}

BodyArrays body_arrays(Linearisation& w) { return {w.velocity.data(), w.before.data()}; }

}  // namespace talus::solver
