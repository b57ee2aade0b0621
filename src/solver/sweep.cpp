#include "solver/sweep.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace talus::solver {
namespace {

// Smallest number of domains (about 250 000 contacts) for a wave; smaller beds stay in the last-level cache.
constexpr Index domains_for_wave = 64;
// A wave starts at one place for each member of a team; between two places, each sweep needs this many
// domains.
constexpr Index domains_for_each = 4;

void wait_for_all(const Sweeper& sweeper) {
  if (sweeper.team) sweeper.team->wait_for_all();
}

/// Returns the index of the first sum of a sweep.
Index first_sum(const Sweeper& sweeper, Index sweep) {
  return (sweeper.turn * max_sweeps_in_a_row + sweep) * sweeper.at.order.part_count();
}

void sweep_part(const Sweeper& sweeper, Index part, std::span<const float> beta, std::size_t sweep) {
  const SweepOrder& order = sweeper.at.order;
  const ContactKernel kernel =
      sweeper.at.rolling.any() ? sweeper.kernels.rolling_contacts : sweeper.kernels.contacts;
  kernel(contact_arrays(sweeper.at), order.part_begin[part], order.part_begin[part + 1], beta[sweep],
         sweeper.sums[first_sum(sweeper, sweep) + part]);
}

void extrapolate(const Sweeper& sweeper, SweepOrder::Rows rows, float beta) {
  sweeper.kernels.bodies(body_arrays(sweeper.at), rows.first, rows.last, beta);
}

/// Prefetches rows that another member may have changed. Waiting for them one by one would take a tenth of a
/// sweep.
void fetch(const Sweeper& sweeper, SweepOrder::Rows rows) {
  constexpr Index rows_of_line = 64 / sizeof(Row);
  if (sweeper.team == nullptr || rows.first == rows.last) return;
  const Row* const velocity = sweeper.at.velocity.data();
  for (Index i = rows.first; i < rows.last; i += rows_of_line) __builtin_prefetch(velocity + i);
  __builtin_prefetch(velocity + rows.last - 1);  // a row need not begin where a line does
}

/// Sweeps an even domain and its contacts with bodies of the two neighbouring domains. No other part of the
/// phase uses these bodies, so this part extrapolates them, and no member waits for another in between.
void sweep_even_domain(const Sweeper& sweeper, Index domain, std::span<const float> beta, std::size_t sweep) {
  const SweepOrder& order = sweeper.at.order;
  const Index domains = order.domain_count();
  const auto before = order.rows_of_run((domain + domains - 1) % domains, SweepOrder::meets_after);
  const auto after = order.rows_of_run((domain + 1) % domains, SweepOrder::meets_before);
  fetch(sweeper, before);
  fetch(sweeper, after);
  extrapolate(sweeper, order.rows_of_domain(domain), beta[sweep]);
  extrapolate(sweeper, before, beta[sweep]);
  extrapolate(sweeper, after, beta[sweep]);
  sweep_part(sweeper, order.part_of(domain), beta, sweep);
}

void sweep_odd_domain(const Sweeper& sweeper, Index domain, std::span<const float> beta, std::size_t sweep) {
  const SweepOrder& order = sweeper.at.order;
  fetch(sweeper, order.rows_of_run(domain, SweepOrder::meets_before));
  fetch(sweeper, order.rows_of_run(domain, SweepOrder::meets_after));
  extrapolate(sweeper, order.rows_of_run(domain, SweepOrder::meets_none), beta[sweep]);
  sweep_part(sweeper, order.part_of(domain), beta, sweep);
}

/// Sweeps a domain in one half of a sweep; the halves are the even and the odd domains. A domain needs the
/// results of its two neighbours in the half before. Bodies of an even domain are extrapolated just before
/// it is swept. Bodies of an odd domain are used by its neighbours first, so they are extrapolated for the
/// next sweep as soon as the domain has been swept.
void sweep_domain(const Sweeper& sweeper, Index place, Index half, std::span<const float> beta) {
  const Index domains = sweeper.at.order.domain_count(), domain = (place % domains + domains) % domains;
  const auto sweep = static_cast<std::size_t>(half / 2);
  const SweepOrder::Rows rows = sweeper.at.order.rows_of_domain(domain);
  if (half % 2 == 0) extrapolate(sweeper, rows, beta[sweep]);
  sweep_part(sweeper, sweeper.at.order.part_of(domain), beta, sweep);
  if (half % 2 == 1 && sweep + 1 < beta.size()) extrapolate(sweeper, rows, beta[sweep + 1]);
}

SweepSums sums_of(const Sweeper& sweeper, int sweep) {
  SweepSums sum;
  for (Index k = first_sum(sweeper, sweep); k < first_sum(sweeper, sweep + 1); ++k) {
    sum.change += sweeper.sums[k].change;
    sum.ascent += sweeper.sums[k].ascent;
  }
  return sum;
}

}  // namespace

