#include "app/study_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "app/json.h"
#include "session/scenario_text.h"

namespace talus {
namespace {

using Table = std::vector<std::vector<std::string>>;

std::vector<StudyQuantity> quantities_of(StudyGroup group) {
  std::vector<StudyQuantity> quantities;
  for (std::size_t k = 0; k < study_quantity_count; ++k)
    if (study_fields[k].group == group) quantities.push_back(static_cast<StudyQuantity>(k));
  return quantities;
}

const StudyField& field_of(StudyQuantity quantity) {
  return study_fields[static_cast<std::size_t>(quantity)];
}

bool is_known(const StudyResult& result, StudyQuantity quantity) {
  return std::ranges::any_of(result.outcomes, [&](const StudyOutcome& outcome) {
    return !std::isnan(at(outcome.figures, quantity));
  });
}

std::string fixed(double value, int decimals, bool sign) {
  char text[64];
  std::snprintf(text, sizeof text, sign ? "%+.*f" : "%.*f", decimals, value);
  return text;
}

/// "16.43 ± 0.21": the error with two digits, the mean with as many decimals. A count says where seeds are
/// missing.
std::string mean_text(const MeanError& value, double factor, std::size_t seeds, bool sign = false) {
  if (value.count == 0) return "-";
  const double error = value.error * factor;
  std::string text;
  if (error > 0.0) {
    const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 12);
    text = fixed(value.mean * factor, decimals, sign) + " ± " + fixed(error, decimals, false);
  } else {
    char digits[64];
    std::snprintf(digits, sizeof digits, sign ? "%+.4g" : "%.4g", value.mean * factor);
    text = digits + std::string(value.count > 1 ? " ± 0" : "");
  }
  const auto count = static_cast<std::size_t>(value.count);
  return count == seeds ? text : text + " (" + std::to_string(count) + " seeds)";
}

std::string difference_text(const MeanError& difference, double factor, std::size_t seeds) {
  std::string text = mean_text(difference, factor, seeds, true);
  const Verdict found = verdict(difference);
  if (found == Verdict::within_error) text += ", within error";
  return found == Verdict::differs ? "**differs by " + text + "**" : text;
}

std::string solver_text(const StudyResult& result, std::size_t variation, StudyQuantity quantity) {
  const std::vector<double> values = values_of(result, variation, quantity);
  const bool worst =
      quantity == StudyQuantity::residual_max_rest || quantity == StudyQuantity::residual_max_moving;
  double value = mean_error(values).mean;
  if (std::isnan(value)) return "-";
  if (worst)
    for (const double one : values) value = std::fmax(value, one);
  char text[32];
  std::snprintf(text, sizeof text, worst ? "%.1e" : "%.3g", value * field_of(quantity).factor);
  return text;
}

std::string cell(const StudyResult& result, std::size_t variation, StudyQuantity quantity) {
  if (field_of(quantity).group == StudyGroup::solver) return solver_text(result, variation, quantity);
  const Comparison found = compare(result, variation, quantity);
  return mean_text(found.value, field_of(quantity).factor, result.plan.seeds.size());
}

std::string title(StudyQuantity quantity) {
  const StudyField& field = field_of(quantity);
  return std::string(field.title) + (field.unit.empty() ? "" : " [" + std::string(field.unit) + "]");
}

/// Characters of UTF-8 text.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::string joined(const std::vector<std::string>& words, const char* separator) {
  std::string text;
  for (const std::string& word : words) {
    if (&word != &words.front()) text += separator;
    text += word;
  }
  return text;
}

/// A Markdown table with its columns one below the other; the first row is the head.
std::string table_text(const Table& table) {
  std::vector<std::size_t> widths(table.front().size(), 3);
  for (const auto& row : table)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], width(row[k]));
  std::string text;
  for (const auto& row : table) {
    for (std::size_t k = 0; k < row.size(); ++k)
      text.append("| ").append(row[k]).append(widths[k] - width(row[k]) + 1, ' ');
    text += "|\n";
    if (&row != &table.front()) continue;
    for (const std::size_t w : widths) text.append("|").append(w + 2, '-');
    text += "|\n";
  }
  return text + "\n";
}

/// One row for each variation from `first` on, one column for each quantity that any run has.
template <typename Cell>
std::string table_of(const StudyResult& result, const std::vector<StudyQuantity>& quantities,
                     std::size_t first, const Cell& cell_text) {
  std::vector<StudyQuantity> known;
  for (const StudyQuantity quantity : quantities)
    if (is_known(result, quantity)) known.push_back(quantity);
  Table table = {{"variation"}};
  for (const StudyQuantity quantity : known) table.front().push_back(title(quantity));
  for (std::size_t v = first; v < result.plan.variations.size(); ++v) {
    table.push_back({result.plan.variations[v].name});
    for (const StudyQuantity quantity : known) table.back().push_back(cell_text(v, quantity));
  }
  return table_text(table);
}

std::vector<StudyQuantity> quantities_of(StudyGroup first, StudyGroup second) {
  std::vector<StudyQuantity> quantities = quantities_of(first);
  const std::vector<StudyQuantity> more = quantities_of(second);
  quantities.insert(quantities.end(), more.begin(), more.end());
  return quantities;
}

struct Tally {
  int made = 0;
  int differing = 0;
};

