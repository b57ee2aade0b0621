#include "analysis/cells.h"

#include <algorithm>
#include <cmath>

namespace talus::analysis {
namespace {

/// Returns the grid around the points, still empty.
Cells make_grid(const std::vector<double>& x, const std::vector<double>& y, double size, double period) {
  const auto [lowest, highest] = std::minmax_element(y.begin(), y.end());
  const auto [leftmost, rightmost] = std::minmax_element(x.begin(), x.end());
  Cells cells;
  cells.period = period;
  cells.x_min = period > 0.0 ? 0.0 : *leftmost;
  cells.y_min = *lowest;
  const double length = period > 0.0 ? period : *rightmost - *leftmost;
  // Limits the memory if a grain is far away from all others.
  const double most = 4.0 * static_cast<double>(x.size());
  while ((length / size) * ((*highest - *lowest) / size) > most) size *= 2.0;
  cells.size = cells.width = size;
  cells.rows = static_cast<Index>((*highest - *lowest) / size) + 1;
  if (period > 0.0) {
    cells.columns = std::max<Index>(1, static_cast<Index>(length / size));
    cells.width = period / cells.columns;
  } else {
    cells.columns = static_cast<Index>(length / size) + 1;
  }
  return cells;
}

}  // namespace

Index column_of(const Cells& cells, double x) {
  const auto column = static_cast<Index>(std::floor((x - cells.x_min) / cells.width));
  if (cells.period > 0.0) return ((column % cells.columns) + cells.columns) % cells.columns;
  return std::clamp<Index>(column, 0, cells.columns - 1);
}

Index row_of(const Cells& cells, double y) {
  return std::clamp<Index>(static_cast<Index>(std::floor((y - cells.y_min) / cells.size)), 0, cells.rows - 1);
}

Cells sort_into_cells(const std::vector<double>& x, const std::vector<double>& y, double size,
                      double period) {
  if (x.empty()) return {};
  Cells cells = make_grid(x, y, size, period);
  std::vector<Index> cell(x.size());
  cells.start.assign(static_cast<std::size_t>(cells.columns) * static_cast<std::size_t>(cells.rows) + 1, 0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    cell[i] = row_of(cells, y[i]) * cells.columns + column_of(cells, x[i]);
    ++cells.start[cell[i] + 1];
  }
  for (std::size_t k = 1; k < cells.start.size(); ++k) cells.start[k] += cells.start[k - 1];
  cells.point.resize(x.size());
  std::vector<Index> next(cells.start.begin(), cells.start.end() - 1);
  for (std::size_t i = 0; i < x.size(); ++i) cells.point[next[cell[i]]++] = static_cast<Index>(i);
  return cells;
}

}  // namespace talus::analysis
