#include "ensemble/averages_reader.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <iterator>

#include "analysis/quantities.h"
#include "core/errors.h"
#include "core/hash.h"
#include "core/trigonometry.h"
#include "io/plain_file.h"
#include "io/signature.h"
#include "runs/analysis_parameters.h"

namespace talus {
namespace {

constexpr double same_theta = 1e-6;  // deg

/// What is in the file, and how it is called in messages.
struct Source {
  std::string path;
  PlainFile file;
};

[[noreturn]] void refuse(const Source& source, const std::string& problem) {
  throw Error(ExitCode::bad_data,
              fmt::format("{}: {}; expected a run, or the ensemble.h5 of an ensemble, which talus ensemble "
                          "average makes again",
                          source.path, problem));
}

const PlainArray* find_array(const Source& source, const std::string& item) {
  const auto found = std::ranges::find(source.file.arrays, item, &PlainArray::path);
  return found == source.file.arrays.end() ? nullptr : &*found;
}

const std::vector<std::string>& texts_at(const Source& source, const std::string& item,
                                         const std::string& name) {
  for (const PlainTexts& texts : source.file.texts)
    if (texts.path == item && texts.name == name) return texts.texts;
  refuse(source, fmt::format("it has no {} of {}", name, item));
}

std::vector<double> grid_at(const Source& source, const std::string& item) {
  const PlainArray* const grid = find_array(source, item);
  if (grid == nullptr) return {};
  const bool ascending =
      std::ranges::adjacent_find(grid->values, std::greater_equal<>()) == grid->values.end();
  if (!ascending || std::ranges::any_of(grid->values, [](double angle) { return !std::isfinite(angle); }))
    refuse(source, item + " does not ascend");
  return grid->values;
}

/// All quantities of a group, each with so many members and points, taken out of the file.
std::vector<StoredQuantity> quantities_at(Source& source, const std::string& group, std::size_t members,
                                          std::size_t points) {
  constexpr std::string_view ending = "/values";
  std::vector<StoredQuantity> found;
  for (PlainArray& array : source.file.arrays) {
    if (!array.path.starts_with(group + "/") || !array.path.ends_with(ending)) continue;
    if (array.shape != std::vector<std::size_t>{members, points} || array.values.size() != members * points)
      refuse(source, array.path + " is of another size than its grid and the seeds");
    if (std::ranges::any_of(array.values, [](double value) { return std::isinf(value); }))
      refuse(source, array.path + " holds an infinite value");
    const std::size_t begin = group.size() + 1;
    found.push_back({array.path.substr(begin, array.path.size() - ending.size() - begin), array.unit,
                     std::move(array.values)});
  }
  return found;
}

StoredVariant variant_at(Source& source, const std::string& group) {
  StoredVariant variant;
  variant.name = texts_at(source, group, "name").front();
  variant.scenario = texts_at(source, group, "scenario").front();
  if (const PlainArray* const seeds = find_array(source, group + "/seed")) variant.seeds = seeds->integers;
  const std::size_t members = variant.seeds.size();
  if (members == 0) return variant;  // none is done yet
  if (const PlainArray* const hashes = find_array(source, group + "/state_hash"))
    std::ranges::transform(hashes->integers, std::back_inserter(variant.state_hashes), hash_text);
  else
    variant.state_hashes = texts_at(source, group, "state_hash");  // as files had them that came first
  if (variant.state_hashes.size() != members) refuse(source, group + " has not one hash for each seed");
  variant.numbers = quantities_at(source, group + "/numbers", members, 1);
  variant.tilts = grid_at(source, group + "/over_tilt/theta");
  variant.over_tilt = quantities_at(source, group + "/over_tilt", members, variant.tilts.size());
  variant.angles_left = grid_at(source, group + "/before_failure/angle_left");
  variant.before_failure =
      quantities_at(source, group + "/before_failure", members, variant.angles_left.size());
  return variant;
}

/// A point at which a member has values: which of which grid.
struct Point {
  double theta = 0.0;
  bool before_failure = false;
  std::size_t index = 0;
};

/// Adds the points of one grid at which member m has any value. `theta_at(k)`: the tilt of point k.
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

/// Those of both grids by ascending tilt, each tilt once.
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
  const std::string& factor = quantity_of(&RunThreshold::factor).name;
  std::size_t count = 0;
  while (!std::isnan(number_called(numbers, element_name(factor, count)))) ++count;
  return count;
}

void set_number_of_run(const Quantity& quantity, const MemberNumbers& numbers, double mean_diameter,
                       Analysis& analysis) {
  auto values = std::get<std::vector<double>>(values_of(quantity, analysis));
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k] =
        unscaled(quantity.unit, number_called(numbers, element_name(quantity.name, k)), mean_diameter);
  if (!values.empty()) set_values(quantity, values, analysis);
}

