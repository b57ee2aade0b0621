#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <iterator>
#include <span>

#include "analysis/quantities.h"
#include "base/hash.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "ensemble/averages.h"
#include "io/durable_file.h"
#include "io/hdf5_file.h"
#include "runs/analysis_parameters.h"

namespace talus::ensemble {
namespace {

using analysis::Quantity;
using Shape = std::vector<std::size_t>;

/// A column of a summary, in ensemble.h5 and in CSV.
struct SummaryColumn {
  const char* name;
  double (*value)(const Summary&);
};
constexpr std::array<SummaryColumn, 9> summary_columns = {{
    {"n", [](const Summary& of) { return static_cast<double>(of.statistics.count); }},
    {"mean", [](const Summary& of) { return of.statistics.mean; }},
    {"deviation", [](const Summary& of) { return of.statistics.deviation; }},
    {"error", [](const Summary& of) { return of.statistics.error; }},
    {"low", [](const Summary& of) { return of.low; }},
    {"high", [](const Summary& of) { return of.high; }},
    {"lower_quartile", [](const Summary& of) { return of.lower_quartile; }},
    {"median", [](const Summary& of) { return of.median; }},
    {"upper_quartile", [](const Summary& of) { return of.upper_quartile; }},
}};

/// Writes an array with the attributes `unit` and `definition`.
template <typename T>
void add(io::hdf5::Writer& file, const std::string& path, const Shape& shape, const std::string& unit,
         const std::string& definition, const std::vector<T>& values) {
  file.write(io::DataSetField{path, io::element_type<T>(), joined(shape, " "), unit, definition}, values);
  file.set_attribute(path, "definition", definition);
}

void add_summary(io::hdf5::Writer& file, const std::string& group, const AveragedQuantity& quantity) {
  const std::string path = fmt::format("{}/{}/summary", group, quantity.name);
  std::vector<double> rows;
  for (const Summary& point : quantity.summaries)
    for (const SummaryColumn& column : summary_columns) rows.push_back(column.value(point));
  add(file, path, {quantity.summaries.size(), summary_columns.size()}, quantity.unit,
      "statistics over the members at each point of the grid; the attribute `columns` names the columns",
      rows);
  file.set_attribute(path, "columns", names_of(summary_columns));
}

/// Writes the first columns of each number of a list.
void add_list(io::hdf5::Writer& file, const std::string& group, const AveragedQuantity& list) {
  const std::string definitions[] = {
      "number of members that contribute to each number", "mean over the members of: " + list.definition,
      "standard deviation; the standard error of the mean is deviation / sqrt(n)"};
  for (std::size_t c = 0; c < std::size(definitions); ++c) {
    const SummaryColumn& column = summary_columns[c];
    std::vector<double> values;
    for (const Summary& at : list.summaries) values.push_back(column.value(at));
    add(file, fmt::format("{}/{}/{}", group, list.name, column.name),
        {values.size() / list.width, list.width}, c == 0 ? "1" : list.unit, definitions[c], values);
  }
}

void add_curves(io::hdf5::Writer& file, const std::string& group, const AveragedCurves& curves,
                const std::string& angle, const std::string& definition) {
  add(file, group + "/" + angle, {curves.angles.size()}, "deg", definition, curves.angles);
  for (const AveragedQuantity& quantity : curves.quantities)
    (quantity.is_list ? add_list : add_summary)(file, group, quantity);
}

/// Whether a number is the angle of an event, rather than the width of a range or an error.
bool is_event(const std::string& name) {
  if (name == "theta_c" || name == "first_slide" || name == "theta_r") return true;
  return name.starts_with("theta_d/") && name.find("_error") == std::string::npos &&
         name.find("_low") == std::string::npos && name.find("_high") == std::string::npos &&
         name.find("_size") == std::string::npos;
}

/// Writes the scalar results of all members, and the correlations between the angles of events: theta_c,
/// first_slide, theta_r, and theta_d by each estimator.
void add_numbers(io::hdf5::Writer& file, const std::string& group, const VariantAverages& variant) {
  std::vector<std::string> names;
  std::vector<std::vector<double>> angles;
  for (const AveragedQuantity& quantity : variant.numbers) {
    std::vector<double> values;
    for (const MemberResult* member : variant.members)
      values.push_back(number_called(member->numbers, quantity.name));
    add(file, fmt::format("{}/numbers/{}/values", group, quantity.name), {values.size(), 1}, quantity.unit,
        "values of each member, in the order of the seeds", values);
    add_summary(file, group + "/numbers", quantity);
    if (!is_event(quantity.name)) continue;
    names.push_back(quantity.name);
    angles.push_back(std::move(values));
  }
  std::vector<double> coefficients, counts;
  for (const std::vector<double>& left : angles)
    for (const std::vector<double>& right : angles) {
      const Correlation found = correlation_of(left, right);
      coefficients.push_back(found.coefficient);
      counts.push_back(found.count);
    }
  const std::string correlations = group + "/correlations";
  if (!names.empty()) file.set_attribute(correlations, "angles", names);
  add(file, correlations + "/coefficient", {names.size(), names.size()}, "1",
      "Pearson's coefficient of correlation of two angles over the members that have both", coefficients);
  add(file, correlations + "/n", {names.size(), names.size()}, "1", "members that have both", counts);
}

/// Writes the analyses of all members one after the other, in the units of the table of quantities: scalars
/// of runs have a row for each member, and those of frames a row for each of its frames.
void add_analyses(io::hdf5::Writer& file, const std::string& group,
                  const std::vector<const MemberResult*>& members) {
  std::vector<std::uint64_t> frames;
  std::vector<double> tilts;
  std::size_t thresholds = 0;
  for (const MemberResult* member : members) {
    frames.push_back(member->analysis.frames.size());
    thresholds = std::max(thresholds, member->analysis.thresholds.size());
    for (const analysis::FrameRecord& frame : member->analysis.frames) tilts.push_back(frame.tilt);
  }
  add(file, group + "/frames", {members.size()}, "1", "number of frames of each member", frames);
  add(file, group + "/tilt", {tilts.size()}, "rad", "tilt of each frame, member by member", tilts);
  for (const Quantity& quantity : analysis::quantities()) {
    const bool is_of_run = analysis::is_number_of_run(quantity);
    if (!is_of_run && !analysis::is_number_of_frame(quantity)) continue;
    std::size_t width = analysis::needs_threshold(quantity) ? thresholds : quantity.shape == "2" ? 2 : 1;
    if (width == 0) continue;
    std::vector<double> values;
    for (const MemberResult* member : members)
      if (is_of_run)
        for (std::size_t k = 0; k < width; ++k)
          values.push_back(analysis::number_of(quantity, member->analysis, k));
      else
        for (const analysis::FrameRecord& frame : member->analysis.frames)
          for (std::size_t f = 0; f < width; ++f) values.push_back(analysis::number_of(quantity, frame, f));
    Shape shape = {values.size() / width};
    if (quantity.shape.find_first_of("F2") != std::string::npos) shape.push_back(width);
    add(file, fmt::format("{}/{}", group, quantity.name), shape, quantity.unit, quantity.definition, values);
  }
}

/// Writes the edges and centres of the bins of lists, which are those of the first member with frames.
void add_bins(io::hdf5::Writer& file, const std::string& group,
              const std::vector<const MemberResult*>& members) {
  const auto first = std::ranges::find_if(
      members, [](const MemberResult* member) { return !member->analysis.frames.empty(); });
  if (first == members.end()) return;
  for (const Quantity& quantity : analysis::quantities()) {
    if (!analysis::is_list_of_run(quantity)) continue;
    auto values = std::get<std::vector<double>>(analysis::values_of(quantity, (*first)->analysis));
    for (double& value : values) value = analysis::scaled(quantity.unit, value, (*first)->mean_diameter);
    if (!values.empty())
      add(file, fmt::format("{}/{}", group, quantity.name), {values.size()},
          analysis::scaled_unit(quantity.unit), quantity.definition, values);
  }
}

void add_variant(io::hdf5::Writer& file, const std::string& group, const VariantAverages& variant) {
  file.set_attribute(group, "name", variant.name);
  file.set_attribute(group, "scenario", variant.scenario);
  std::vector<std::uint64_t> seeds, hashes;
  for (const MemberResult* member : variant.members) {
    seeds.push_back(member->seed);
    hashes.push_back(parse_hash(member->numbers.state_hash));
  }
  add(file, group + "/seed", {seeds.size()}, "1", "seeds of the completed members, ascending", seeds);
  add(file, group + "/state_hash", {hashes.size()}, "1",
      "hash of the final state of each member; members.csv has it in hexadecimal digits", hashes);
  add_numbers(file, group, variant);
  add_curves(file, group + "/over_tilt", variant.over_tilt, "theta", "tilt");
  if (!variant.before_failure.quantities.empty())
    add_curves(file, group + "/before_failure", variant.before_failure, "angle_left",
               "theta_c - theta, with the theta_c of each member");
  add_bins(file, group + "/bins", variant.members);
  add_analyses(file, group + "/analysis", variant.members);
}

std::string csv_number(double value) { return std::isnan(value) ? "" : fmt::format("{:.7g}", value); }

/// Returns the CSV rows of a quantity; `angles` is empty for scalar results of a run.
std::string csv_rows(const std::string& variant, const char* grid, const std::vector<double>& angles,
                     const AveragedQuantity& quantity) {
  std::string text;
  if (quantity.is_list) return text;
  for (std::size_t point = 0; point < quantity.summaries.size(); ++point) {
    if (quantity.summaries[point].statistics.count == 0) continue;
    text += fmt::format("{},{},{},{},{}", variant, grid, angles.empty() ? "" : csv_number(angles[point]),
                        quantity.name, quantity.unit);
    for (const SummaryColumn& column : summary_columns)
      text.append(",").append(csv_number(column.value(quantity.summaries[point])));
    text += "\n";
  }
  return text;
}

/// Reads the arrays of a variant: M members, T frames of all of them, F thresholds.
struct VariantReader {
  io::hdf5::Reader file;
  std::string group;

