#include "view/selection_table.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "analysis/histogram.h"
#include "analysis/quantities.h"
#include "core/trigonometry.h"

namespace talus::view {
namespace {

constexpr int histogram_bins = 24;

double value_of(std::span<const double> values, Index grain) {
  return values[static_cast<std::size_t>(grain)];
}

PlotSeries stairs_of(const std::string& name, std::span<const Index> grains, std::span<const double> values,
                     double low, double high) {
  analysis::Histogram histogram(low, high, histogram_bins);
  for (const Index grain : grains) histogram.add(value_of(values, grain));
  const std::vector<double> density = histogram.density();
  PlotSeries stairs;
  stairs.name = name;
  const auto add = [&stairs](double x, double y) {
    stairs.x.push_back(x);
    stairs.y.push_back(y);
  };
  add(low, 0.0);
  for (std::size_t bin = 0; bin < density.size(); ++bin) {
    add(histogram.edges[bin], density[bin]);
    add(histogram.edges[bin + 1], density[bin]);
  }
  add(high, 0.0);
  return stairs;
}

}  // namespace

std::vector<double> known_values(std::span<const Index> grains, std::span<const double> values) {
  std::vector<double> known;
  for (const Index grain : grains)
    if (const double value = value_of(values, grain); !std::isnan(value)) known.push_back(value);
  return known;
}

std::vector<Index> sorted_by(std::vector<Index> grains, std::span<const double> values, bool descending) {
  std::ranges::sort(grains, [&](Index one, Index other) {
    const double a = value_of(values, one), b = value_of(values, other);
    if (std::isnan(a) != std::isnan(b)) return std::isnan(b);
    if (a != b && !std::isnan(a)) return descending ? a > b : a < b;
    return one < other;
  });
  return grains;
}

Plot histogram_of(const analysis::GrainNumber& number, std::span<const Index> selected,
                  std::span<const Index> all, std::span<const double> values) {
  Plot plot;
  plot.name = fmt::format("histogram of {}", number.name);
  plot.title = "Density";
  plot.x_title = analysis::axis_title(number.name, analysis::scaled_unit(number.quantity->unit));
  std::ranges::replace(plot.x_title, '_', ' ');  // an underscore would set a subscript
  plot.along_run = false;
  const std::vector<double> known = known_values(all, values);
  if (known.empty()) return plot;
  const auto [least, largest] = std::ranges::minmax(known);
  const double room = largest > least ? 0.0 : least == 0.0 ? 0.5 : 0.5 * std::abs(least);
  const double low = least - room, high = largest + room;
  if (!std::isfinite(low) || !std::isfinite(high)) return plot;
  plot.series.push_back(stairs_of("selected", selected, values, low, high));
  plot.series.push_back(stairs_of("all", all, values, low, high));
  return plot;
}

std::string grains_table(
    const Frame& frame, std::span<const Index> grains, std::span<const analysis::GrainNumber> numbers,
    const std::function<const std::vector<double>&(const analysis::GrainNumber&)>& values_of) {
  std::string text = "time (s),tilt (deg)";
  for (const analysis::GrainNumber& number : numbers) text.append(1, ',').append(head_of(number));
  text += '\n';
  const std::string instant = fmt::format("{},{}", frame.time, degrees(frame.tilt));
  for (const Index grain : grains) {
    text += instant;
    for (const analysis::GrainNumber& number : numbers) {
      text += ',';
      analysis::append_number(text, value_of(values_of(number), grain), number.quantity->number, "");
    }
    text += '\n';
  }
  return text;
}

}  // namespace talus::view