void set_number_of_frames(const Quantity& quantity, const MemberSeries& series, double mean_diameter,
                          Analysis& analysis) {
  const std::size_t count = needs_threshold(quantity) ? analysis.thresholds.size() : 1;
  for (std::size_t f = 0; f < count; ++f) {
    const auto found = std::ranges::find(series.series, element_name(quantity.name, f), &NamedSeries::name);
    if (found == series.series.end()) continue;
    for (std::size_t k = 0; k < analysis.frames.size(); ++k)
      set_number(quantity, unscaled(quantity.unit, found->values[k], mean_diameter), analysis.frames[k], f);
  }
}

}  // namespace

bool holds_averages(const std::string& path) {
  if (!begins_with(path, hdf5_signature)) return false;
  const PlainFile file = read_plain_file(path);
  return std::ranges::any_of(file.texts,
                             [](const PlainTexts& texts) { return texts.path.starts_with("/variants"); });
}

std::vector<StoredVariant> read_averages(const std::string& path) {
  Source source{path, read_plain_file(path)};
  std::vector<StoredVariant> variants;
  const auto is_there = [&](const std::string& group) {
    return std::ranges::find(source.file.texts, group, &PlainTexts::path) != source.file.texts.end();
  };
  for (std::string group = "/variants/0"; is_there(group);
       group = fmt::format("/variants/{}", variants.size()))
    variants.push_back(variant_at(source, group));
  if (variants.empty()) refuse(source, "it has no /variants/0");
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

Analysis analysis_of(const MemberResult& member, double mean_diameter) {
  Analysis analysis;
  analysis.parameters = as_facts(AnalysisParameters{});
  analysis.thresholds.resize(count_thresholds(member.numbers));
  for (const double theta : member.series.theta) {
    FrameRecord& frame = analysis.frames.emplace_back();
    frame.tilt = radians(theta);
    frame.thresholds.resize(analysis.thresholds.size());
  }
  for (const Quantity& quantity : quantities()) {
    if (is_number_of_run(quantity)) set_number_of_run(quantity, member.numbers, mean_diameter, analysis);
    if (is_number_of_frame(quantity)) set_number_of_frames(quantity, member.series, mean_diameter, analysis);
  }
  return analysis;
}

RunView view_of_values(const std::string& path, const StoredVariant& variant, std::size_t m) {
  const MemberResult member = member_of(variant, m);
  RunView run;
  run.path =
      fmt::format("{}#{}{}seed-{}", path, variant.name, variant.name.empty() ? "" : "/", variant.seeds[m]);
  run.scenario = parse_scenario(variant.scenario, run.path);
  run.scenario.seed = member.seed;
  run.scenario_text = variant.scenario;
  run.state_hash = member.numbers.state_hash;
  run.statics.mean_diameter = run.scenario.grains.mean_diameter;
  run.analysis = analysis_of(member, run.statics.mean_diameter);
  run.theta_r = radians(number_called(member.numbers, "theta_r"));
  return run;
}

}  // namespace talus
