#include "ensemble/averages_reader.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "analysis/quantities.h"
#include "base/errors.h"
#include "base/hash.h"
#include "core/trigonometry.h"
#include "io/hdf5_reader.h"
#include "io/seal.h"
#include "runs/analysis_parameters.h"

namespace talus::ensemble {
namespace {

constexpr double same_theta = 1e-6;  // deg

/// Reads a data set of doubles; unknown values are NaN.
std::vector<double> numbers_at(io::hdf5::Reader& file, const std::string& path, const std::string& shape) {
  std::vector<double> values = file.read<double>(
      io::DataSetField{path, io::ElementType::float64, shape, {}, {}}, io::hdf5::any_number);
  if (std::ranges::any_of(values, [](double value) { return std::isinf(value); }))
    file.refuse(path, "holds an infinite value");
  return values;
}

std::vector<std::uint64_t> integers_at(io::hdf5::Reader& file, const std::string& path) {
  return file.read<std::uint64_t>(io::DataSetField{path, io::ElementType::uint64, "S", {}, {}});
}

/// Reads a grid; empty if the file has none.
std::vector<double> grid_at(io::hdf5::Reader& file, const std::string& path) {
  if (!file.has(path)) return {};
  std::vector<double> grid = file.read<double>(io::DataSetField{path, io::ElementType::float64, "P", {}, {}});
  if (std::ranges::adjacent_find(grid, std::greater_equal<>()) != grid.end())
    file.refuse(path, "is not in ascending order");
  return grid;
}

/// Reads all quantities of a group, each with this number of members and points.
std::vector<StoredQuantity> quantities_at(io::hdf5::Reader& file, const std::string& group,
                                          std::size_t members, std::size_t points) {
  constexpr std::string_view ending = "/values";
  std::vector<StoredQuantity> found;
  if (!file.has(group)) return found;
  for (const std::string& path : file.data_sets(group)) {
    if (!path.ends_with(ending)) continue;
    const std::size_t begin = group.size() + 1;
    found.push_back({path.substr(begin, path.size() - ending.size() - begin), file.attribute(path, "unit"),
                     numbers_at(file, path, fmt::format("{} {}", members, points))});
  }
  return found;
}

StoredVariant variant_at(io::hdf5::Reader file, const std::string& group) {
  StoredVariant variant;
  variant.name = file.attribute(group, "name");
  variant.scenario = file.attribute(group, "scenario");
  variant.seeds = integers_at(file, group + "/seed");
  for (const std::uint64_t hash : integers_at(file, group + "/state_hash"))
    variant.state_hashes.push_back(hash_text(hash));
  const std::size_t members = variant.seeds.size();
  if (members == 0) return variant;  // no member is done yet
  variant.numbers = quantities_at(file, group + "/numbers", members, 1);
  variant.tilts = grid_at(file, group + "/over_tilt/theta");
  variant.over_tilt = quantities_at(file, group + "/over_tilt", members, variant.tilts.size());
  io::hdf5::Reader again = file.again();  // the other grid may have any number of points
  variant.angles_left = grid_at(again, group + "/before_failure/angle_left");
  variant.before_failure =
      quantities_at(again, group + "/before_failure", members, variant.angles_left.size());
  return variant;
}

/// A point at which a member has values, and the grid to which it belongs.
struct Point {
  double theta = 0.0;
  bool before_failure = false;
  std::size_t index = 0;
};

/// Adds the points of one grid at which member m has any value. `theta_at(k)` is the tilt of point k.
template <typename ThetaAt>
void add_points(std::vector<Point>& points, const std::vector<StoredQuantity>& quantities, std::size_t m,
                std::size_t count, bool before_failure, const ThetaAt& theta_at) {
  for (std::size_t k = 0; k < count; ++k) {
    const bool known = std::ranges::any_of(quantities, [&](const StoredQuantity& quantity) {
      return !std::isnan(quantity.values[m * count + k]);
    });
    if (known) points.push_back({theta_at(k), before_failure, k});
  }
}

/// Returns the points of both grids by ascending tilt, each tilt once.
std::vector<Point> points_of(const StoredVariant& variant, std::size_t m, double theta_c) {
  std::vector<Point> points;
  add_points(points, variant.over_tilt, m, variant.tilts.size(), false,
             [&](std::size_t k) { return variant.tilts[k]; });
  if (!std::isnan(theta_c))
    add_points(points, variant.before_failure, m, variant.angles_left.size(), true,
               [&](std::size_t k) { return theta_c - variant.angles_left[k]; });
  std::ranges::stable_sort(points, {}, &Point::theta);
  const auto same = [](const Point& left, const Point& right) {
    return right.theta - left.theta < same_theta;
  };
  points.erase(std::unique(points.begin(), points.end(), same), points.end());
  return points;
}

const StoredQuantity* find_quantity(const std::vector<StoredQuantity>& quantities, const std::string& name) {
  const auto found = std::ranges::find(quantities, name, &StoredQuantity::name);
  return found == quantities.end() ? nullptr : &*found;
}

std::size_t count_thresholds(const MemberNumbers& numbers) {
  const std::string& factor = analysis::quantity_of(&analysis::RunThreshold::factor).name;
  std::size_t count = 0;
  while (!std::isnan(number_called(numbers, element_name(factor, count)))) ++count;
  return count;
}

void set_number_of_run(const analysis::Quantity& quantity, const MemberNumbers& numbers, double mean_diameter,
                       analysis::Analysis& analysis) {
  auto values = std::get<std::vector<double>>(analysis::values_of(quantity, analysis));
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k] = analysis::unscaled(quantity.unit, number_called(numbers, element_name(quantity.name, k)),
                                   mean_diameter);
  if (!values.empty()) analysis::set_values(quantity, values, analysis);
}

void set_number_of_frames(const analysis::Quantity& quantity, const MemberSeries& series,
                          double mean_diameter, analysis::Analysis& analysis) {
  const std::size_t count = analysis::needs_threshold(quantity) ? analysis.thresholds.size() : 1;
  for (std::size_t f = 0; f < count; ++f) {
    const auto found = std::ranges::find(series.series, element_name(quantity.name, f), &NamedSeries::name);
    if (found == series.series.end()) continue;
    for (std::size_t k = 0; k < analysis.frames.size(); ++k)
      analysis::set_number(quantity, analysis::unscaled(quantity.unit, found->values[k], mean_diameter),
                           analysis.frames[k], f);
  }
}

}  // namespace

