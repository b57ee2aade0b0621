#include "analysis/histogram.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace talus::analysis {
std::vector<double> equal_edges(double from, double to, int bins) {
  std::vector<double> edges;
  for (int k = 0; k <= bins; ++k) edges.push_back(from + (to - from) * k / bins);
  return edges;
}

Histogram::Histogram(std::vector<double> ascending_edges)
    : edges(std::move(ascending_edges)), weight(edges.size() - 1, 0.0), squares(edges.size() - 1, 0.0) {}

Histogram::Histogram(double from, double to, int bins) : Histogram(equal_edges(from, to, bins)) {}

void Histogram::add(double value, double weight_of_value) {
  if (std::isnan(value)) return;
  total += weight_of_value;
  if (value < edges.front() || value > edges.back()) {
    outside += weight_of_value;
    return;
  }
  const auto above = std::upper_bound(edges.begin(), edges.end(), value) - edges.begin();
  const std::size_t bin = std::min(static_cast<std::size_t>(above), weight.size()) - 1;
  weight[bin] += weight_of_value;
  squares[bin] += weight_of_value * weight_of_value;
}

std::vector<double> Histogram::density() const {
  std::vector<double> result(weight.size(), 0.0);
  if (!(total > 0.0)) return result;
  for (std::size_t bin = 0; bin < weight.size(); ++bin) result[bin] = weight[bin] / (total * width(bin));
  return result;
}

std::vector<double> Histogram::error() const {
  std::vector<double> result(weight.size(), 0.0);
  if (!(total > 0.0)) return result;
  for (std::size_t bin = 0; bin < weight.size(); ++bin)
    result[bin] = std::sqrt(squares[bin]) / (total * width(bin));
  return result;
}

std::vector<double> logarithmic_edges(double from, double to, int bins) {
  std::vector<double> edges;
  for (int k = 0; k <= bins; ++k) edges.push_back(from * std::pow(to / from, static_cast<double>(k) / bins));
  edges.back() = to;
  return edges;
}

}  // namespace talus::analysis
