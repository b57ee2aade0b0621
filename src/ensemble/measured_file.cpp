#include "ensemble/measured_file.h"

#include <cstdlib>
#include <fmt/core.h>

#include "core/text_stream.h"
#include "scenario/text.h"

namespace talus {
namespace {

/// Of what quantities mean: another number makes kept values invalid.
constexpr int measure_version = 1;

std::string key_line(const std::string& analysis_key) {
  return fmt::format("# values {} of analysis {}\n", measure_version, analysis_key);
}

constexpr const char* head_line = "threshold,quantity,value,at_most\n";

}  // namespace

std::string measured_text(const std::string& analysis_key, const std::vector<MeasuredValues>& thresholds) {
  std::string text = key_line(analysis_key) + head_line;
  for (std::size_t f = 0; f < thresholds.size(); ++f)
    for (std::size_t q = 0; q < quantity_count; ++q) {
      const auto& [value, at_most] = thresholds[f][q];
      text += fmt::format("{},{},{},{}\n", f, q, short_text(value), at_most ? "1" : "0");
    }
  return text;
}

std::optional<std::vector<MeasuredValues>> parse_measured(const std::string& text,
                                                          const std::string& analysis_key) {
  std::istringstream lines = text_stream(text);
  std::vector<MeasuredValues> thresholds;
  std::string line;
  std::getline(lines, line);
  std::getline(lines, line);
  for (std::size_t count = 0; std::getline(lines, line); ++count) {
    if (count % quantity_count == 0) thresholds.emplace_back();
    const std::size_t second = line.find(',', line.find(',') + 1);
    if (second == std::string::npos) return std::nullopt;
    thresholds.back()[count % quantity_count] = {std::strtod(line.c_str() + second + 1, nullptr),
                                                 line.ends_with(",1")};
  }
  if (thresholds.empty() || measured_text(analysis_key, thresholds) != text) return std::nullopt;
  return thresholds;
}

}  // namespace talus
