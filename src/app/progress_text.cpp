#include "app/progress_text.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace talus {
namespace {

template <typename... Values>
std::string formatted(const char* pattern, Values... values) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

std::string joined(const std::vector<ProgressField>& fields, int largest_rank) {
  std::string line;
  for (const ProgressField& field : fields)
    if (field.rank <= largest_rank) line.append(line.empty() ? "" : "  ").append(field.text);
  return line;
}

/// How far the tilt is; nothing beyond where a slope was expected to fail.
void add_share(std::vector<ProgressField>& fields, const RunShown& shown, bool bar) {
  if (shown.tilt > shown.tilt_end) return;
  const double share = shown.tilt_end > 0.0 ? std::clamp(shown.tilt / shown.tilt_end, 0.0, 1.0) : 0.0;
  if (bar) fields.push_back({progress_bar(share), 4});
  fields.push_back({formatted("%.0f %%", std::floor(100.0 * share)), 3});
  if (shown.remaining) fields.push_back({formatted("ETA %s", duration_text(*shown.remaining).c_str()), 1});
  if (shown.end_expected) fields.push_back({formatted("if it fails at %.0f deg", shown.tilt_end), 6});
}

}  // namespace

std::string duration_text(double seconds) {
  const long whole = std::lround(seconds);
  if (whole >= 3600) return formatted("%ld h %02ld min", whole / 3600, whole / 60 % 60);
  if (whole >= 60) return formatted("%ld min %02ld s", whole / 60, whole % 60);
  return formatted("%ld s", whole);
}

std::string fitted_line(const std::vector<ProgressField>& fields, std::optional<int> width) {
  int rank = 0;
  for (const ProgressField& field : fields) rank = std::max(rank, field.rank);
  std::string line = joined(fields, rank);
  if (!width) return line;
  const auto columns = static_cast<std::size_t>(std::max(0, *width));
  while (rank > 0 && line.size() > columns) line = joined(fields, --rank);
  line.resize(std::min(line.size(), columns));
  return line;
}

std::string progress_bar(double share) {
  constexpr int cells = 20;
  const auto full = static_cast<std::size_t>(cells * std::clamp(share, 0.0, 1.0));
  return formatted("[%s%s]", std::string(full, '#').c_str(), std::string(cells - full, '-').c_str());
}

std::string run_progress_text(const RunShown& shown, std::optional<int> width) {
  std::vector<ProgressField> fields;
  switch (shown.stage) {
    case RunShown::Stage::deposition:
      fields.push_back({formatted("deposition  t = %.3f s", shown.time), 0});
      break;
    case RunShown::Stage::tilt:
      fields.push_back({formatted("tilt %.3f deg", shown.tilt), 0});
      add_share(fields, shown, width.has_value());
      break;
    case RunShown::Stage::flow:
      fields.push_back({formatted("flow at %.3f deg", shown.tilt), 0});
      break;
  }
  fields.push_back({formatted("(%s)", duration_text(shown.seconds).c_str()), 2});
  fields.push_back({formatted("residual %.1e", shown.residual), 5});
  if (shown.stage == RunShown::Stage::deposition)
    fields.push_back({formatted("contacts %d", shown.contacts), 7});
  else
    fields.push_back({formatted("E_kin %.1e J", shown.kinetic_energy), 8});
  fields.push_back({formatted("v = %.2e g h", shown.velocity), 7});
  return fitted_line(fields, width);
}

int terminal_columns() {
  constexpr int usual = 80;
  winsize size{};
  const bool told = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return (told ? size.ws_col : usual) - 1;  // the last column is left free: some terminals wrap there
}

}  // namespace talus