  std::vector<std::uint64_t> integers(const std::string& name) {
    return file.read<std::uint64_t>(
        io::DataSetField{fmt::format("{}/{}", group, name), io::ElementType::uint64, "M", {}, {}});
  }
  /// Returns doubles, of which NaN are unknown; nothing if the file lacks them.
  std::vector<double> numbers(const std::string& name, const std::string& shape) {
    const std::string path = fmt::format("{}/{}", group, name);
    if (!file.has(path)) return {};
    std::vector<double> values = file.read<double>(
        io::DataSetField{path, io::ElementType::float64, shape, {}, {}}, io::hdf5::any_number);
    if (std::ranges::any_of(values, [](double value) { return std::isinf(value); }))
      file.refuse(path, "holds an infinite value");
    return values;
  }

  /// Creates the thresholds and frames of all members, without their values.
  void read_records(std::span<runs::RunView> runs) {
    const std::vector<double> factors =
        numbers("analysis/" + analysis::quantity_of(&analysis::RunThreshold::factor).name, "M F");
    const std::vector<std::uint64_t> frames = integers("analysis/frames");
    const std::vector<double> tilts = numbers("analysis/tilt", "T");
    const std::size_t width = factors.size() / runs.size();
    std::size_t next = 0;
    for (std::size_t m = 0; m < runs.size(); ++m) {
      analysis::Analysis& analysis = runs[m].analysis;
      for (const double factor : std::span(factors).subspan(m * width, width))
        if (!std::isnan(factor)) analysis.thresholds.emplace_back();
      if (frames[m] > tilts.size() - next)
        file.refuse(group + "/analysis/frames", "exceeds the number of tilts");
      for (const std::size_t end = next + frames[m]; next < end; ++next) {
        analysis.frames.push_back({.tilt = tilts[next]});
        analysis.frames.back().thresholds.resize(analysis.thresholds.size());
      }
    }
    if (next != tilts.size()) file.refuse(group + "/analysis/frames", "is less than the number of tilts");
  }

