#include "analysis/deformation/deformation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include "analysis/cells.h"
#include "analysis/free_grains.h"
#include "core/tensor.h"
#include "core/trigonometry.h"

namespace talus::analysis {

namespace {

/// Returns the displacements of all grains between two frames, m, unwrapped along x.
std::vector<Vector2> displacements(const Frame& before, const BedFrame& bed) {
  std::vector<Vector2> moved;
  for (Index i = 0; i < bed.frame.grain_count(); ++i) {
    const Vec2 by = displacement(bed, before, i);
    moved.emplace_back(by.x, by.y);
  }
  return moved;
}

/// Sums over neighbours of positions d and displacements u relative to the grain.
struct Fit {
  Matrix2 dd = Matrix2::Zero(), ud = Matrix2::Zero();
  double uu = 0.0;
  Index count = 0;

  void add(const Vector2& d, const Vector2& u) {
    dd += d * d.transpose();
    ud += u * d.transpose();
    uu += u.squaredNorm();
    ++count;
  }
};

LocalDeformation fitted(const Fit& fit) {
  constexpr double flat = 1e-6;  // smallest det over (trace / 2)^2 of points that do not lie in one line
  if (fit.count < 2 || fit.dd.determinant() <= flat * std::pow(0.5 * fit.dd.trace(), 2)) return {};
  const Matrix2 gradient = fit.ud * fit.dd.inverse();                    // (T27)
  const double left = fit.uu - (gradient * fit.ud.transpose()).trace();  // (T28)
  return {tensor(gradient), std::max(0.0, left) / static_cast<double>(fit.count)};
}

}  // namespace

std::vector<LocalDeformation> local_deformations(const Frame& before, const BedFrame& bed) {
  std::vector<LocalDeformation> found(bed.statics.free_count);
  if (before.grain_count() != bed.frame.grain_count() || found.empty()) return found;
  const double reach = deformation_reach * bed.statics.mean_diameter, period = period_of(bed.statics);
  const Cells cells = sort_into_cells(before.x, before.y, reach, period);
  const std::vector<Vector2> moved = displacements(before, bed);
  for (Index i = 0; i < bed.statics.free_count; ++i) {
    Fit fit;
    const auto add = [&](Index j) {
      Vector2 d(before.x[j] - before.x[i], before.y[j] - before.y[i]);
      d.x() += nearest_image(d.x(), period) * period;
      if (j != i && d.squaredNorm() <= reach * reach) fit.add(d, moved[j] - moved[i]);
    };
    for (Index ring = 0; ring <= 1; ++ring)
      visit_ring(cells, column_of(cells, before.x[i]), row_of(cells, before.y[i]), ring, add);
    found[i] = fitted(fit);
  }
  return found;
}

double shear_strain(const Tensor2& gradient) {
  return std::hypot(gradient.xx - gradient.yy, gradient.xy + gradient.yx);  // (T29)
}

double area_strain(const Tensor2& gradient) {
  return gradient.xx + gradient.yy + gradient.xx * gradient.yy - gradient.xy * gradient.yx;
}

double vorticity(const Tensor2& gradient) {
  return 2.0 * std::atan2(gradient.yx - gradient.xy, 2.0 + gradient.xx + gradient.yy);
}

void measure_deformation(const Frame& before, const BedFrame& bed, FrameRecord& record) {
  std::vector<double> shears;
  double nonaffine = 0.0, largest = 0.0;
  for (const LocalDeformation& deformation : local_deformations(before, bed)) {
    if (std::isnan(deformation.nonaffine)) continue;
    shears.push_back(shear_strain(deformation.gradient));
    nonaffine += deformation.nonaffine;
    largest = std::max(largest, deformation.nonaffine);
  }
  if (shears.empty()) return;
  const auto count = static_cast<double>(shears.size());
  std::ranges::sort(shears, std::greater());
  const double sum = std::accumulate(shears.begin(), shears.end(), 0.0);
  const auto top = static_cast<std::ptrdiff_t>(std::ceil(most_strained_share * count));
  record.local_shear = sum / count;
  record.local_shear_share = std::accumulate(shears.begin(), shears.begin() + top, 0.0) / sum;
  record.nonaffine = std::sqrt(nonaffine / count);
  record.nonaffine_largest = std::sqrt(largest);
}

namespace {

/// Gauss-Legendre quadrature on [0, 1].
constexpr std::array<double, 3> nodes = {0.5 - 0.38729833462074168852, 0.5, 0.5 + 0.38729833462074168852};
constexpr std::array<double, 3> weights = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
/// Longest piece of a branch vector for which three nodes are sufficient, in units of the cutoff.
constexpr double longest_piece = 0.5;

constexpr double lucy_norm = 5.0 / pi;

/// Weighted sums over grains of (1, dx, dy) for a linear fit of the velocity as a function of position.
struct LinearFit {
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero(), b = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> v = Eigen::Matrix<double, 3, 2>::Zero();
  double vv = 0.0;
  int count = 0;