bool holds_averages(const std::string& path) { return io::begins_with(path, io::averages_seal); }

std::vector<StoredVariant> read_averages(const std::string& path) {
  io::verify_seal(path, io::averages_seal);
  const io::hdf5::Reader file = io::hdf5::Reader::from_file(path);
  std::vector<StoredVariant> variants;
  for (std::string group = "/variants/0"; variants.empty() || file.has(group);
       group = fmt::format("/variants/{}", variants.size()))
    variants.push_back(variant_at(file.again(), group));
  return variants;
}

MemberResult member_of(const StoredVariant& variant, std::size_t m) {
  MemberResult member{variant.seeds[m], {variant.state_hashes[m], "", 0.0, {}}, {}};
  for (const StoredQuantity& quantity : variant.numbers)
    member.numbers.numbers.push_back({quantity.name, quantity.unit, quantity.values[m]});
  const std::vector<Point> points = points_of(variant, m, number_called(member.numbers, "theta_c"));
  for (const Point& point : points) member.series.theta.push_back(point.theta);
  for (const StoredQuantity& quantity : variant.over_tilt) {
    NamedSeries series{quantity.name, quantity.unit, {}};
    const StoredQuantity* const before_failure = find_quantity(variant.before_failure, quantity.name);
    for (const Point& point : points)
      if (!point.before_failure)
        series.values.push_back(quantity.values[m * variant.tilts.size() + point.index]);
      else if (before_failure != nullptr)
        series.values.push_back(before_failure->values[m * variant.angles_left.size() + point.index]);
      else
        series.values.push_back(std::nan(""));
    member.series.series.push_back(std::move(series));
  }
  return member;
}

analysis::Analysis analysis_of(const MemberResult& member, double mean_diameter) {
  analysis::Analysis analysis;
  analysis.parameters = runs::as_facts(analysis::AnalysisParameters{});
  analysis.thresholds.resize(count_thresholds(member.numbers));
  for (const double theta : member.series.theta) {
    analysis::FrameRecord& frame = analysis.frames.emplace_back();
    frame.tilt = radians(theta);
    frame.thresholds.resize(analysis.thresholds.size());
  }
  for (const analysis::Quantity& quantity : analysis::quantities()) {
    if (analysis::is_number_of_run(quantity))
      set_number_of_run(quantity, member.numbers, mean_diameter, analysis);
    if (analysis::is_number_of_frame(quantity))
      set_number_of_frames(quantity, member.series, mean_diameter, analysis);
  }
  return analysis;
}

runs::RunView view_of_values(const std::string& path, const StoredVariant& variant, std::size_t m) {
  const MemberResult member = member_of(variant, m);
  runs::RunView run;
  run.path =
      fmt::format("{}#{}{}seed-{}", path, variant.name, variant.name.empty() ? "" : "/", variant.seeds[m]);
  run.scenario = scenario::parse_scenario(variant.scenario, run.path);
  run.scenario.seed = member.seed;
  run.scenario_text = variant.scenario;
  run.state_hash = member.numbers.state_hash;
  run.statics.mean_diameter = run.scenario.grains.mean_diameter;
  run.analysis = analysis_of(member, run.statics.mean_diameter);
  run.theta_r = radians(number_called(member.numbers, "theta_r"));
  return run;
}

}  // namespace talus::ensemble
