#include "ensemble/averages.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace talus::ensemble {
namespace {

constexpr double same_angle = 1e-6;  // deg, far below the spacing of frames

void summarise(AveragedQuantity& quantity, std::size_t points) {
  for (std::size_t point = 0; point < points; ++point) {
    std::vector<double> values;
    for (std::size_t k = point; k < quantity.values.size(); k += points) values.push_back(quantity.values[k]);
    quantity.summaries.push_back(summary_of(values));
  }
}

/// Collects the names of all quantities, in order of first appearance. Members of different versions may have
/// different quantities.
template <typename Item, typename ItemsOf>
std::vector<AveragedQuantity> all_quantities(const std::vector<MemberResult>& members,
                                             const ItemsOf& items_of) {
  std::vector<AveragedQuantity> all;
  for (const MemberResult& member : members)
    for (const Item& item : items_of(member))
      if (std::ranges::find(all, item.name, &AveragedQuantity::name) == all.end())
        all.push_back({item.name, item.unit, {}, {}});
  return all;
}

std::vector<AveragedQuantity> averaged_numbers(const std::vector<MemberResult>& members) {
  auto all = all_quantities<NamedNumber>(
      members,
      [](const MemberResult& member) -> const std::vector<NamedNumber>& { return member.numbers.numbers; });
  for (AveragedQuantity& quantity : all) {
    for (const MemberResult& member : members)
      quantity.values.push_back(number_called(member.numbers, quantity.name));
    summarise(quantity, 1);
  }
  return all;
}

/// Averages the quantities of all members over a grid of angles. `tilt_at(member, angle)` returns the tilt of
/// a member (deg) at a point of the grid.
AveragedCurves averaged_curves(const std::vector<MemberResult>& members, std::vector<double> angles,
                               const std::function<double(const MemberResult&, double)>& tilt_at) {
  AveragedCurves curves{std::move(angles), {}};
  curves.quantities = all_quantities<NamedSeries>(
      members,
      [](const MemberResult& member) -> const std::vector<NamedSeries>& { return member.series.series; });
  const std::size_t points = curves.angles.size();
  for (AveragedQuantity& quantity : curves.quantities) {
    quantity.values.assign(members.size() * points, std::nan(""));
    for (std::size_t m = 0; m < members.size(); ++m) {
      const MemberResult& member = members[m];
      const auto series = std::ranges::find(member.series.series, quantity.name, &NamedSeries::name);
      if (series != member.series.series.end())
        for (std::size_t point = 0; point < points; ++point)
          quantity.values[m * points + point] =
              interpolated(member.series.theta, series->values, tilt_at(member, curves.angles[point]));
    }
    summarise(quantity, points);
  }
  return curves;
}

double theta_c_of(const MemberResult& member) { return number_called(member.numbers, "theta_c"); }

AveragedCurves averages_over_tilt(const std::vector<MemberResult>& members, double spacing) {
  double largest = -spacing;
  for (const MemberResult& member : members)
    if (!member.series.theta.empty()) largest = std::max(largest, member.series.theta.back());
  return averaged_curves(members, grid_up_to(largest, spacing),
                         [](const MemberResult&, double angle) { return angle; });
}

AveragedCurves averages_before_failure(const std::vector<MemberResult>& members, double spacing) {
  double largest = -1.0;
  for (const MemberResult& member : members)
    if (const double theta_c = theta_c_of(member); !std::isnan(theta_c)) largest = std::max(largest, theta_c);
  if (largest < 0.0) return {};
  return averaged_curves(members, grid_up_to(largest, spacing),
                         [](const MemberResult& member, double angle) { return theta_c_of(member) - angle; });
}

/// Whether a number is the angle of an event, rather than the width of a range or an error.
bool is_event(const std::string& name) {
  if (name == "theta_c" || name == "first_slide" || name == "theta_r") return true;
  return name.starts_with("theta_d/") && name.find("_error") == std::string::npos &&
         name.find("_low") == std::string::npos && name.find("_high") == std::string::npos &&
         name.find("_size") == std::string::npos;
}

AngleCorrelations correlations_of(const std::vector<AveragedQuantity>& numbers) {
  std::vector<std::vector<double>> angles;
  AngleCorrelations found;
  for (const AveragedQuantity& quantity : numbers) {
    if (!is_event(quantity.name)) continue;
    found.names.push_back(quantity.name);
    angles.push_back(quantity.values);
  }
  for (const std::vector<double>& left : angles)
    for (const std::vector<double>& right : angles) found.pairs.push_back(correlation_of(left, right));
  return found;
}

}  // namespace

std::vector<double> grid_up_to(double largest, double spacing) {
  std::vector<double> angles;
  for (int k = 0; k * spacing <= largest + same_angle; ++k) angles.push_back(k * spacing);
  return angles;
}

double interpolated(const std::vector<double>& tilts, const std::vector<double>& values, double theta) {
  const auto upper = std::ranges::lower_bound(tilts, theta - same_angle);
  if (upper == tilts.end() || std::isnan(theta)) return std::nan("");
  const auto k = static_cast<std::size_t>(upper - tilts.begin());
  if (*upper <= theta + same_angle) return values[k];
  if (k == 0) return std::nan("");
  const double share = (theta - tilts[k - 1]) / (tilts[k] - tilts[k - 1]);
  return values[k - 1] + share * (values[k] - values[k - 1]);
}

Averages averages_of(const std::vector<MemberResult>& members, double frame_every) {
  Averages averages;
  for (const MemberResult& member : members) {
    averages.seeds.push_back(member.seed);
    averages.state_hashes.push_back(member.numbers.state_hash);
  }
  averages.numbers = averaged_numbers(members);
  averages.correlations = correlations_of(averages.numbers);
  averages.over_tilt = averages_over_tilt(members, frame_every);
  averages.before_failure = averages_before_failure(members, frame_every);
  return averages;
}

}  // namespace talus::ensemble
