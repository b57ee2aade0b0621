#include "figures/agreement_figure.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/text.h"
#include "figures/group_table.h"
#include "scenario/text.h"
#include "studies/reproduction_report.h"

namespace talus::figures {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A chart with rows from top to bottom and several symbols in each row.
struct Chart {
  std::string name;                 ///< name of its table
  std::vector<std::string> rows;    ///< labels
  std::vector<std::string> papers;  ///< value of the paper in each row
  std::vector<std::string> series;  ///< descriptions of the symbols
  Table table;
};

Chart empty_chart(const std::string& name, std::vector<std::string> series) {
  return {name,
          {},
          {},
          std::move(series),
          {name,
           {{"row", "1", "row of the chart, counted from 1 at the top", {}},
            {"series", "1", "preparation or reading, counted from 1 in the order of the key", {}},
            {"ours", "unit of the row", "mean over the runs; NaN if the value occurs in none", {}},
            {"deviation", "unit of the row", "standard deviation over the runs", {}},
            {"paper", "unit of the row", "value of the paper", {}},
            {"tolerance",
             "unit of the row",
             "largest difference for agreement: accuracy of the paper and one standard deviation of ours",
             {}},
            {"score", "1", "(ours - paper) / tolerance; NaN if the value does not occur", {}},
            {"agrees", "1", "1 if they agree, else 0", {}}}}};
}

/// Whether the value can be charted: the paper has a number, and ours can be compared with it.
bool is_charted(const studies::PaperValue& paper, const studies::Judgement& judgement) {
  return paper.relation == studies::Relation::equals &&
         judgement.agreement != studies::Agreement::not_comparable;
}

/// Adds a row for one value, for beds of given depths; no row is added if no series can be compared.
void add_row(Chart& chart, const studies::PaperValue& paper, const std::string& label,
             std::span<const std::pair<studies::Spread, double>> ours_and_depths) {
  bool charted = false;
  const double row = static_cast<double>(chart.rows.size()) + 1.0;
  for (std::size_t s = 0; s < ours_and_depths.size(); ++s) {
    const auto& [ours, depth] = ours_and_depths[s];
    const studies::Judgement judgement = studies::judge(paper, ours, depth);
    if (!is_charted(paper, judgement)) continue;
    charted = true;
    const bool occurs = judgement.agreement != studies::Agreement::absent;
    const double values[] = {row,
                             static_cast<double>(s) + 1.0,
                             occurs ? ours.values.mean : not_a_number,
                             ours.values.deviation,
                             paper.value,
                             judgement.tolerance,
                             occurs ? judgement.difference / judgement.tolerance : not_a_number,
                             judgement.agreement == studies::Agreement::agrees ? 1.0 : 0.0};
    for (std::size_t k = 0; k < chart.table.columns.size(); ++k)
      chart.table.columns[k].values.push_back(values[k]);
  }
  if (!charted) return;
  chart.rows.push_back(label);
  chart.papers.push_back(fmt::format("{:.3g}{}", paper.value,
                                     paper.unit == "1"     ? ""
                                     : paper.unit == "deg" ? "°"
                                                           : fmt::format(" {}", paper.unit)));
}

std::vector<std::size_t> beds_of(const studies::ReproductionPlan& plan, bool periodic) {
  std::vector<std::size_t> beds;
  for (std::size_t b = 0; b < plan.variants.size(); ++b)
    if (studies::is_periodic(plan.variants[b]) == periodic) beds.push_back(b);
  return beds;
}

double depth_of(const studies::ReproductionResult& result, std::size_t bed) {
  return result.plan.variants[bed].scenario.bed.depth;
}

/// Adds rows for beds between walls, which are all poured, as in the first preparation.
void add_wall_rows(Chart& chart, const studies::ReproductionResult& result) {
  for (const studies::PaperValue& general : studies::wall_values())
    for (const std::size_t b : beds_of(result.plan, false)) {
      const ensemble::Variant& bed = result.plan.variants[b];
      const std::pair<studies::Spread, double> ours{studies::spread_of(result, b, general.quantity),
                                                    bed.scenario.bed.depth};
      add_row(chart, studies::paper_value_of_walls(general.quantity, studies::depth_over_length(bed)),
              fmt::format("walls, L = {} D: {}", scenario::short_text(bed.scenario.bed.length), general.name),
              {&ours, 1});
    }
  const std::vector<studies::WallPoint> points = studies::wall_points(result);
  if (points.size() < 2) return;
  const studies::WallFit fit = studies::fit_wall_law(points);
  const int count = static_cast<int>(points.size());
  const std::pair<studies::Spread, double> ours{
      studies::Spread{count, {count, fit.k, fit.error, fit.error}, false}, studies::paper_depth};
  const studies::PaperValue& paper = studies::paper_value(studies::PaperQuantity::wall_coefficient);
  add_row(chart, paper, "walls: " + std::string(paper.name), {&ours, 1});
}

Chart packing_chart(const studies::ReproductionResult& result) {
  const std::vector<std::size_t> beds = beds_of(result.plan, true);
  std::vector<std::string> series;
  for (const std::size_t b : beds) series.push_back(studies::preparation_text(result.plan.variants[b]));
  Chart chart = empty_chart("packing", std::move(series));
  for (const studies::PaperValue& paper : studies::packing_values()) {
    std::vector<std::pair<studies::Spread, double>> ours;
    for (const std::size_t b : beds)
      ours.emplace_back(studies::spread_of(result, b, paper.quantity, studies::base_readings().back()),
                        depth_of(result, b));
    add_row(chart, paper, std::string(paper.name), ours);
  }
  add_wall_rows(chart, result);
  return chart;
}

Chart chain_chart(const studies::ReproductionResult& result) {
  std::vector<std::string> series;
  for (const studies::Reading& reading : studies::base_readings()) series.push_back(reading.base);
  Chart chart = empty_chart("chain", std::move(series));
  const std::size_t bed = beds_of(result.plan, true).front();
  for (const studies::PaperValue& paper : studies::chain_values()) {
    std::vector<std::pair<studies::Spread, double>> ours;
    for (const studies::Reading& reading : studies::base_readings())
      ours.emplace_back(studies::spread_of(result, bed, paper.quantity, reading), depth_of(result, bed));
    if (paper.quantity == studies::PaperQuantity::theta_d_by_dilation) ours.resize(1);  // needs no reading
    add_row(chart, paper, std::string(paper.name), ours);
  }
  return chart;
}

/// Replaces names by Greek letters and signs for gnuplot.
std::string typeset(std::string text) {
  static constexpr std::pair<std::string_view, std::string_view> words[] = {
      {"theta", "θ"},
      {"sigma", "σ"},
      {"gamma", "γ"},
      {"Gamma", "Γ"},
      {">=", "≥"},
      {"l_c", "{/:Italic ℓ}_c"},
      {" deg", "°"},
      {"contact normals concentrate", "normals"},
      {"single grains", "grains alone"},
      {"σ_T/σ_N over tan(θ)", "σ_T/σ_N / tan(θ)"},
      {": θ_c", ": {/:Italic θ}_c"},
      {"/ tan(θ) at θ_c", "/ tan({/:Italic θ}_c)"},
  };
  for (const auto& [plain, set] : words)
    for (std::size_t at = text.find(plain); at != std::string::npos; at = text.find(plain, at + set.size()))
      text.replace(at, plain.size(), set);
  return text;
}

void add_texts(Figure& figure, const std::string& name, std::span<const std::string> texts) {
  for (std::size_t k = 0; k < texts.size(); ++k)
    set_variable(figure, fmt::format("{}_{}", name, k + 1), gnuplot_string(typeset(texts[k])));
}

void add_chart(Figure& figure, const Chart& chart) {
  set_variable(figure, chart.name + "_rows", static_cast<double>(chart.rows.size()));
  set_variable(figure, chart.name + "_series", static_cast<double>(chart.series.size()));
  add_texts(figure, chart.name + "_row", chart.rows);
  add_texts(figure, chart.name + "_paper", chart.papers);
  add_texts(figure, chart.name + "_label", chart.series);
  figure.tables.push_back(chart.table);
}

}  // namespace

std::optional<Figure> agreement_figure(const studies::ReproductionResult& result) {
  const Chart packing = packing_chart(result), chain = chain_chart(result);
  if (packing.rows.empty() && chain.rows.empty()) return std::nullopt;
  Figure figure;
  figure.name = "agreement";
  figure.title = "Our values and the paper's";
  figure.caption =
      "Our value minus the paper's, in units of the tolerance of the comparison; values in the gray band "
      "agree (full symbols). (a) The packing, by preparation of the periodic bed, and beds between walls. "
      "(b) Overloaded grains, their lengths and theta_d, in the periodic bed of the paper's preparation, by "
      "reading of \"overloaded\". Arrows: values beyond the axis. A cross at the right: the value does not "
      "occur. Numbers at the right are those of the paper.";
  for (const studies::ReproducedOutcome& outcome : result.outcomes)
    figure.runs.push_back(result.plan.members[outcome.member].path);
  figure.wide = true;
  const double rows = static_cast<double>(std::max(packing.rows.size(), chain.rows.size()));
  figure.height_over_width = (3.2 + 0.42 * std::max(rows, 6.0)) / 17.8;
  add_chart(figure, packing);
  add_chart(figure, chain);
  return figure;
}

}  // namespace talus::figures
