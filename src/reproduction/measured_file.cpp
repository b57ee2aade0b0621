#include "reproduction/measured_file.h"

#include <cstdlib>

#include "core/text_stream.h"
#include "session/scenario_text.h"

namespace talus {
namespace {

/// Of what quantities mean: another number makes kept values invalid.
constexpr int measure_version = 1;

std::string first_line(const std::string& analysis_key) {
  return "# values " + std::to_string(measure_version) + " of analysis " + analysis_key + "\n";
}

constexpr const char* head = "threshold,quantity,value,at_most\n";

}  // namespace

std::string measured_text(const std::string& analysis_key, const std::vector<MeasuredValues>& thresholds) {
  std::string text = first_line(analysis_key) + head;
  for (std::size_t f = 0; f < thresholds.size(); ++f)
    for (std::size_t q = 0; q < quantity_count; ++q) {
      const auto& [value, at_most] = thresholds[f][q];
      text += std::to_string(f) + "," + std::to_string(q) + "," + short_text(value) + "," +
              (at_most ? "1" : "0") + "\n";
    }
  return text;
}

std::optional<std::vector<MeasuredValues>> parse_measured(const std::string& text,
                                                          const std::string& analysis_key) {
  const std::string begin = first_line(analysis_key) + head;
  if (!text.starts_with(begin)) return std::nullopt;
  std::istringstream lines = text_stream(text.substr(begin.size()));
  std::vector<MeasuredValues> thresholds;
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    std::istringstream fields = text_stream(line);
    std::string threshold, quantity, value, at_most;
    std::getline(fields, threshold, ',');
    std::getline(fields, quantity, ',');
    std::getline(fields, value, ',');
    std::getline(fields, at_most);
    const std::size_t f = count / quantity_count, q = count % quantity_count;
    if (threshold != std::to_string(f) || quantity != std::to_string(q)) return std::nullopt;
    if (q == 0) thresholds.emplace_back();
    char* end = nullptr;
    thresholds.back()[q] = {std::strtod(value.c_str(), &end), at_most == "1"};
    if (value.empty() || *end != '\0') return std::nullopt;
  }
  if (count == 0 || count % quantity_count != 0) return std::nullopt;
  return thresholds;
}

}  // namespace talus
