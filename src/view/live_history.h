#pragma once
/// Data that a live run keeps in memory, in addition to those in its file.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/command.h"
#include "core/observables.h"
#include "core/snapshot.h"

namespace talus::view {

/// Data recorded since the beginning of the run.
struct LiveHistory {
  std::vector<ObservableRow> observables;
  std::vector<std::shared_ptr<const Frame>> frames;
  std::vector<Command> commands;
  std::vector<StepRow> steps;
  std::int64_t stride = 1;  ///< interval between the rows, in steps
};

/// Maximum number of rows of steps kept.
inline constexpr std::size_t max_live_steps = 4000;

/// Adds rows of steps. When there are too many, every second row is dropped, and the stride of later rows
/// doubles.
inline void add_steps(std::span<const StepRow> rows, LiveHistory& history) {
  const auto is_left_out = [&history](const StepRow& row) {
    return static_cast<std::int64_t>(at(row, StepField::step)) % history.stride != 0;
  };
  for (const StepRow& row : rows) {
    if (is_left_out(row)) continue;
    history.steps.push_back(row);
    if (history.steps.size() <= max_live_steps) continue;
    history.stride *= 2;
    std::erase_if(history.steps, is_left_out);
  }
}

/// Returns the items from index `from` on; empty if there are fewer.
template <typename T>
std::vector<T> since(const std::vector<T>& items, std::size_t from) {
  return {items.begin() + static_cast<std::ptrdiff_t>(std::min(from, items.size())), items.end()};
}

}  // namespace talus::view
