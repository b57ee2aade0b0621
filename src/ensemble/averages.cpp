#include "ensemble/averages.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "analysis/failure/transition.h"
#include "analysis/quantities.h"
#include "core/trigonometry.h"

namespace talus::ensemble {
namespace {

using analysis::Quantity;

constexpr double same_angle = 1e-6;  // deg, far below the spacing of frames

/// The way of a member to failure: the frames of its last rise up to theta_c, or all of a slope that has not
/// failed. Of frames at one held tilt the first counts.
struct Course {
  double diameter = 1.0;  ///< m
  double theta_c = 0.0;   ///< deg; NaN if the slope has not failed
  bool mirrored_slope = false;
  std::vector<const analysis::FrameRecord*> frames;
  std::vector<double> tilts;              ///< deg, ascending
  std::vector<std::vector<double>> bins;  ///< edges and centres of the bins of lists
};

Course course_of(const MemberResult& member) {
  const analysis::Analysis& analysis = member.analysis;
  const analysis::FramesOfRise rise = analysis::last_rise(analysis.frames);
  Course course{
      member.mean_diameter, number_called(member.numbers, "theta_c"), rise.mirrored_slope, {}, {}, {}};
  for (const analysis::FrameRecord* frame : rise.frames)
    if (!(std::abs(frame->tilt) > analysis.theta_c) &&
        (course.frames.empty() || std::abs(frame->tilt) > std::abs(course.frames.back()->tilt))) {
      course.frames.push_back(frame);
      course.tilts.push_back(degrees(std::abs(frame->tilt)));
    }
  for (const Quantity& quantity : analysis::quantities())
    if (analysis::is_list_of_run(quantity))
      course.bins.push_back(std::get<std::vector<double>>(analysis::values_of(quantity, analysis)));
  return course;
}

/// Returns the values of a quantity in all frames, an equal number for each, in the units of tables.
std::vector<double> series_of(const Course& course, const Quantity& quantity, std::size_t f) {
  std::vector<double> values;
  for (const analysis::FrameRecord* frame : course.frames)
    if (analysis::is_number_of_frame(quantity)) {
      values.push_back(analysis::number_on_one_side(quantity, *frame, f, course.mirrored_slope));
    } else {
      const std::vector<double> list = analysis::list_of(quantity, *frame, f);
      values.insert(values.end(), list.begin(), list.end());
    }
  for (double& value : values) value = analysis::scaled(quantity.unit, value, course.diameter);
  return values;
}

/// The values of all members at the points of a grid. `tilt_at` returns that of a member (deg) at an angle.
struct Grid {
  const std::vector<Course>& courses;
  const std::vector<double>& angles;  ///< deg
  std::function<double(const Course&, double)> tilt_at;
};

/// Averages a quantity, at threshold f if it depends on one. It has no width if no member has it.
AveragedQuantity average(const Grid& grid, const Quantity& quantity, std::size_t f) {
  const auto& [courses, angles, tilt_at] = grid;
  AveragedQuantity found{element_name(quantity.name, f), analysis::scaled_unit(quantity.unit),
                         quantity.definition, !analysis::is_number_of_frame(quantity), 0};
  std::vector<std::vector<double>> values;  // of the members, for each number at each point
  const Course* first = nullptr;
  for (const Course& course : courses) {
    if (course.frames.empty()) continue;
    if (first == nullptr) first = &course;
    const std::vector<double> series = series_of(course, quantity, f);
    const std::size_t width = series.size() / course.frames.size();
    if (found.width == 0) values.resize(angles.size() * (found.width = width));
    if (width != found.width || (found.is_list && course.bins != first->bins)) continue;
    for (std::size_t k = 0; k < width; ++k) {
      std::vector<double> one;
      for (std::size_t at = k; at < series.size(); at += width) one.push_back(series[at]);
      for (std::size_t point = 0; point < angles.size(); ++point)
        values[point * width + k].push_back(interpolated(course.tilts, one, tilt_at(course, angles[point])));
    }
  }
  for (const std::vector<double>& of_members : values)
    found.summaries.push_back(found.is_list ? Summary{.statistics = statistics_of(of_members)}
                                            : summary_of(of_members));
  return found;
}

/// Averages the quantities of frames. Directions of axes are left out: they are defined only up to half a
/// turn and have no mean.
std::vector<AveragedQuantity> averaged_quantities(const Grid& grid, std::size_t thresholds) {
  std::vector<AveragedQuantity> all;
  for (const Quantity& quantity : analysis::quantities()) {
    const bool is_of_frame = analysis::is_number_of_frame(quantity) || analysis::is_list_of_frame(quantity);
    if (!is_of_frame || quantity.unit == "rad") continue;
    const std::size_t count = analysis::needs_threshold(quantity) ? thresholds : 1;
    for (std::size_t f = 0; f < count; ++f)
      if (AveragedQuantity found = average(grid, quantity, f); found.width > 0)
        all.push_back(std::move(found));
  }
  return all;
}

std::vector<AveragedQuantity> averaged_numbers(const std::vector<const MemberResult*>& members) {
  std::vector<std::string> names;
  for (const MemberResult* member : members) add_names(member->numbers, names);
  std::vector<AveragedQuantity> all;
  for (const std::string& name : names) {
    std::vector<double> values;
    for (const MemberResult* member : members) values.push_back(number_called(member->numbers, name));
    all.push_back(
        {.name = name, .unit = unit_of_number(name), .definition = {}, .summaries = {summary_of(values)}});
  }
  return all;
}

}  // namespace

double interpolated(const std::vector<double>& tilts, const std::vector<double>& values, double theta) {
  const auto upper = std::ranges::lower_bound(tilts, theta - same_angle);
  if (upper == tilts.end() || std::isnan(theta)) return std::nan("");
  const auto k = static_cast<std::size_t>(upper - tilts.begin());
  if (*upper <= theta + same_angle) return values[k];
  if (k == 0) return std::nan("");
  const double share = (theta - tilts[k - 1]) / (tilts[k] - tilts[k - 1]);
  return values[k - 1] + share * (values[k] - values[k - 1]);
}

VariantAverages averages_of(std::string name, std::string scenario, std::vector<const MemberResult*> members,
                            double frame_every) {
  VariantAverages averages{std::move(name), std::move(scenario), std::move(members), {}, {}, {}};
  averages.numbers = averaged_numbers(averages.members);
  std::vector<Course> courses;
  std::size_t thresholds = 0;
  double largest_tilt = -frame_every, largest_theta_c = -1.0;
  for (const MemberResult* member : averages.members) {
    const Course& course = courses.emplace_back(course_of(*member));
    thresholds = std::max(thresholds, member->analysis.thresholds.size());
    if (!course.tilts.empty()) largest_tilt = std::max(largest_tilt, course.tilts.back());
    if (!std::isnan(course.theta_c)) largest_theta_c = std::max(largest_theta_c, course.theta_c);
  }
  const auto curves = [&](double largest, const std::function<double(const Course&, double)>& tilt_at) {
    AveragedCurves found;
    for (int k = 0; k * frame_every <= largest + same_angle; ++k) found.angles.push_back(k * frame_every);
    found.quantities = averaged_quantities({courses, found.angles, tilt_at}, thresholds);
    return found;
  };
  averages.over_tilt = curves(largest_tilt, [](const Course&, double angle) { return angle; });
  if (largest_theta_c >= 0.0)
    averages.before_failure =
        curves(largest_theta_c, [](const Course& course, double angle) { return course.theta_c - angle; });
  return averages;
}

}  // namespace talus::ensemble
