#include "solver/sweep.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace talus {
namespace {

// From so many domains on, some 250 000 contacts, a wave pays: smaller beds stay in the last cache.
constexpr Index domains_for_wave = 64;
// A wave begins in a place for each member of a team. Between two of them it takes so many domains for each
// sweep.
constexpr Index domains_for_each = 4;

void wait_for_all(const Sweeper& sweeper) {
  if (sweeper.team) sweeper.team->wait_for_all();
}

void sweep_part(const Sweeper& sweeper, Index part, std::span<const float> beta, std::size_t sweep) {
  const SweepOrder& order = sweeper.at.order;
  const ContactKernel kernel =
      sweeper.at.rolling.are_there() ? sweeper.kernels.rolling_contacts : sweeper.kernels.contacts;
  kernel(contact_arrays(sweeper.at), order.part_begin[part], order.part_begin[part + 1], beta[sweep],
         sweeper.sums[sweep * static_cast<std::size_t>(order.part_count()) + static_cast<std::size_t>(part)]);
}

void extrapolate_domain(const Sweeper& sweeper, Index domain, float beta) {
  const std::vector<Index>& first_row = sweeper.at.order.first_row;
  sweeper.kernels.bodies(body_arrays(sweeper.at), first_row[domain], first_row[domain + 1], beta);
}

/// The part of a domain in a sweep, whose halves are the even domains and the odd ones. A domain needs what
/// its two neighbours did in the half before. Bodies of an even domain are extrapolated just before it is
/// swept; those of an odd one meet its neighbours first, so they are extrapolated for the next sweep as soon
/// as it has been swept.
void sweep_domain(const Sweeper& sweeper, Index place, Index half, std::span<const float> beta) {
  const Index domains = sweeper.at.order.domain_count(), domain = (place % domains + domains) % domains;
  const auto sweep = static_cast<std::size_t>(half / 2);
  if (half % 2 == 0) extrapolate_domain(sweeper, domain, beta[sweep]);
  sweep_part(sweeper, sweeper.at.order.part_of(domain), beta, sweep);
  if (half % 2 == 1 && sweep + 1 < beta.size()) extrapolate_domain(sweeper, domain, beta[sweep + 1]);
}

SweepSums sums_of(const Sweeper& sweeper, int sweep) {
  SweepSums sum;
  const Index parts = sweeper.at.order.part_count();
  for (Index k = sweep * parts; k < (sweep + 1) * parts; ++k) {
    sum.change += sweeper.sums[k].change;
    sum.ascent += sweeper.sums[k].ascent;
  }
  return sum;
}

}  // namespace

int sweeps_in_a_row(const SweepOrder& order) {
  return order.is_ring() && order.domain_count() >= domains_for_wave ? most_sweeps_in_a_row : 1;
}

bool fits_wave(const SweepOrder& order, int sweeps, int size) {
  return order.is_ring() && order.domain_count() >= domains_for_each * sweeps * size;
}

void sweep_by_phases(const Sweeper& sweeper, std::span<const float> beta) {
  const SweepOrder& order = sweeper.at.order;
  const int member = sweeper.member, size = sweeper.size;
  for (std::size_t sweep = 0; sweep < beta.size(); ++sweep) {
    sweeper.kernels.bodies(body_arrays(sweeper.at), part_begin(order.row_count, member, size),
                           part_begin(order.row_count, member + 1, size), beta[sweep]);
    wait_for_all(sweeper);
    for (int phase = 0; phase < SweepOrder::phases; ++phase) {
      const Index first = order.phase_begin[phase], parts = order.phase_begin[phase + 1] - first;
      if (order.part_begin[first] == order.part_begin[first + parts]) continue;
      for (Index k = part_begin(parts, member, size); k < part_begin(parts, member + 1, size); ++k)
        sweep_part(sweeper, first + k, beta, sweep);
      wait_for_all(sweeper);
    }
  }
}

void sweep_in_wave(const Sweeper& sweeper, std::span<const float> beta) {
  const Index pairs = sweeper.at.order.domain_count() / 2;
  const Index left = 2 * part_begin(pairs, sweeper.member, sweeper.size);
  const Index right = 2 * part_begin(pairs, sweeper.member + 1, sweeper.size);
  const Index halves = 2 * static_cast<Index>(beta.size());
  for (Index domain = left + 1; domain < right; domain += 2) extrapolate_domain(sweeper, domain, beta[0]);
  wait_for_all(sweeper);
  // A front has a domain in each half, front - half. Those in the halves up to (front - left) / 2 need none
  // of the domains of others.
  for (Index front = left; front < right; front += 2)
    for (Index half = 0; half < std::min(halves, (front - left) / 2 + 1); ++half)
      sweep_domain(sweeper, front - half, half, beta);
  wait_for_all(sweeper);
  // The others need what the members on both sides of the left end have done.
  for (Index front = left; front < left + 2 * (halves - 1); front += 2)
    for (Index half = (front - left) / 2 + 1; half < halves; ++half)
      sweep_domain(sweeper, front - half, half, beta);
  wait_for_all(sweeper);
}

double sweep(const Sweeper& sweeper, int count, Momentum& momentum) {
  std::array<float, most_sweeps_in_a_row> beta{};
  Momentum ahead = momentum;
  for (int k = 0; k < count; ++k) {
    beta[static_cast<std::size_t>(k)] = static_cast<float>(ahead.beta);
    ahead.grow();
  }
  const std::span<const float> sweeps(beta.data(), static_cast<std::size_t>(count));
  if (count > 1 && fits_wave(sweeper.at.order, count, sweeper.size))
    sweep_in_wave(sweeper, sweeps);
  else
    sweep_by_phases(sweeper, sweeps);
  double change = 0.0;
  for (int k = 0; k < count; ++k) {
    const SweepSums sums = sums_of(sweeper, k);
    change = std::sqrt(sums.change);
    momentum.update(change, sums.ascent);
  }
  return change;
}

}  // namespace talus
