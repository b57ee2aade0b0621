#include "ensemble/averages_file.h"

#include <array>
#include <cmath>
#include <fmt/core.h>

#include "core/hash.h"
#include "core/text.h"
#include "io/plain_file.h"

namespace talus {
namespace {

/// The columns of a summary, in the file and in CSV.
constexpr std::array<const char*, 9> summary_columns = {
    "n", "mean", "deviation", "error", "low", "high", "lower_quartile", "median", "upper_quartile"};

std::array<double, 9> row_of(const Summary& summary) {
  const Statistics& found = summary.statistics;
  return {static_cast<double>(found.count),
          found.mean,
          found.deviation,
          found.error,
          summary.low,
          summary.high,
          summary.lower_quartile,
          summary.median,
          summary.upper_quartile};
}

/// A file under construction.
struct Content {
  std::vector<PlainArray> arrays;
  std::vector<PlainTexts> texts;
};

/// Takes the values of the members out of the quantity.
void add_quantity(Content& content, const std::string& group, AveragedQuantity& quantity) {
  const std::string path = group + "/" + quantity.name;
  const std::size_t points = quantity.summaries.size();
  PlainArray values{path + "/values",
                    {points == 0 ? 0 : quantity.values.size() / points, points},
                    quantity.unit,
                    "of each member, in the order of the seeds, at each point of the grid",
                    std::move(quantity.values),
                    {}};
  PlainArray summary{path + "/summary",
                     {points, summary_columns.size()},
                     quantity.unit,
                     "of the members at each point of the grid, in the columns of the attribute `columns`",
                     {},
                     {}};
  for (const Summary& point : quantity.summaries) {
    const std::array<double, 9> row = row_of(point);
    summary.values.insert(summary.values.end(), row.begin(), row.end());
  }
  content.arrays.push_back(std::move(values));
  content.texts.push_back({summary.path, "columns", {summary_columns.begin(), summary_columns.end()}, true});
  content.arrays.push_back(std::move(summary));
}

void add_curves(Content& content, const std::string& group, AveragedCurves& curves, const std::string& angle,
                const std::string& definition) {
  content.arrays.push_back(
      {group + "/" + angle, {curves.angles.size()}, "deg", definition, curves.angles, {}});
  for (AveragedQuantity& quantity : curves.quantities) add_quantity(content, group, quantity);
}

/// Lists at the points of a grid of `points` angles, those that no member reached without values.
void add_lists(Content& content, const std::string& group, const std::vector<AveragedList>& lists,
               std::size_t points) {
  for (const AveragedList& list : lists) {
    const auto add = [&](const char* name, const std::string& unit, const std::string& definition,
                         std::vector<double> values, double missing) {
      values.resize(points * list.width, missing);
      content.arrays.push_back({fmt::format("{}/{}/{}", group, list.name, name),
                                {points, list.width},
                                unit,
                                definition,
                                std::move(values),
                                {}});
    };
    add("n", "1", "members behind each number", list.count, 0.0);
    add("mean", list.unit, "mean over the members of: " + list.definition, list.mean, std::nan(""));
    add("deviation", list.unit, "standard deviation; that of the mean is deviation / sqrt(n)",
        deviation_of(list), std::nan(""));
  }
}

void add_bins(Content& content, const std::string& group, const std::vector<NamedList>& bins) {
  for (const NamedList& each : bins)
    content.arrays.push_back(
        {fmt::format("{}/{}", group, each.name), {each.width}, each.unit, each.definition, each.values, {}});
}

void add_correlations(Content& content, const std::string& group, const AngleCorrelations& correlations) {
  const std::size_t size = correlations.names.size();
  PlainArray coefficient{group + "/coefficient",
                         {size, size},
                         "1",
                         "Pearson's coefficient of correlation of two angles over the members that have both",
                         {},
                         {}};
  PlainArray count{group + "/n", {size, size}, "1", "members that have both", {}, {}};
  for (const Correlation& pair : correlations.pairs) {
    coefficient.values.push_back(pair.coefficient);
    count.values.push_back(pair.count);
  }
  content.texts.push_back({group, "angles", correlations.names, true});
  content.arrays.push_back(std::move(coefficient));
  content.arrays.push_back(std::move(count));
}

void add_variant(Content& content, const std::string& group, NamedAverages& variant) {
  Averages& averages = variant.averages;
  content.texts.push_back({group, "name", {variant.name}, false});
  content.texts.push_back({group, "scenario", {variant.scenario}, false});
  content.arrays.push_back({group + "/seed",
                            {averages.seeds.size()},
                            "1",
                            "of the members that are done, ascending",
                            {},
                            averages.seeds});
  content.arrays.push_back({group + "/state_hash",
                            {averages.seeds.size()},
                            "1",
                            "of the last state of each member; members.csv has it in hexadecimal digits",
                            {},
                            {}});
  for (const std::string& hash : averages.state_hashes)
    content.arrays.back().integers.push_back(parse_hash(hash));
  for (AveragedQuantity& quantity : averages.numbers) add_quantity(content, group + "/numbers", quantity);
  add_correlations(content, group + "/correlations", averages.correlations);
  add_curves(content, group + "/over_tilt", averages.over_tilt, "theta", "tilt");
  add_lists(content, group + "/over_tilt", variant.lists.over_tilt, averages.over_tilt.angles.size());
  if (!averages.before_failure.quantities.empty()) {
    add_curves(content, group + "/before_failure", averages.before_failure, "angle_left",
               "theta_c - theta, theta_c that of each member");
    add_lists(content, group + "/before_failure", variant.lists.before_failure,
              averages.before_failure.angles.size());
  }
  add_bins(content, group + "/bins", variant.lists.bins);
}

std::string csv_number(double value) { return std::isnan(value) ? "" : fmt::format("{:.7g}", value); }

/// Rows of a quantity; `angles` is empty for numbers that there is one of in a run.
std::string csv_rows(const std::string& variant, const char* grid, const std::vector<double>& angles,
                     const AveragedQuantity& quantity) {
  std::string text;
  for (std::size_t point = 0; point < quantity.summaries.size(); ++point) {
    if (quantity.summaries[point].statistics.count == 0) continue;
    text += fmt::format("{},{},{},{},{}", variant, grid, angles.empty() ? "" : csv_number(angles[point]),
                        quantity.name, quantity.unit);
    for (const double value : row_of(quantity.summaries[point])) text.append(",").append(csv_number(value));
    text += "\n";
  }
  return text;
}

}  // namespace

void write_averages(const std::string& path, std::vector<NamedAverages> variants,
                    const std::string& version) {
  Content content;
  content.texts.push_back({"/", "version", {version}, false});
  for (std::size_t v = 0; v < variants.size(); ++v)
    add_variant(content, fmt::format("/variants/{}", v), variants[v]);
  write_plain_file(path, content.arrays, content.texts);
}

std::string averages_csv(const std::vector<NamedAverages>& variants) {
  std::string text = "variant,grid,angle (deg),quantity,unit," + joined(summary_columns, ",") + "\n";
  for (const NamedAverages& variant : variants) {
    const std::string name = csv_quoted(variant.name);
    const Averages& averages = variant.averages;
    for (const AveragedQuantity& quantity : averages.numbers) text += csv_rows(name, "run", {}, quantity);
    for (const AveragedQuantity& quantity : averages.over_tilt.quantities)
      text += csv_rows(name, "over_tilt", averages.over_tilt.angles, quantity);
    for (const AveragedQuantity& quantity : averages.before_failure.quantities)
      text += csv_rows(name, "before_failure", averages.before_failure.angles, quantity);
  }
  return text;
}

}  // namespace talus
