#include "session/estimate.h"

#include <algorithm>
#include <cmath>

#include "session/deposition.h"

namespace talus {
namespace {

// Measured on one core (x86-64, AVX2) with beds of L = 50 D, H = 20 D and L = 200 D, H = 40 D, tilted to
// failure; see docs/scenario.md.
constexpr double seconds_per_contact_and_pass = 3.4e-9;
constexpr double seconds_per_contact_and_sweep = 15e-9;  // Gauss-Seidel
constexpr double contacts_per_grain = 1.9;               // near contacts included
constexpr double passes_of_deposition = 150.0;
constexpr double passes_of_tilt = 60.0;
constexpr double passes_of_tilt_of_collapsed = 105.0;
constexpr double falls_until_rest = 5.0;     // times sqrt(H / g)
constexpr double gauss_seidel_passes = 5.0;  // times those of the accelerated solver

constexpr double bytes_of_process = 2e7;
constexpr double memory_per_grain = 2500.0;
constexpr double memory_of_packing = 3.5;  // times the size of the file

constexpr double bytes_of_file = 2e5;
constexpr double checkpoint_bytes_per_grain = 190.0;
constexpr double frame_bytes_per_grain = 75.0;
constexpr double bytes_per_row = 80.0;
constexpr double bytes_per_step = 12.0;

constexpr double gravity = 9.81;  // m/s^2

/// How many more passes than at the default tolerance a smaller residual or the slower solver takes.
double difficulty(const Scenario& scenario) {
  const double digits = std::log10(scenario.solver.tolerance) / std::log10(Scenario{}.solver.tolerance);
  return digits * (scenario.solver.method == SolverMethod::accelerated ? 1.0 : gauss_seidel_passes);
}

double estimated_seconds(const Scenario& scenario, const Estimate& sizes) {
  const double factor = difficulty(scenario);
  const double most = scenario.solver.max_iterations;
  const double tilt =
      scenario.deposition.method == DepositionMethod::collapse ? passes_of_tilt_of_collapsed : passes_of_tilt;
  const double passes =
      std::min(passes_of_deposition * factor, most) * static_cast<double>(sizes.deposition_steps) +
      std::min(tilt * factor, most) * static_cast<double>(sizes.tilt_steps);
  const bool accelerated = scenario.solver.method == SolverMethod::accelerated;
  return (accelerated ? seconds_per_contact_and_pass : seconds_per_contact_and_sweep) * sizes.contacts *
         passes;
}

double estimated_file(const Estimate& sizes) {
  const double grains = sizes.grains + sizes.floor_grains;
  return bytes_of_file +
         grains * (checkpoint_bytes_per_grain + frame_bytes_per_grain * static_cast<double>(sizes.frames)) +
         bytes_per_row * static_cast<double>(sizes.observable_rows) +
         bytes_per_step * static_cast<double>(sizes.deposition_steps + sizes.tilt_steps);
}

}  // namespace

Estimate estimate(const Scenario& scenario) {
  Estimate result;
  result.grains = grain_count(scenario);
  if (scenario.bed.floor == BedFloor::rough) result.floor_grains = static_cast<Index>(scenario.bed.length);
  result.contacts = static_cast<Index>(std::lround(contacts_per_grain * result.grains));
  result.time_step = time_step(scenario);

  const double depth = scenario.bed.depth * scenario.grains.mean_diameter;
  const double rest = std::min(falls_until_rest * std::sqrt(depth / gravity), scenario.deposition.max_time);
  result.deposition_steps = std::llround((end_of_arrivals(scenario) + rest) / result.time_step);
  const double end = scenario.tilt.end_angle.value_or(assumed_repose);
  result.tilt_steps = std::llround(end / scenario.tilt.step);
  result.frames = 1 + static_cast<std::int64_t>(end / scenario.output.frame_every);
  result.observable_rows = 1 + static_cast<std::int64_t>(end / scenario.output.observable_every);

  result.seconds = estimated_seconds(scenario, result);
  result.disk = estimated_file(result);
  result.memory = bytes_of_process + memory_per_grain * (result.grains + result.floor_grains) +
                  memory_of_packing * result.disk;
  return result;
}

}  // namespace talus
