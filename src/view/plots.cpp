#include "view/plots.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "analysis/packing/packing.h"
#include "core/trigonometry.h"

namespace talus::view {
namespace {

constexpr std::size_t max_points = 2000;  // maximum for a curve over steps: about the number of pixels
constexpr int gamma_bins = 50;

Plot& plot_of(std::vector<Plot>& plots, PlotKind kind) { return plots[static_cast<std::size_t>(kind)]; }

PlotSeries curve(const std::string& name) { return {name, {}, {}, false, {}}; }
PlotSeries law(const std::string& name) { return {name, {}, {}, true, {}}; }
PlotSeries series_of(const analysis::QuantityMember& member) {
  return talus::view::series_of(analysis::quantity_of(member));
}

/// Returns the value, or NaN if it is not positive: zero cannot be drawn on a logarithmic axis.
double positive(double value) { return value > 0.0 ? value : not_known; }

void clear(PlotSeries& series) {
  series.x.clear();
  series.y.clear();
}

void add(PlotSeries& series, double x, double y) {
  series.x.push_back(x);
  series.y.push_back(y);
}

/// Returns the largest value of a field.
double largest_of(std::span<const StepRow> rows, StepField field) {
  double largest = 0.0;
  for (const StepRow& row : rows) largest = std::max(largest, at(row, field));
  return largest;
}

}  // namespace

PlotSeries series_of(const analysis::Quantity& quantity) {
  return {quantity.display.symbol, {}, {}, false, quantity};
}

double place_on(const PlotAbscissa& abscissa, double tilt, double time) {
  switch (abscissa.axis) {
    case PlotAxis::tilt:
      return degrees(tilt);
    case PlotAxis::angle_left:
      return degrees(abscissa.theta_c - std::abs(tilt));
    case PlotAxis::time:
      return time;
  }
  return not_known;
}

std::string title_of(PlotAxis axis) {
  switch (axis) {
    case PlotAxis::tilt:
      return analysis::axis_title("θ", "deg");
    case PlotAxis::angle_left:
      return analysis::axis_title("θ_c − θ", "deg");
    case PlotAxis::time:
      return analysis::axis_title("t", "s");
  }
  return {};
}

Plot plot_along_run(const std::string& name, const std::string& title, std::vector<PlotSeries> series) {
  return {name, title, title_of(PlotAxis::tilt), true, false, std::move(series)};
}

Plot plot_of_quantity(const analysis::Quantity& quantity) {
  analysis::Quantity titled = quantity;
  if (titled.display.title.empty()) titled.display = {.symbol = quantity.name, .title = quantity.name};
  Plot plot = plot_along_run(quantity.name, analysis::shown_title(titled), {series_of(titled)});
  plot.added = true;
  return plot;
}

std::vector<Plot> empty_plots() {
  std::vector<Plot> plots(plot_count);
  const auto set = [&plots](PlotKind kind, Plot plot) { plot_of(plots, kind) = std::move(plot); };
  const auto set_quantity = [&set](PlotKind kind, const std::string& name,
                                   const analysis::QuantityMember& member) {
    set(kind,
        plot_along_run(name, analysis::shown_title(analysis::quantity_of(member)), {series_of(member)}));
  };
  set(PlotKind::stress,
      plot_along_run("stress", "Packing",
                     {series_of(&analysis::FrameRecord::stress_ratio),
                      series_of(&analysis::FrameRecord::sigma_t_over_n), law("sin θ"), law("tan θ")}));
  set_quantity(PlotKind::overloaded, "overloaded", &analysis::FrameThreshold::overloaded_fraction);
  set_quantity(PlotKind::cluster, "cluster", &analysis::FrameThreshold::largest_share);
  set(PlotKind::lengths, plot_along_run("lengths", analysis::axis_title("ℓ_c", "D"),
                                        {series_of(&analysis::FrameThreshold::lc_mean),
                                         series_of(&analysis::FrameThreshold::lc_max)}));
  set_quantity(PlotKind::strain, "strain", &analysis::FrameRecord::volume_strain);
  set(PlotKind::energy, plot_along_run("energy", "Energy E_k/mgD of a grain", {curve("kinetic energy")}));
  plot_of(plots, PlotKind::energy).log_y = true;
  set(PlotKind::gamma, {"gamma", "Density of γ, this frame", "γ = q/p", false, false, {curve("pdf")}});
  set(PlotKind::residual, {"residual", "Solver residual η", "step", false, true, {curve("η")}});
  set(PlotKind::iterations, {"iterations", "Solver iterations", "step", false, false, {curve("iterations")}});
  return plots;
}

void name_axis(PlotAxis axis, std::vector<Plot>& plots) {
  for (Plot& plot : plots)
    if (plot.along_run) {
      plot.x_title = title_of(axis);
      plot.falling_x = axis == PlotAxis::angle_left;
    }
}

void plot_observables(std::span<const ObservableRow> rows, const RunStatics& statics,
                      const PlotAbscissa& abscissa, std::vector<Plot>& plots) {
  const auto place_of = [&abscissa](const ObservableRow& row) {
    return place_on(abscissa, at(row, Observable::tilt), at(row, Observable::time));
  };
  for (Plot& plot : plots)
    for (PlotSeries& series : plot.series) {
      if (!series.quantity || !series.quantity->display.observable) continue;
      clear(series);
      for (const ObservableRow& row : rows)
        add(series, place_of(row),
            analysis::shown(*series.quantity, at(row, *series.quantity->display.observable),
                            statics.mean_diameter));
    }
  PlotSeries& sine_law = plot_of(plots, PlotKind::stress).series[2];
  PlotSeries& tangent_law = plot_of(plots, PlotKind::stress).series[3];
  PlotSeries& energy = plot_of(plots, PlotKind::energy).series[0];
  for (PlotSeries* series : {&sine_law, &tangent_law, &energy}) clear(*series);
  double mass = 0.0;
  for (Index i = 0; i < statics.free_count; ++i) mass += statics.mass[i];
  const double energy_unit = mass * statics.gravity * statics.mean_diameter;
  for (const ObservableRow& row : rows) {
    const double theta = at(row, Observable::tilt), x = place_of(row);
    add(sine_law, x, std::abs(sine(theta)));
    add(tangent_law, x, sine(theta) / cosine(theta));
    add(energy, x, positive(at(row, Observable::kinetic_energy) / energy_unit));
  }
}

void plot_frames(std::span<const analysis::FrameRecord> frames, std::span<const double> times,
                 double mean_diameter, const PlotAbscissa& abscissa, std::vector<Plot>& plots, bool stored) {
  for (Plot& plot : plots)
    for (PlotSeries& series : plot.series) {
      if (!series.quantity || series.quantity->display.observable) continue;
      if (stored && analysis::needs_threshold(*series.quantity)) continue;
      clear(series);
      for (std::size_t k = 0; k < frames.size(); ++k)
        add(series, place_on(abscissa, frames[k].tilt, times[k]),
            analysis::shown(*series.quantity, analysis::number_of(*series.quantity, frames[k]),
                            mean_diameter));
    }
}

void note_threshold(double factor, std::optional<double> assumed, std::vector<Plot>& plots) {
  const std::string note = fmt::format("at {:.3g} Γ_c", factor) +
                           (assumed ? fmt::format(", if θ_c = {:.3g}°", degrees(*assumed)) : std::string());
  const auto has_one = [](const PlotSeries& series) {
    return series.quantity && analysis::needs_threshold(*series.quantity);
  };
  for (Plot& plot : plots)
    if (std::ranges::any_of(plot.series, has_one)) plot.note = note;
}

RangeStatistics statistics_of(const PlotSeries& series, double low, double high) {
  RangeStatistics statistics;
  double x_sum = 0.0, y_sum = 0.0;
  const auto counts = [&](std::size_t k) {
    return series.x[k] >= low && series.x[k] <= high && std::isfinite(series.y[k]);
  };
  for (std::size_t k = 0; k < series.x.size(); ++k) {
    if (!counts(k)) continue;
    ++statistics.count;
    x_sum += series.x[k];
    y_sum += series.y[k];
  }
  const auto count = static_cast<double>(statistics.count);
  statistics.mean = statistics.count > 0 ? y_sum / count : not_known;
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t k = 0; k < series.x.size(); ++k) {
    if (!counts(k)) continue;
    const double dx = series.x[k] - x_sum / count, dy = series.y[k] - statistics.mean;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
  }
  statistics.deviation = statistics.count > 1 ? std::sqrt(yy / (count - 1.0)) : not_known;
  statistics.slope = xx > 0.0 ? xy / xx : not_known;
  return statistics;
}

void plot_gamma(const BedFrame& bed, std::vector<Plot>& plots) {
  PlotSeries& series = plot_of(plots, PlotKind::gamma).series[0];
  clear(series);
  const analysis::Histogram histogram = analysis::stress_ratio_distribution(bed, gamma_bins);
  if (histogram.total == 0.0) return;
  const std::vector<double> density = histogram.density();
  for (std::size_t bin = 0; bin < density.size(); ++bin) add(series, histogram.centre(bin), density[bin]);
}

void plot_steps(std::span<const StepRow> steps, std::vector<Plot>& plots) {
  PlotSeries& residual = plot_of(plots, PlotKind::residual).series[0];
  PlotSeries& iterations = plot_of(plots, PlotKind::iterations).series[0];
  for (PlotSeries* series : {&residual, &iterations}) clear(*series);
  const std::size_t together = (steps.size() + max_points - 1) / max_points;
  for (std::size_t k = 0; k < steps.size(); k += together) {
    const auto rows = steps.subspan(k, std::min(together, steps.size() - k));
    const double x = at(rows.front(), StepField::step);
    add(residual, x, positive(largest_of(rows, StepField::residual)));
    add(iterations, x, largest_of(rows, StepField::iterations));
  }
}

}  // namespace talus::view