int sweeps_in_a_row(const SweepOrder& order) {
  return order.is_ring() && order.domain_count() >= domains_for_wave ? max_sweeps_in_a_row : 1;
}

bool fits_wave(const SweepOrder& order, int sweeps, int size) {
  return order.is_ring() && order.domain_count() >= domains_for_each * sweeps * size;
}

void sweep_by_phases(const Sweeper& sweeper, std::span<const float> beta) {
  const SweepOrder& order = sweeper.at.order;
  const int member = sweeper.member, size = sweeper.size;
  for (std::size_t sweep = 0; sweep < beta.size(); ++sweep) {
    const Index even = order.phase_begin[1], odd = order.phase_begin[2] - even, left = order.phase_begin[2];
    for (Index k = part_begin(even, member, size); k < part_begin(even, member + 1, size); ++k)
      sweep_even_domain(sweeper, 2 * k, beta, sweep);
    wait_for_all(sweeper);
    if (odd > 0) {
      for (Index k = part_begin(odd, member, size); k < part_begin(odd, member + 1, size); ++k)
        sweep_odd_domain(sweeper, 2 * k + 1, beta, sweep);
      wait_for_all(sweeper);
    }
    if (order.part_begin[left] < order.part_begin[left + 1]) {
      if (member == size - 1) sweep_part(sweeper, left, beta, sweep);
      wait_for_all(sweeper);
    }
  }
}

void sweep_in_wave(const Sweeper& sweeper, std::span<const float> beta) {
  const Index pairs = sweeper.at.order.domain_count() / 2;
  const Index left = 2 * part_begin(pairs, sweeper.member, sweeper.size);
  const Index right = 2 * part_begin(pairs, sweeper.member + 1, sweeper.size);
  const Index halves = 2 * static_cast<Index>(beta.size());
  for (Index domain = left + 1; domain < right; domain += 2)
    extrapolate(sweeper, sweeper.at.order.rows_of_domain(domain), beta[0]);
  wait_for_all(sweeper);
  // A front covers one domain in each half, front - half. Those in the halves up to (front - left) / 2 need
  // no domain of other members.
  for (Index front = left; front < right; front += 2)
    for (Index half = 0; half < std::min(halves, (front - left) / 2 + 1); ++half)
      sweep_domain(sweeper, front - half, half, beta);
  wait_for_all(sweeper);
  // The others need the results of the members on both sides of the left end.
  for (Index front = left; front < left + 2 * (halves - 1); front += 2)
    for (Index half = (front - left) / 2 + 1; half < halves; ++half)
      sweep_domain(sweeper, front - half, half, beta);
  wait_for_all(sweeper);
}

double sweep(Sweeper& sweeper, int count, Momentum& momentum) {
  std::array<float, max_sweeps_in_a_row> beta{};
  Momentum ahead = momentum;
  for (int k = 0; k < count; ++k) {
    beta[k] = static_cast<float>(ahead.beta);
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
  sweeper.turn = 1 - sweeper.turn;
  return change;
}

}  // namespace talus::solver