std::string introduction(const StudyResult& result) {
  const StudyPlan& plan = result.plan;
  std::set<std::string> versions;
  for (const StudyOutcome& outcome : result.outcomes) versions.insert(outcome.version);
  std::vector<std::string> seeds;
  for (const std::uint64_t seed : plan.seeds) seeds.push_back(std::to_string(seed));
  std::string text = "# Study of " + plan.scenario_file + "\n\n" + std::to_string(result.outcomes.size()) +
                     " of " + std::to_string(plan.runs.size()) + " runs complete; seeds " +
                     joined(seeds, ", ") +
                     ". Values are means over seeds ± standard error; worst residuals are the largest of all "
                     "seeds.\n";
  if (!plan.baseline.empty()) text += "Baseline: " + plan.baseline + ".\n";
  for (const std::string& version : versions) text += "Computed by Talus " + version + ".\n";
  if (versions.size() > 1)
    text += "**Runs of several versions stand side by side: differences may be theirs.**\n";
  return text + "\n";
}

std::string differences(const StudyResult& result) {
  Tally tally;
  const auto difference = [&](std::size_t v, StudyQuantity quantity) {
    const MeanError found = compare(result, v, quantity).difference;
    if (found.count > 1) ++tally.made;
    if (verdict(found) == Verdict::differs) ++tally.differing;
    return difference_text(found, field_of(quantity).factor, result.plan.seeds.size());
  };
  const std::string angle = short_text(result.reference) + " deg";
  std::string text =
      "## Difference to the baseline: theta_c, and the bed at " + angle + "\n\n" +
      table_of(result, quantities_of(StudyGroup::slope, StudyGroup::at_reference), 1, difference);
  if (is_known(result, StudyQuantity::theta_c))
    text += "## Difference to the baseline: the bed at theta_c\n\n" +
            table_of(result, quantities_of(StudyGroup::at_theta_c), 1, difference);
  text +=
      "Mean of the differences of runs with the same seed ± standard error. Within error: zero lies in the ";
  text += "interval of 95 % confidence (Student's t). ";
  return text + std::to_string(tally.differing) + " of " + std::to_string(tally.made) +
         " comparisons differ; by chance alone about " + fixed(0.05 * tally.made, 1, false) + " would.\n";
}

json::Members runs_json(const StudyResult& result) {
  json::Members runs;
  for (const StudyOutcome& outcome : result.outcomes) {
    json::Members figures;
    for (std::size_t k = 0; k < study_quantity_count; ++k)
      figures.emplace_back(study_fields[k].name, json::number(outcome.figures[k]));
    figures.emplace_back("state_hash", json::quoted(outcome.state_hash));
    figures.emplace_back("version", json::quoted(outcome.version));
    runs.emplace_back(result.plan.runs[outcome.run].name, json::object(figures, 2));
  }
  return runs;
}

std::string comparison_json(const Comparison& found) {
  static const char* const words[] = {"unknown", "within error", "differs"};
  return json::object({{"seeds", json::number(found.value.count)},
                       {"mean", json::number(found.value.mean)},
                       {"error", json::number(found.value.error)},
                       {"difference", json::number(found.difference.mean)},
                       {"difference_error", json::number(found.difference.error)},
                       {"verdict", json::quoted(words[static_cast<int>(verdict(found.difference))])}},
                      3);
}

}  // namespace

std::string study_csv(const StudyResult& result) {
  std::vector<std::string> head = {"variation", "seed"};
  for (const StudyField& field : study_fields) head.emplace_back(field.name);
  head.insert(head.end(), {"reference_deg", "state_hash", "version"});
  std::string text = joined(head, ",") + "\n";
  for (const StudyOutcome& outcome : result.outcomes) {
    const StudyRun& run = result.plan.runs[outcome.run];
    std::vector<std::string> row = {json::quoted(result.plan.variations[run.variation].name),
                                    std::to_string(run.seed)};
    for (const double value : outcome.figures) row.push_back(std::isnan(value) ? "" : short_text(value));
    row.insert(row.end(), {short_text(result.reference), outcome.state_hash, outcome.version});
    text += joined(row, ",") + "\n";
  }
  return text;
}

std::string study_markdown(const StudyResult& result) {
  const auto value = [&](std::size_t v, StudyQuantity quantity) { return cell(result, v, quantity); };
  const auto tables = [&](const std::string& head, const std::vector<StudyQuantity>& quantities) {
    return "## " + head + "\n\n" + table_of(result, quantities, 0, value);
  };
  std::string text = introduction(result);
  text += tables("Angle of repose, and how well it was solved",
                 quantities_of(StudyGroup::slope, StudyGroup::solver));
  text +=
      tables("The bed at " + short_text(result.reference) + " deg", quantities_of(StudyGroup::at_reference));
  if (is_known(result, StudyQuantity::theta_c))
    text += tables("The bed at theta_c", quantities_of(StudyGroup::at_theta_c));
  return result.plan.variations.size() > 1 ? text + differences(result) : text;
}

std::string study_json(const StudyResult& result) {
  json::Members variations;
  for (std::size_t v = 0; v < result.plan.variations.size(); ++v) {
    json::Members quantities;
    for (std::size_t k = 0; k < study_quantity_count; ++k)
      quantities.emplace_back(study_fields[k].name,
                              comparison_json(compare(result, v, static_cast<StudyQuantity>(k))));
    variations.emplace_back(result.plan.variations[v].name, json::object(quantities, 2));
  }
  return json::object({{"scenario", json::quoted(result.plan.scenario_file)},
                       {"reference_deg", json::number(result.reference)},
                       {"variations", json::object(variations, 1)},
                       {"runs", json::object(runs_json(result), 1)}});
}

}  // namespace talus