  void read_quantity(const Quantity& quantity, std::span<runs::RunView> runs) {
    const bool is_of_run = analysis::is_number_of_run(quantity);
    if (!is_of_run && !analysis::is_number_of_frame(quantity)) return;
    const std::string shape = !is_of_run               ? quantity.shape
                              : quantity.shape.empty() ? "M"
                                                       : "M " + quantity.shape;
    const std::vector<double> values = numbers("analysis/" + quantity.name, shape);
    std::size_t rows = 0, next = 0;
    for (const runs::RunView& run : runs) rows += is_of_run ? 1 : run.analysis.frames.size();
    if (values.empty()) return;
    const std::size_t width = values.size() / rows;
    for (runs::RunView& run : runs) {
      if (is_of_run) {  // a member that has not failed has no thresholds
        auto own = std::get<std::vector<double>>(analysis::values_of(quantity, run.analysis));
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(next), own.size(), own.begin());
        analysis::set_values(quantity, own, run.analysis);
        next += width;
      } else {
        for (analysis::FrameRecord& frame : run.analysis.frames)
          for (std::size_t f = 0; f < width; ++f) analysis::set_number(quantity, values[next++], frame, f);
      }
    }
  }
};

void read_variant(const std::string& path, VariantReader from, std::vector<runs::RunView>& all) {
  const std::vector<std::uint64_t> seeds = from.integers("seed"), hashes = from.integers("state_hash");
  if (seeds.empty()) return;  // no member is done yet
  const std::string name = from.file.attribute(from.group, "name");
  const std::string text = from.file.attribute(from.group, "scenario");
  const scenario::Scenario scenario = scenario::parse_scenario(text, fmt::format("{}#{}", path, name));
  const std::vector<double> theta_r = from.numbers("numbers/theta_r/values", "M 1");
  std::vector<runs::RunView> runs(seeds.size());
  for (std::size_t m = 0; m < runs.size(); ++m) {
    runs[m].path = fmt::format("{}#{}{}seed-{}", path, name, name.empty() ? "" : "/", seeds[m]);
    runs[m].scenario = scenario;
    runs[m].scenario.seed = seeds[m];
    runs[m].scenario_text = text;
    runs[m].statics.mean_diameter = scenario.grains.mean_diameter;
    runs[m].analysis.parameters = runs::as_facts(analysis::AnalysisParameters{});  // members have no others
    runs[m].state_hash = hash_text(hashes[m]);
    if (!theta_r.empty()) runs[m].theta_r = radians(theta_r[m]);
  }
  from.read_records(runs);
  for (const Quantity& quantity : analysis::quantities()) from.read_quantity(quantity, runs);
  std::ranges::move(runs, std::back_inserter(all));
}

}  // namespace

