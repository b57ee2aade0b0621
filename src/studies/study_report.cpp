#include "studies/study_report.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <set>

#include "base/text.h"
#include "base/text_table.h"
#include "ensemble/plus_minus.h"
#include "scenario/text.h"

namespace talus::studies {
namespace {

std::vector<StudyQuantity> quantities_of(std::initializer_list<StudyGroup> groups) {
  std::vector<StudyQuantity> quantities;
  for (const StudyGroup group : groups)
    for (std::size_t k = 0; k < study_quantity_count; ++k)
      if (study_fields()[k].group == group) quantities.push_back(static_cast<StudyQuantity>(k));
  return quantities;
}

const StudyField& field_of(StudyQuantity quantity) {
  return study_fields()[static_cast<std::size_t>(quantity)];
}

bool is_known(const StudyResult& result, StudyQuantity quantity) {
  return std::ranges::any_of(result.outcomes, [&](const StudyOutcome& outcome) {
    return !std::isnan(at(outcome.figures, quantity));
  });
}

/// Returns mean ± error, or the mean with four digits if it has no error; a count is added if seeds are
/// missing.
std::string mean_text(const Statistics& value, double factor, std::size_t seeds, bool sign = false) {
  if (value.count == 0) return "-";
  const double mean = value.mean * factor, error = value.error * factor;
  const std::string text = error > 0.0 ? ensemble::plus_minus(mean, error, sign)
                                       : fmt::format(fmt::runtime(sign ? "{:+.4g}{}" : "{:.4g}{}"), mean,
                                                     value.count > 1 ? " ± 0" : "");
  const auto count = static_cast<std::size_t>(value.count);
  return count == seeds ? text : fmt::format("{} ({} seeds)", text, count);
}

std::string difference_text(const Statistics& difference, double factor, std::size_t seeds) {
  std::string text = mean_text(difference, factor, seeds, true);
  const Verdict found = verdict(difference);
  if (found == Verdict::within_error) text += ", within error";
  if (found == Verdict::unknown && difference.count > 1) text += ", the same for all seeds: without an error";
  return found == Verdict::differs ? fmt::format("**differs by {}**", text) : text;
}

std::string solver_text(const StudyResult& result, std::size_t variation, StudyQuantity quantity) {
  const std::vector<double> values = values_of(result, variation, quantity);
  const bool worst =
      quantity == StudyQuantity::residual_max_rest || quantity == StudyQuantity::residual_max_moving;
  double value = statistics_of(values).mean;
  if (std::isnan(value)) return "-";
  if (worst)
    for (const double one : values) value = std::fmax(value, one);
  value *= field_of(quantity).factor;
  return worst ? fmt::format("{:.1e}", value) : fmt::format("{:.3g}", value);
}

std::string cell(const StudyResult& result, std::size_t variation, StudyQuantity quantity) {
  if (field_of(quantity).group == StudyGroup::solver) return solver_text(result, variation, quantity);
  const Comparison found = compare(result, variation, quantity);
  return mean_text(found.value, field_of(quantity).factor, result.plan.seeds.size());
}

/// One row for each variation from `first` on, one column for each quantity that any run has.
template <typename Cell>
std::string table_of(const StudyResult& result, const std::vector<StudyQuantity>& quantities,
                     std::size_t first, const Cell& cell_text) {
  std::vector<StudyQuantity> known;
  for (const StudyQuantity quantity : quantities)
    if (is_known(result, quantity)) known.push_back(quantity);
  TextTable table{{{"variation"}}, {}};
  for (const StudyQuantity quantity : known) table.columns.push_back({field_of(quantity).title});
  for (std::size_t v = first; v < result.plan.variants.size(); ++v) {
    auto& row = table.rows.emplace_back();
    row.push_back({markdown_escaped(result.plan.variants[v].name)});
    for (const StudyQuantity quantity : known) row.push_back({cell_text(v, quantity)});
  }
  return markdown_text(table) + "\n";
}

std::string introduction(const StudyResult& result) {
  const StudyPlan& plan = result.plan;
  std::set<std::string> versions;
  for (const StudyOutcome& outcome : result.outcomes) versions.insert(outcome.version);
  std::string text = fmt::format(
      "# Study of {}\n\n{} of {} runs complete; seeds {}. Values are means over seeds ± standard error; "
      "worst residuals are the largest of all seeds.\n",
      markdown_escaped(plan.scenario_file), result.outcomes.size(), plan.members.size(),
      joined(plan.seeds, ", "));
  if (!plan.baseline.empty()) text += fmt::format("Baseline: {}.\n", markdown_escaped(plan.baseline));
  for (const std::string& version : versions) text += fmt::format("Computed by Talus {}.\n", version);
  if (versions.size() > 1)
    text += "**The runs come from several versions of Talus, which may cause differences.**\n";
  return text + "\n";
}

std::string differences(const StudyResult& result) {
  int made = 0, differing = 0;
  const auto difference = [&](std::size_t v, StudyQuantity quantity) {
    const Statistics found = compare(result, v, quantity).difference;
    if (found.count > 1) ++made;
    if (verdict(found) == Verdict::differs) ++differing;
    return difference_text(found, field_of(quantity).factor, result.plan.seeds.size());
  };
  const std::string angle = scenario::short_text(result.reference) + " deg";
  std::string text = fmt::format(
      "## Difference from the baseline: theta_c, and the bed at {}\n\n{}", angle,
      table_of(result, quantities_of({StudyGroup::slope, StudyGroup::at_reference}), 1, difference));
  if (is_known(result, StudyQuantity::theta_c))
    text += "## Difference from the baseline: the bed at theta_c\n\n" +
            table_of(result, quantities_of({StudyGroup::at_theta_c}), 1, difference);
  return fmt::format(
      "{}Mean of the differences of runs with the same seed ± standard error. Within error: zero lies in the "
      "interval of 95 % confidence (Student's t). {} of {} comparisons differ; by chance alone about {:.1f} "
      "would.\n",
      text, differing, made, 0.05 * made);
}

}  // namespace

std::string study_csv(const StudyResult& result) {
  TextTable table{{{"variation"}, {"seed"}}, {}};
  for (const StudyField& field : study_fields()) table.columns.push_back({field.name});
  for (const char* name : {"reference_deg", "state_hash", "version"}) table.columns.push_back({name});
  for (const StudyOutcome& outcome : result.outcomes) {
    const ensemble::Member& run = result.plan.members[outcome.member];
    auto& row = table.rows.emplace_back();
    row = {{csv_quoted(result.plan.variants[run.variant].name)}, {std::to_string(run.seed)}};
    for (const double value : outcome.figures)
      row.push_back({std::isnan(value) ? "" : scenario::short_text(value)});
    for (const std::string& text :
         {scenario::short_text(result.reference), outcome.state_hash, outcome.version})
      row.push_back({text});
  }
  return csv_text(table);
}

std::string study_markdown(const StudyResult& result) {
  const auto value = [&](std::size_t v, StudyQuantity quantity) { return cell(result, v, quantity); };
  const auto tables = [&](const std::string& head, const std::vector<StudyQuantity>& quantities) {
    return fmt::format("## {}\n\n{}", head, table_of(result, quantities, 0, value));
  };
  std::string text = introduction(result);
  text += tables("Angle of repose, and how well it was solved",
                 quantities_of({StudyGroup::slope, StudyGroup::solver}));
  text += tables(fmt::format("The bed at {} deg", scenario::short_text(result.reference)),
                 quantities_of({StudyGroup::at_reference}));
  if (is_known(result, StudyQuantity::theta_c))
    text += tables("The bed at theta_c", quantities_of({StudyGroup::at_theta_c}));
  return result.plan.variants.size() > 1 ? text + differences(result) : text;
}

}  // namespace talus::studies
