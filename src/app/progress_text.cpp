#include "app/progress_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/core.h>

namespace talus {
namespace {

std::string joined_fields(const std::vector<ProgressField>& fields, int largest_rank) {
  std::string line;
  for (const ProgressField& field : fields)
    if (field.rank <= largest_rank) line.append(line.empty() ? "" : "  ").append(field.text);
  return line;
}

}  // namespace

std::string fitted_line(const std::vector<ProgressField>& fields, std::optional<int> width) {
  int rank = 0;
  for (const ProgressField& field : fields) rank = std::max(rank, field.rank);
  std::string line = joined_fields(fields, rank);
  if (!width) return line;
  const auto columns = static_cast<std::size_t>(std::max(0, *width));
  while (rank > 0 && line.size() > columns) line = joined_fields(fields, --rank);
  line.resize(std::min(line.size(), columns));
  return line;
}

std::string progress_bar(double share) {
  constexpr int cells = 14;
  const auto full = static_cast<std::size_t>(cells * std::clamp(share, 0.0, 1.0));
  return fmt::format("[{:#<{}}{:-<{}}]", "", full, "", cells - full);
}

std::vector<ProgressField> progress_fields(std::optional<double> share, double elapsed,
                                           std::optional<double> remaining, bool bar) {
  std::vector<ProgressField> fields;
  const bool known = share && *share >= 0.0 && *share <= 1.0;
  if (known && bar) fields.push_back({progress_bar(*share), 4});
  if (known) fields.push_back({fmt::format("{:.0f} %", std::floor(100.0 * *share)), 3});
  fields.push_back({"elapsed " + duration_text(elapsed), 2});
  if (known && remaining) fields.push_back({"ETA " + duration_text(*remaining), 1});
  return fields;
}

std::string count_progress_text(const std::string& label, std::size_t done, std::size_t count, double elapsed,
                                std::optional<int> width) {
  std::optional<double> share, remaining;
  if (count > 0) share = static_cast<double>(done) / static_cast<double>(count);
  if (done > 0 && done < count)
    remaining = elapsed / static_cast<double>(done) * static_cast<double>(count - done);
  std::vector<ProgressField> fields = progress_fields(share, elapsed, remaining, width.has_value());
  fields.insert(fields.begin(), {fmt::format("{} {}/{}", label, done, count), 0});
  return fitted_line(fields, width);
}

std::string run_progress_text(const RunShown& shown, std::optional<int> width) {
  std::vector<ProgressField> fields =
      progress_fields(shown.share, shown.seconds, shown.remaining, width.has_value());
  std::string phase;
  switch (shown.phase) {
    case Phase::deposition:
      phase = fmt::format("deposition {:.3f} s", shown.time);
      break;
    case Phase::tilt:
      phase = fmt::format("tilt {:.3f} deg", shown.tilt);
      break;
    case Phase::flow:
      phase = fmt::format("flow at {:.3f} deg", shown.tilt);
      break;
    case Phase::done:
      break;
  }
  fields.insert(fields.begin(), {phase, 0});
  if (shown.repose_assumed && shown.share && *shown.share <= 1.0)
    fields.push_back({fmt::format("if it fails at {:.0f} deg", *shown.repose_assumed), 6});
  fields.push_back({fmt::format("residual {:.1e}", shown.residual), 5});
  if (shown.phase == Phase::deposition)
    fields.push_back({fmt::format("contacts {}", shown.contacts), 7});
  else
    fields.push_back({fmt::format("E_kin {:.1e} J", shown.kinetic_energy), 8});
  fields.push_back({fmt::format("v = {:.2e} g h", shown.velocity), 7});
  return fitted_line(fields, width);
}

}  // namespace talus