std::string averages_csv(const std::vector<VariantAverages>& variants) {
  std::string text =
      "variant,grid,angle (deg),quantity,unit," + joined(names_of(summary_columns), ",") + "\n";
  for (const VariantAverages& variant : variants) {
    const std::string name = csv_quoted(variant.name);
    for (const AveragedQuantity& quantity : variant.numbers) text += csv_rows(name, "run", {}, quantity);
    for (const AveragedQuantity& quantity : variant.over_tilt.quantities)
      text += csv_rows(name, "over_tilt", variant.over_tilt.angles, quantity);
    for (const AveragedQuantity& quantity : variant.before_failure.quantities)
      text += csv_rows(name, "before_failure", variant.before_failure.angles, quantity);
  }
  return text;
}

void write_averages(const std::string& path, const std::vector<VariantAverages>& variants,
                    const std::string& version) {
  io::hdf5::Writer file({}, io::seal_size);
  file.set_attribute("/", "version", version);
  for (std::size_t v = 0; v < variants.size(); ++v)
    add_variant(file, fmt::format("/variants/{}", v), variants[v]);
  io::write_durably(path, io::sealed(file.image(), io::averages_seal));
}

std::vector<runs::RunView> read_averages(const std::string& path) {
  io::verify_seal(path, io::averages_seal);
  const io::hdf5::Reader file = io::hdf5::Reader::from_file(path);
  std::vector<runs::RunView> runs;
  std::string group = "/variants/0";
  for (int v = 1; v == 1 || file.has(group); group = fmt::format("/variants/{}", v++))
    read_variant(path, {file.again(), group}, runs);
  return runs;
}

}  // namespace talus::ensemble
