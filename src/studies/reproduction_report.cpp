#include "studies/reproduction_report.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "base/text.h"
#include "base/version.h"
#include "ensemble/plus_minus.h"
#include "scenario/text.h"
#include "session/estimate.h"

namespace talus::studies {
namespace {

/// "0.300", "15.0", "119", "7.4e-05".
std::string three_digits(double value) {
  const double size = std::abs(value);
  return size >= 99.95 && size < 999.5 ? fmt::format("{:.0f}", value) : fmt::format("{:#.3g}", value);
}

std::string unit_text(std::string_view unit) { return unit == "1" ? "" : fmt::format(" {}", unit); }

/// "about 3.5", and below it how far off a value may be, and where it stands.
TextCell paper_cell(const PaperValue& paper) {
  std::string note;
  if (paper.relation == Relation::equals)
    note = fmt::format("{:.3g} ± {:.2g}{}; ", paper.value, paper.accuracy, unit_text(paper.unit));
  return {std::string(paper.text), note + std::string(paper.where)};
}

std::vector<std::size_t> periodic_beds(const ReproductionPlan& plan) {
  std::vector<std::size_t> beds;
  for (std::size_t b = 0; b < plan.variants.size(); ++b)
    if (is_periodic(plan.variants[b])) beds.push_back(b);
  return beds;
}

std::string bed_text(const ensemble::Variant& bed) {
  return fmt::format("{}, L = {} D", is_periodic(bed) ? "periodic" : "walls",
                     scenario::short_text(bed.scenario.bed.length));
}

TextTable beds_table(const ReproductionResult& result) {
  TextTable table{{{"bed"},
                   {"H", true},
                   {"grains", true},
                   {"preparation"},
                   {"seeds complete", true},
                   {"theta_c [deg]", true},
                   {"processor time", true}},
                  {}};
  for (std::size_t b = 0; b < result.plan.variants.size(); ++b) {
    const ensemble::Variant& bed = result.plan.variants[b];
    const auto outcomes = outcomes_of(result, b);
    double seconds = 0.0;
    for (const ReproducedOutcome* outcome : outcomes) seconds += outcome->seconds;
    table.rows.push_back({{bed_text(bed)},
                          {scenario::short_text(bed.scenario.bed.depth) + " D"},
                          {std::to_string(session::estimate(bed.scenario).grains)},
                          {preparation_text(bed)},
                          {fmt::format("{} of {}", outcomes.size(), result.plan.seeds.size())},
                          {spread_text(spread_of(result, b, PaperQuantity::theta_c))},
                          {session::duration_text(seconds)}});
  }
  return table;
}

std::string versions_text(const ReproductionResult& result) {
  std::vector<std::string> versions;
  double seconds = 0.0;
  for (const ReproducedOutcome& outcome : result.outcomes) {
    seconds += outcome.seconds;
    if (std::ranges::find(versions, outcome.version) == versions.end()) versions.push_back(outcome.version);
  }
  return fmt::format("Runs by Talus {}; their steps took {} on one thread each. Analysed and drawn by {}.",
                     joined(versions, ", "), session::duration_text(seconds), version_text());
}

std::vector<std::string> run_commands(const ReproductionPlan& plan) {
  std::vector<std::string> lines;
  for (const ensemble::Variant& bed : plan.variants)
    lines.push_back(fmt::format("talus run scenarios/{0}.toml --seed N -o {0}/seed-N.h5", bed.name));
  lines.emplace_back("talus analyze */seed-*.h5");
  return lines;
}

std::vector<ReportBlock> run_blocks(const ReproductionResult& result) {
  const ReproductionPlan& plan = result.plan;
  std::vector<ReportBlock> blocks = {ReportHeading{2, "What was run"}};
  if (plan.quick)
    blocks.emplace_back(ReportParagraph{
        "Quick: beds of half the paper's depth with the same H / L between walls. Angles and ratios can be "
        "compared with the paper's, lengths cannot. Without `--quick` the beds are the paper's."});
  blocks.emplace_back(ReportParagraph{
      fmt::format("Rigid disks, friction 0.5, no restitution, diameters within a ratio of 1.5, tilted by 1 "
                  "deg/s in steps of 0.001 deg until the slope fails. Seeds: {}. The paper says no more of "
                  "its deposition than that it is random, so the periodic bed is prepared in three ways: "
                  "poured, set down geometrically, and as a collapse (`deposition.method`).",
                  joined(plan.seeds, ", "))});
  blocks.emplace_back(beds_table(result));
  blocks.emplace_back(ReportParagraph{versions_text(result)});
  blocks.emplace_back(ReportParagraph{"The same by hand, in the folder of this report, for each seed N:"});
  blocks.emplace_back(ReportCommands{run_commands(plan)});
  return blocks;
}

std::vector<ReportBlock> rule_blocks() {
  return {
      ReportHeading{2, "How values are compared"},
      ReportList{{
          "Ours is the mean over the seeds ± their standard deviation (that of one bed, not of the mean).",
          ("The accuracy of a value of the paper, printed below it, is half a step of the number as it is "
           "printed, or of the scale that it was read from. For theta_c, which the paper gives as one range "
           "for all its beds, about 19 to 21 deg, the value is the middle of the range and the accuracy half "
           "its width."),
          ("theta_c falls with the length of a periodic bed, because the weakest place decides. The "
           "threshold Gamma_c = sin(theta_c) falls with it, so that p_o at equal tilt is higher in a longer "
           "bed."),
          ("The tolerance is this accuracy plus one standard deviation of ours, and a value within it "
           "agrees. A wide spread thus makes it easier to agree, so the spread is printed with the value."),
          ("\"Does not occur\" means that no run shows it; \"not comparable\" is followed by the reason. "
           "`<=` marks an upper bound: the event has already happened in the first frame."),
          ("Every value that depends on which grains are overloaded is given in three readings: single "
           "grains with the printed threshold, gamma >= Gamma_c = sin(theta_c); single grains with twice "
           "that threshold; and grains taken together with all neighbours within 1.5 D, with the printed "
           "threshold. theta_c is that of the same run."),
      }}};
}

std::vector<TextColumn> value_columns(const ReproductionPlan& plan, bool by_reading) {
  std::vector<TextColumn> columns = {{"quantity"}, {"paper"}};
  if (by_reading) columns.push_back({"overloaded are"});
  for (const std::size_t b : periodic_beds(plan))
    columns.push_back({preparation_text(plan.variants[b]), true});
  return columns;
}

std::vector<TextCell> value_cells(const ReproductionResult& result, const PaperValue& paper,
                                  const Reading& reading) {
  std::vector<TextCell> cells;
  for (const std::size_t b : periodic_beds(result.plan))
    cells.push_back(judged_cell(paper, spread_of(result, b, paper.quantity, reading),
                                result.plan.variants[b].scenario.bed.depth));
  return cells;
}

TextTable packing_table(const ReproductionResult& result) {
  TextTable table{value_columns(result.plan, false), {}};
  for (const PaperValue& paper : packing_values()) {
    std::vector<TextCell> row = {{name_text(paper)}, paper_cell(paper)};
    std::ranges::move(value_cells(result, paper, base_readings().back()), std::back_inserter(row));
    table.rows.push_back(std::move(row));
  }
  return table;
}

TextTable chain_table(const ReproductionResult& result) {
  TextTable table{value_columns(result.plan, true), {}};
  for (const PaperValue& paper : chain_values()) {
    const bool by_reading = paper.quantity != PaperQuantity::theta_d_by_dilation;
    const std::span<const Reading> all = base_readings();
    for (const Reading& reading : by_reading ? all : all.first(1)) {
      const bool first = &reading == &all.front();
      std::vector<TextCell> row = {{first ? name_text(paper) : ""},
                                   first ? paper_cell(paper) : TextCell{""},
                                   {by_reading ? reading.base : "none needed"}};
      std::ranges::move(value_cells(result, paper, reading), std::back_inserter(row));
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

TextTable wall_table(const ReproductionResult& result) {
  TextTable table{{{"bed"}, {"quantity"}, {"paper"}, {"ours", true}}, {}};
  for (const PaperValue& general : wall_values())
    for (std::size_t b = 0; b < result.plan.variants.size(); ++b) {
      const ensemble::Variant& bed = result.plan.variants[b];
      if (is_periodic(bed)) continue;
      const PaperValue paper = paper_value_of_walls(general.quantity, depth_over_length(bed));
      table.rows.push_back(
          {{bed_text(bed)},
           {name_text(paper)},
           paper_cell(paper),
           judged_cell(paper, spread_of(result, b, paper.quantity), bed.scenario.bed.depth)});
    }
  const std::vector<WallPoint> points = wall_points(result);
  const WallFit fit = fit_wall_law(points);
  const PaperValue& paper = paper_value(PaperQuantity::wall_coefficient);
  const int count = static_cast<int>(points.size());
  const Spread ours{count, {count, fit.k, fit.error, fit.error}, false};
  table.rows.push_back({{"all between walls"},
                        {std::string(paper.name)},
                        paper_cell(paper),
                        judged_cell(paper, ours, paper_depth)});
  return table;
}

TextTable definition_table() {
  TextTable table{{{"quantity"}, {"how ours is measured"}, {"data set of a run file"}}, {}};
  for (const PaperValue& paper : paper_values)
    table.rows.push_back({{std::string(paper.name)},
                          {std::string(paper.definition)},
                          {fmt::format("`/analysis/{}`", analysis::quantity_of(paper.source).name)}});
  return table;
}

std::vector<ReportBlock> definition_blocks() {
  return {
      ReportHeading{2, "How each number is measured"},
      ReportParagraph{"`talus analyze BED/seed-N.h5` prints the series of a run and, with `--json`, all "
                      "of them; they are in the run file under the path given here. Definitions are those "
                      "of docs/analysis.md and docs/notation.md; `values.csv` has the value of each run."},
      definition_table()};
}

/// How many of some values agree in a preparation.
std::string agreement_count(const ReproductionResult& result, std::size_t bed,
                            std::span<const PaperValue> values) {
  int agreeing = 0, comparable = 0;
  for (const PaperValue& paper : values) {
    const Agreement found =
        judge(paper, spread_of(result, bed, paper.quantity), result.plan.variants[bed].scenario.bed.depth)
            .agreement;
    agreeing += found == Agreement::agrees ? 1 : 0;
    comparable += found != Agreement::not_comparable ? 1 : 0;
  }
  return fmt::format("{} of {}", agreeing, comparable);
}

}  // namespace

std::string name_text(const PaperValue& paper) {
  return std::string(paper.name) + (paper.unit == "1" ? "" : fmt::format(" [{}]", paper.unit));
}

std::string preparation_text(const ensemble::Variant& bed) {
  switch (bed.scenario.deposition.method) {
    case scenario::DepositionMethod::pour:
      return "poured grains";
    case scenario::DepositionMethod::geometric:
      return "grains set down geometrically";
    case scenario::DepositionMethod::collapse:
      return "grains that collapse";
    case scenario::DepositionMethod::file:
      break;
  }
  return "grains placed by a file";
}

std::string spread_text(const Spread& spread) {
  if (spread.values.count == 0) return "-";
  std::string text = spread.at_most ? "<= " : "";
  if (spread.values.count > 1 && spread.values.deviation > 0.0)
    text += ensemble::plus_minus(spread.values.mean, spread.values.deviation);
  else
    text += three_digits(spread.values.mean) + (spread.values.count > 1 ? " ± 0" : "");
  if (spread.values.count < spread.runs) text += fmt::format(" ({} of {})", spread.values.count, spread.runs);
  return text;
}

TextCell judged_cell(const PaperValue& paper, const Spread& ours, double depth) {
  const Judgement judgement = judge(paper, ours, depth);
  const Tone tones[] = {Tone::good, Tone::bad, Tone::bad, Tone::muted};
  return {spread_text(ours), judgement_text(judgement), tones[static_cast<std::size_t>(judgement.agreement)]};
}

std::vector<std::string> reproduction_summary(const ReproductionResult& result) {
  std::vector<std::string> items;
  std::vector<std::string> counts;
  for (const std::size_t b : periodic_beds(result.plan))
    counts.push_back(fmt::format("{} with {}", agreement_count(result, b, packing_values()),
                                 preparation_text(result.plan.variants[b])));
  items.push_back(fmt::format("Of the paper's values for the packing, these agree: {}.", listed(counts)));
  const std::vector<WallPoint> points = wall_points(result);
  const WallFit fit = fit_wall_law(points);
  if (points.size() > 1)
    items.push_back(
        fmt::format("Between walls, k_L - k_0 = {:.2f} ± {:.2f} over {} runs; in the paper about 2.5.", fit.k,
                    fit.error, points.size()));
  std::ranges::move(threshold_verdict(result.plan, chain_results(result)), std::back_inserter(items));
  return items;
}

ReportDocument reproduction_report(const ReproductionResult& result, const ReproductionPictures& pictures) {
  ReportDocument document{"Talus and the paper", {}};
  auto& blocks = document.blocks;
  const auto append = [&blocks](const auto& more) {
    for (const auto& block : more) blocks.emplace_back(block);
  };
  blocks.emplace_back(
      ReportParagraph{"What L. Staron, J.-P. Vilotte and F. Radjai report in \"Multiscale Analysis of the "
                      "Stress State in a Granular Slope in Transition to Failure\" (2005), and what Talus "
                      "finds in beds made and tilted in the same way. Written by `talus reproduce`."});
  blocks.emplace_back(ReportContents{});
  blocks.emplace_back(ReportHeading{2, "In short"});
  blocks.emplace_back(ReportList{reproduction_summary(result)});
  append(pictures.agreement);
  blocks.emplace_back(ReportHeading{2, "The packing"});
  blocks.emplace_back(packing_table(result));
  append(pictures.packing);
  blocks.emplace_back(ReportHeading{2, "Overloaded grains, lengths and the transition"});
  blocks.emplace_back(chain_table(result));
  append(pictures.overload);
  blocks.emplace_back(ReportHeading{2, "Beds between walls"});
  blocks.emplace_back(
      ReportParagraph{"Deposition friction 0.5. The paper's Eq. 15: (sigma_T/sigma_N)/tan(theta) = 1 - "
                      "(k_L - k_0)/3 H/L; its values for each length are this with k_L - k_0 = 2.5."});
  blocks.emplace_back(wall_table(result));
  append(pictures.walls);
  append(threshold_blocks(result));
  if (!pictures.further.empty()) blocks.emplace_back(ReportHeading{2, "Further figures"});
  append(pictures.further);
  append(run_blocks(result));
  append(rule_blocks());
  append(definition_blocks());
  return document;
}

}  // namespace talus::studies
