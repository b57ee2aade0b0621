#include "view/plots.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "analysis/packing/packing.h"
#include "core/trigonometry.h"

namespace talus::view {
namespace {

constexpr int gamma_bins = 50;

Plot& plot_of(std::vector<Plot>& plots, PlotKind kind) { return plots[static_cast<std::size_t>(kind)]; }

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

}  // namespace

PlotSeries series_of(const analysis::Quantity& quantity) {
  return {quantity.display.symbol, {}, {}, false, quantity};
}

double place_on(const PlotAbscissa& abscissa, double tilt, double time) {
  if (abscissa.axis == PlotAxis::time) return time;
  return degrees(abscissa.axis == PlotAxis::tilt ? tilt : abscissa.theta_c - std::abs(tilt));
}

std::string title_of(PlotAxis axis) {
  if (axis == PlotAxis::time) return analysis::axis_title("t", "s");
  return analysis::axis_title(axis == PlotAxis::tilt ? "θ" : "θ_c − θ", "deg");
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
  const auto of_quantity = [](const std::string& name, const analysis::QuantityMember& member) {
    return plot_along_run(name, analysis::shown_title(analysis::quantity_of(member)), {series_of(member)});
  };
  std::vector<Plot> plots = {
      // in the order of PlotKind
      plot_along_run("stress", "Packing",
                     {series_of(&analysis::FrameRecord::stress_ratio),
                      series_of(&analysis::FrameRecord::sigma_t_over_n), law("sin θ"), law("tan θ")}),
      of_quantity("overloaded", &analysis::FrameThreshold::overloaded_fraction),
      of_quantity("cluster", &analysis::FrameThreshold::largest_share),
      plot_along_run(
          "lengths", analysis::axis_title("ℓ_c", "D"),
          {series_of(&analysis::FrameThreshold::lc_mean), series_of(&analysis::FrameThreshold::lc_max)}),
      of_quantity("strain", &analysis::FrameRecord::volume_strain),
      plot_along_run("energy", "Energy E_k/mgD of a grain", {PlotSeries{"kinetic energy", {}, {}}}),
      {"gamma", "Density of γ, this frame", "γ = q/p", false, false, {PlotSeries{"pdf", {}, {}}}}};
  plot_of(plots, PlotKind::energy).log_y = true;
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
  std::vector<double> x, y;
  for (std::size_t k = 0; k < series.x.size(); ++k) {
    if (!(series.x[k] >= low && series.x[k] <= high) || !std::isfinite(series.y[k])) continue;
    x.push_back(series.x[k]);
    y.push_back(series.y[k]);
  }
  RangeStatistics statistics{talus::statistics_of(y)};
  const double x_mean = talus::statistics_of(x).mean;
  double xx = 0.0, xy = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += (x[k] - x_mean) * (x[k] - x_mean);
    xy += (x[k] - x_mean) * (y[k] - statistics.mean);
  }
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

std::vector<Plot> contact_plots(std::span<const HistoryInstant> instants, double weight,
                                const PlotAbscissa& abscissa) {
  PlotSeries normal{"f_n", {}, {}}, tangential{"f_t", {}, {}}, mobilisation{"|f_t|/μf_n", {}, {}},
      sliding{"slides", {}, {}, true};
  for (const HistoryInstant& at : instants) {
    const double x = place_on(abscissa, at.tilt, at.time);
    add(normal, x, at.fn / weight);
    add(tangential, x, at.ft / weight);
    add(mobilisation, x, mobilised(at.fn, at.ft, at.friction));
    add(sliding, x, 1.0);
  }
  std::vector<Plot> plots = {
      plot_along_run("contact forces", "f/mg", {std::move(normal), std::move(tangential)}),
      plot_along_run("mobilisation", "", {std::move(mobilisation), std::move(sliding)})};
  name_axis(abscissa.axis, plots);
  return plots;
}

}  // namespace talus::view
