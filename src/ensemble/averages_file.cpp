#include "ensemble/averages_file.h"

#include <array>
#include <cmath>
#include <fmt/core.h>

#include "base/hash.h"
#include "base/text.h"
#include "io/durable_file.h"
#include "io/hdf5_writer.h"
#include "io/seal.h"

namespace talus::ensemble {
namespace {

/// The columns of a summary, in ensemble.h5 and in CSV.
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

/// Writes an array of one or two dimensions with the attributes `unit` and `definition`. Arrays of two
/// dimensions are compressed in chunks of rows (the letter S of a shape).
template <typename T>
void add(io::hdf5::Writer& file, const std::string& path, const std::vector<std::size_t>& shape,
         const std::string& unit, const std::string& definition, const std::vector<T>& values) {
  const io::ElementType type = std::is_same_v<T, double> ? io::ElementType::float64 : io::ElementType::uint64;
  const char* chunks = shape.size() > 1 ? "S+" : "";
  file.write(io::DataSetField{path, type, chunks + joined(shape, " "), unit, definition}, values);
  file.set_attribute(path, "definition", definition);
}

/// Writes a quantity, and moves its values out of it to free memory.
void add_quantity(io::hdf5::Writer& file, const std::string& group, AveragedQuantity& quantity) {
  const std::string path = group + "/" + quantity.name;
  const std::size_t points = quantity.summaries.size();
  const std::vector<double> values = std::move(quantity.values);
  add(file, path + "/values", {points == 0 ? 0 : values.size() / points, points}, quantity.unit,
      "values of each member, in the order of the seeds, at each point of the grid", values);
  std::vector<double> rows;
  for (const Summary& point : quantity.summaries) {
    const std::array<double, 9> row = row_of(point);
    rows.insert(rows.end(), row.begin(), row.end());
  }
  add(file, path + "/summary", {points, summary_columns.size()}, quantity.unit,
      "statistics over the members at each point of the grid; the attribute `columns` names the columns",
      rows);
  file.set_attribute(path + "/summary", "columns",
                     std::vector<std::string>(summary_columns.begin(), summary_columns.end()));
}

void add_curves(io::hdf5::Writer& file, const std::string& group, AveragedCurves& curves,
                const std::string& angle, const std::string& definition) {
  add(file, group + "/" + angle, {curves.angles.size()}, "deg", definition, curves.angles);
  for (AveragedQuantity& quantity : curves.quantities) add_quantity(file, group, quantity);
}

/// Writes lists at a grid of `points` angles; angles that no member reached have no values.
void add_lists(io::hdf5::Writer& file, const std::string& group, const std::vector<AveragedList>& lists,
               std::size_t points) {
  for (const AveragedList& list : lists) {
    const auto add_one = [&](const char* name, const std::string& unit, const std::string& definition,
                             std::vector<double> values, double missing) {
      values.resize(points * list.width, missing);
      add(file, fmt::format("{}/{}/{}", group, list.name, name), {points, list.width}, unit, definition,
          values);
    };
    add_one("n", "1", "number of members that contribute to each number", list.count, 0.0);
    add_one("mean", list.unit, "mean over the members of: " + list.definition, list.mean, std::nan(""));
    add_one("deviation", list.unit,
            "standard deviation; the standard error of the mean is deviation / sqrt(n)", deviation_of(list),
            std::nan(""));
  }
}

void add_correlations(io::hdf5::Writer& file, const std::string& group,
                      const AngleCorrelations& correlations) {
  const std::size_t size = correlations.names.size();
  std::vector<double> coefficients, counts;
  for (const Correlation& pair : correlations.pairs) {
    coefficients.push_back(pair.coefficient);
    counts.push_back(pair.count);
  }
  if (size > 0) file.set_attribute(group, "angles", correlations.names);
  add(file, group + "/coefficient", {size, size}, "1",
      "Pearson's coefficient of correlation of two angles over the members that have both", coefficients);
  add(file, group + "/n", {size, size}, "1", "members that have both", counts);
}

void add_variant(io::hdf5::Writer& file, const std::string& group, NamedAverages& variant) {
  Averages& averages = variant.averages;
  file.set_attribute(group, "name", variant.name);
  file.set_attribute(group, "scenario", variant.scenario);
  const std::vector<std::size_t> members = {averages.seeds.size()};
  std::vector<std::uint64_t> hashes;
  for (const std::string& hash : averages.state_hashes) hashes.push_back(parse_hash(hash));
  add(file, group + "/seed", members, "1", "seeds of the completed members, ascending", averages.seeds);
  add(file, group + "/state_hash", members, "1",
      "hash of the final state of each member; members.csv has it in hexadecimal digits", hashes);
  for (AveragedQuantity& quantity : averages.numbers) add_quantity(file, group + "/numbers", quantity);
  add_correlations(file, group + "/correlations", averages.correlations);
  add_curves(file, group + "/over_tilt", averages.over_tilt, "theta", "tilt");
  add_lists(file, group + "/over_tilt", variant.lists.over_tilt, averages.over_tilt.angles.size());
  if (!averages.before_failure.quantities.empty()) {
    add_curves(file, group + "/before_failure", averages.before_failure, "angle_left",
               "theta_c - theta, with the theta_c of each member");
    add_lists(file, group + "/before_failure", variant.lists.before_failure,
              averages.before_failure.angles.size());
  }
  for (const NamedList& bins : variant.lists.bins)
    add(file, fmt::format("{}/bins/{}", group, bins.name), {bins.width}, bins.unit, bins.definition,
        bins.values);
}

std::string csv_number(double value) { return std::isnan(value) ? "" : fmt::format("{:.7g}", value); }

/// Returns the CSV rows of a quantity; `angles` is empty for scalar results of a run.
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
  io::hdf5::Writer file({{'S', 0}}, io::seal_size);
  file.set_attribute("/", "version", version);
  for (std::size_t v = 0; v < variants.size(); ++v)
    add_variant(file, fmt::format("/variants/{}", v), variants[v]);
  std::vector<std::byte> bytes = file.image();
  io::seal(bytes, io::averages_seal);
  io::write_durably(path, bytes);
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

}  // namespace talus::ensemble
