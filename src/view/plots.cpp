#include "view/plots.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/packing.h"
#include "core/trigonometry.h"

namespace talus {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t most_points = 2000;  // of a curve over steps: about as many as pixels
constexpr int gamma_bins = 50;

Plot& plot_of(std::vector<Plot>& plots, PlotKind kind) { return plots[static_cast<std::size_t>(kind)]; }

PlotSeries law(const std::string& name) { return {name, {}, {}, true}; }

/// A logarithmic axis has no place for zero.
double positive(double value) { return value > 0.0 ? value : nan; }

void clear(Plot& plot) {
  for (PlotSeries& series : plot.series) {
    series.x.clear();
    series.y.clear();
  }
}

void add(Plot& plot, std::size_t series, double x, double y) {
  plot.series[series].x.push_back(x);
  plot.series[series].y.push_back(y);
}

/// The largest value of a field.
double largest_of(std::span<const StepRow> rows, StepField field) {
  double largest = 0.0;
  for (const StepRow& row : rows) largest = std::max(largest, at(row, field));
  return largest;
}

}  // namespace

std::vector<Plot> empty_plots() {
  const std::string tilt = "θ in °";
  std::vector<Plot> plots(plot_count);
  const auto set = [&plots](PlotKind kind, Plot plot) { plot_of(plots, kind) = std::move(plot); };
  const auto one = [](const std::string& name) { return PlotSeries{name, {}, {}, false}; };
  set(PlotKind::stress,
      {"stress", "Packing", tilt, true, false, {one("Γ = Q/P"), one("σ_T/σ_N"), law("sin θ"), law("tan θ")}});
  set(PlotKind::overloaded, {"overloaded", "Overloaded grains, share p_o", tilt, true, false, {one("p_o")}});
  set(PlotKind::cluster,
      {"cluster", "Largest cluster, share of p_o", tilt, true, false, {one("largest cluster")}});
  set(PlotKind::lengths, {"lengths", "ℓ_c in D", tilt, true, false, {one("mean"), one("largest")}});
  set(PlotKind::strain, {"strain", "Volume strain ΔV/V in %", tilt, true, false, {one("ΔV/V")}});
  set(PlotKind::energy, {"energy", "Energy E_k/mgD of a grain", tilt, true, true, {one("kinetic energy")}});
  set(PlotKind::gamma, {"gamma", "Density of γ, this frame", "γ = q/p", false, false, {one("pdf")}});
  set(PlotKind::residual, {"residual", "Solver residual η", "step", false, true, {one("η")}});
  set(PlotKind::passes, {"passes", "Solver passes", "step", false, false, {one("passes")}});
  return plots;
}

void plot_observables(std::span<const ObservableRow> rows, const RunStatics& statics,
                      std::vector<Plot>& plots) {
  Plot& stress = plot_of(plots, PlotKind::stress);
  Plot& strain = plot_of(plots, PlotKind::strain);
  Plot& energy = plot_of(plots, PlotKind::energy);
  for (Plot* plot : {&stress, &strain, &energy}) clear(*plot);
  double mass = 0.0;
  for (Index i = 0; i < statics.free_count; ++i) mass += statics.mass[i];
  const double energy_unit = mass * statics.gravity * statics.mean_diameter;
  for (const ObservableRow& row : rows) {
    const double theta = at(row, Observable::tilt), x = degrees(theta);
    add(stress, 0, x, at(row, Observable::stress_ratio));
    add(stress, 1, x, at(row, Observable::sigma_t_over_n));
    add(stress, 2, x, sine(theta));
    add(stress, 3, x, sine(theta) / cosine(theta));
    add(strain, 0, x, 100.0 * at(row, Observable::volume_strain));
    add(energy, 0, x, positive(at(row, Observable::kinetic_energy) / energy_unit));
  }
}

void plot_frames(std::span<const FrameValues> frames, std::vector<Plot>& plots) {
  Plot& overloaded = plot_of(plots, PlotKind::overloaded);
  Plot& cluster = plot_of(plots, PlotKind::cluster);
  Plot& lengths = plot_of(plots, PlotKind::lengths);
  for (Plot* plot : {&overloaded, &cluster, &lengths}) clear(*plot);
  for (const FrameValues& frame : frames) {
    const double x = degrees(frame.tilt);
    add(overloaded, 0, x, frame.overloaded);
    add(cluster, 0, x, frame.largest_share);
    add(lengths, 0, x, frame.mean_length);
    add(lengths, 1, x, frame.largest_length);
  }
}

void plot_gamma(const Frame& frame, const RunStatics& statics, std::vector<Plot>& plots) {
  Plot& plot = plot_of(plots, PlotKind::gamma);
  clear(plot);
  const Histogram histogram = stress_ratio_distribution(frame, statics, gamma_bins);
  if (histogram.total == 0.0) return;
  const std::vector<double> density = histogram.density();
  for (std::size_t bin = 0; bin < density.size(); ++bin) add(plot, 0, histogram.centre(bin), density[bin]);
}

void plot_steps(std::span<const StepRow> steps, std::vector<Plot>& plots) {
  Plot& residual = plot_of(plots, PlotKind::residual);
  Plot& passes = plot_of(plots, PlotKind::passes);
  for (Plot* plot : {&residual, &passes}) clear(*plot);
  const std::size_t together = (steps.size() + most_points - 1) / most_points;
  for (std::size_t k = 0; k < steps.size(); k += together) {
    const auto rows = steps.subspan(k, std::min(together, steps.size() - k));
    const double x = at(rows.front(), StepField::step);
    add(residual, 0, x, positive(largest_of(rows, StepField::residual)));
    add(passes, 0, x, largest_of(rows, StepField::iterations));
  }
}

}  // namespace talus