  /// Adds a grain. `d`: its position relative to the point, in units of the cutoff.
  void add(double weight, const Vector2& d, const Vector2& velocity) {
    const Eigen::Vector3d row(1.0, d.x(), d.y());
    a += weight * row * row.transpose();
    b += weight * weight * row * row.transpose();
    v += weight * row * velocity.transpose();
    vv += weight * velocity.squaredNorm();
    ++count;
  }

  /// Returns half the mean square of the residuals, corrected for the degrees of freedom of the fit. (T37)
  double temperature() const {
    constexpr double flat = 1e-9;
    const double weight = a(0, 0);
    if (count < 4 || std::fabs(a.determinant()) <= flat * weight * weight * weight) return not_known;
    const Eigen::Matrix3d inverse = a.inverse();
    const double left = vv - (v.transpose() * inverse * v).trace();
    const double free = weight - (inverse * b).trace();
    return free > flat * weight ? 0.5 * std::max(0.0, left) / free : not_known;
  }
};

}  // namespace

double lucy_function(double distance, double cutoff) {
  const double q = distance / cutoff;
  if (!(q < 1.0)) return 0.0;
  return lucy_norm / (cutoff * cutoff) * (1.0 + 3.0 * q) * (1.0 - q) * (1.0 - q) * (1.0 - q);  // (T31)
}

Tensor2 CoarseField::stress() const { return tensor(matrix(contact_stress) + matrix(kinetic_stress)); }

CoarseFields::CoarseFields(const BedFrame& bed, double cutoff, bool with_contacts)
    : cutoff_(cutoff), period_(period_of(bed.statics)) {
  for (Index i = 0; i < bed.statics.free_count; ++i) {
    grains_.x.push_back(bed.frame.x[i]);
    grains_.y.push_back(bed.frame.y[i]);
    grains_.what.push_back({bed.statics.mass[i], {bed.frame.vx[i], bed.frame.vy[i]}});
  }
  if (with_contacts) add_contacts(bed);
  grains_.cells = sort_into_cells(grains_.x, grains_.y, cutoff_, period_);
  branches_.cells = sort_into_cells(branches_.x, branches_.y, cutoff_, period_);
  boundary_.cells = sort_into_cells(boundary_.x, boundary_.y, cutoff_, period_);
}

/// Adds the contact stress. The branch of a contact extends from centre to centre, or between a centre and
/// the contact if one of the bodies is fixed. As for the internal moments, its length comes from the radii.
void CoarseFields::add_contacts(const BedFrame& bed) {
  const FrameContacts& contacts = bed.frame.contacts;
  const Index fixed = bed.statics.free_count;
  for (Index c = 0; c < contacts.count(); ++c) {
    const Index a = contacts.a[c], b = contacts.b[c];
    const Vector2 n(contacts.nx[c], contacts.ny[c]), t(-n.y(), n.x());
    const Vector2 force = contacts.fn[c] * n + contacts.ft[c] * t;  // force on b
    const Vector2 branch = branch_length(bed, c) * n;
    const Vector2 begin =
        a < fixed ? Vector2(bed.frame.x[a], bed.frame.y[a])
                  : Vector2(bed.frame.x[b] + contacts.shift[c] * bed.statics.length, bed.frame.y[b]) - branch;
    const Tensor2 whole = tensor(branch * force.transpose());
    const int pieces = std::max(1, static_cast<int>(std::ceil(branch.norm() / (longest_piece * cutoff_))));
    for (int piece = 0; piece < pieces; ++piece)
      for (std::size_t k = 0; k < nodes.size(); ++k) {  // (T33)
        const Vector2 at = begin + branch * ((piece + nodes[k]) / pieces);
        branches_.x.push_back(at.x());
        branches_.y.push_back(at.y());
        branches_.what.push_back(tensor(matrix(whole) * (weights[k] / pieces)));
      }
    if (a >= fixed || b >= fixed) {
      const Vector2 at = a < fixed ? Vector2(begin + branch) : begin;
      boundary_.x.push_back(at.x());
      boundary_.y.push_back(at.y());
      boundary_.what.emplace_back(a < fixed ? Vector2(-force) : force);
    }
  }
}

/// Calls visit(what, d, distance) for the sources within the cutoff of a point; d is their position relative
/// to it.
template <typename What, typename Visit>
void CoarseFields::visit_sources(const Sources<What>& sources, double x, double y, const Visit& visit) const {
  if (sources.what.empty()) return;
  const double farthest = cutoff_ * cutoff_ * (1.0 + 1e-12);
  const auto visit_source = [&](Index k) {
    Vector2 d(sources.x[k] - x, sources.y[k] - y);
    d.x() += nearest_image(d.x(), period_) * period_;
    if (d.squaredNorm() > farthest) return;  // avoids the square root in most cases
    const double distance = d.norm();
    if (distance < cutoff_) visit(sources.what[k], d, distance);
  };
  const Index column = column_of(sources.cells, x), row = row_of(sources.cells, y);
  for (Index ring = 0; ring <= 1; ++ring) visit_ring(sources.cells, column, row, ring, visit_source);
}

CoarseField CoarseFields::at(double x, double y) const {
  CoarseField field;
  Vector2 momentum = Vector2::Zero(), density_gradient = Vector2::Zero(), boundary = Vector2::Zero();
  Matrix2 momentum_gradient = Matrix2::Zero(), flux = Matrix2::Zero(), stress = Matrix2::Zero();
  LinearFit fit;
  visit_sources(grains_, x, y, [&](const MovingMass& grain, const Vector2& d, double distance) {
    const double q = distance / cutoff_, square = cutoff_ * cutoff_;
    const double weight = grain.mass * lucy_function(distance, cutoff_);
    const Vector2 gradient = grain.mass * lucy_norm * 12.0 * (1.0 - q) * (1.0 - q) / (square * square) * d;
    field.density += weight;
    momentum += weight * grain.velocity;
    density_gradient += gradient;
    momentum_gradient += grain.velocity * gradient.transpose();
    flux += weight * grain.velocity * grain.velocity.transpose();
    fit.add(weight, d / cutoff_, grain.velocity);
  });
  visit_sources(branches_, x, y, [&](const Tensor2& part, const Vector2&, double distance) {
    stress += lucy_function(distance, cutoff_) * matrix(part);
  });
  visit_sources(boundary_, x, y, [&](const Vector2& force, const Vector2&, double distance) {
    boundary += lucy_function(distance, cutoff_) * force;
  });
  const Vector2 velocity = momentum / field.density;
  field.momentum = {momentum.x(), momentum.y()};
  field.contact_stress = tensor(stress);
  if (field.density > 0.0) field.kinetic_stress = tensor(flux - momentum * velocity.transpose());  // (T34)
  field.boundary_force = {boundary.x(), boundary.y()};                                             // (T35)
  field.velocity_gradient =
      tensor((momentum_gradient - velocity * density_gradient.transpose()) / field.density);  // (T36)
  field.temperature = fit.temperature();
  return field;
}

std::vector<double> granular_temperatures(const BedFrame& bed, double cutoff) {
  const CoarseFields fields(bed, cutoff, false);
  std::vector<double> temperatures;
  for (Index i = 0; i < bed.statics.free_count; ++i) {
    LinearFit fit;
    fields.visit_sources(fields.grains_, bed.frame.x[i], bed.frame.y[i],
                         [&](const CoarseFields::MovingMass& grain, const Vector2& d, double distance) {
                           fit.add(grain.mass * lucy_function(distance, cutoff), d / cutoff, grain.velocity);
                         });
    temperatures.push_back(fit.temperature());
  }
  return temperatures;
}

void measure_granular_temperature(const BedFrame& bed, FrameRecord& record) {
  const std::vector<double> temperatures =
      granular_temperatures(bed, 0.5 * temperature_width * bed.statics.mean_diameter);
  double sum = 0.0, mass = 0.0;
  for (std::size_t i = 0; i < temperatures.size(); ++i) {
    if (std::isnan(temperatures[i])) continue;
    sum += bed.statics.mass[i] * temperatures[i];
    mass += bed.statics.mass[i];
  }
  record.granular_temperature = sum / mass;
}

}  // namespace talus::analysis
