#include "stress/free_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/trigonometry.h"

namespace talus::stress {
namespace {

struct Disk {
  double x, y, radius;
  bool operator==(const Disk&) const = default;

  /// Returns half the width of the part above y = 0, m; 0 if no part is above.
  double half_width() const {
    return y >= 0.0 ? radius : std::sqrt(std::max(0.0, radius * radius - y * y)) * (radius > -y ? 1.0 : 0.0);
  }
  /// Returns the height of the upper side; outside the disk, the height of its centre.
  double height_at(double place) const {
    const double offset = place - x;
    return y + std::sqrt(std::max(0.0, radius * radius - offset * offset));
  }
};

Disk disk_of(const SurfaceArc& arc) { return {arc.x, arc.y, arc.radius}; }

/// Lower bounds of the free surface in equal cells. Nearly all disks of a bed lie below them, and need not be
/// merged.
class LowestHeights {
 public:
  LowestHeights(double length, double width)
      : heights_(static_cast<std::size_t>(std::clamp(std::ceil(length / width), 1.0, 1e6)), 0.0),
        width_(length / static_cast<double>(heights_.size())),
        per_width_(1.0 / width_) {}

  /// Whether a disk may be part of the free surface.
  bool may_be_on_surface(const Disk& disk) const {
    const double half = disk.half_width(), top = disk.y + disk.radius;
    for (std::size_t k = cell(disk.x - half), last = cell(disk.x + half); k <= last; ++k)
      if (top > heights_[k] && disk.height_at(std::clamp(disk.x, left(k), left(k + 1))) > heights_[k])
        return true;
    return false;
  }

  /// Includes a disk. In a cell that it covers, its upper side is lowest at one of the ends.
  void add(const Disk& disk) {
    const double half = disk.half_width();
    for (std::size_t k = cell(disk.x - half), last = cell(disk.x + half); k <= last; ++k)
      if (disk.x - half <= left(k) && left(k + 1) <= disk.x + half)
        heights_[k] = std::max(heights_[k], std::min(disk.height_at(left(k)), disk.height_at(left(k + 1))));
  }

 private:
  double left(std::size_t k) const { return width_ * static_cast<double>(k); }
  std::size_t cell(double place) const {
    const double k = place * per_width_;
    return k > 0.0 ? std::min(static_cast<std::size_t>(k), heights_.size() - 1) : 0;
  }

  std::vector<double> heights_;
  double width_, per_width_;
};

/// Returns the disks and periodic images that may be part of the free surface, each at least partly between 0
/// and the length.
std::vector<Disk> upper_disks(const Grains& grains, const Boundary& boundary) {
  const double length = boundary.length;
  double sum = 0.0;
  for (Index i = 0; i < grains.free_count; ++i) sum += grains.radius[i];
  if (!(sum > 0.0)) return {};
  LowestHeights lowest(length, 0.5 * sum / grains.free_count);
  std::vector<Disk> disks;
  const auto add = [&](const Disk& disk) {
    const double half = disk.half_width();
    if (!(half > 0.0) || disk.x + half <= 0.0 || disk.x - half >= length || !lowest.may_be_on_surface(disk))
      return;
    lowest.add(disk);
    disks.push_back(disk);
  };
  // The last grains come first, because they are usually at the surface.
  for (Index i = grains.free_count - 1; i >= 0; --i) {
    const Disk disk{grains.x[i], grains.y[i], grains.radius[i]};
    if (!boundary.periodic || (disk.radius <= disk.x && disk.x <= length - disk.radius)) {
      add(disk);  // no image of this disk reaches into the bed
      continue;
    }
    const double first = std::ceil(-(disk.x + disk.radius) / length);
    const double last = std::floor((length - disk.x + disk.radius) / length);
    for (double image = first; image <= last; ++image) add({disk.x + image * length, disk.y, disk.radius});
  }
  std::erase_if(disks, [&](const Disk& disk) { return !lowest.may_be_on_surface(disk); });
  return disks;
}

using Surface = std::vector<SurfaceArc>;

void append(Surface& surface, double end, const Disk& disk) {
  if (!surface.empty() && disk_of(surface.back()) == disk)
    surface.back().end = end;
  else
    surface.push_back({end, disk.x, disk.y, disk.radius});
}

constexpr Disk plane = {0.0, 0.0, 0.0};

Surface surface_of(const Disk& disk, double length) {
  const double half = disk.half_width();
  Surface surface;
  if (disk.x - half > 0.0) append(surface, disk.x - half, plane);
  append(surface, std::min(disk.x + half, length), disk);
  if (disk.x + half < length) append(surface, length, plane);
  return surface;
}

/// Returns the x of the two intersections of circles, in ascending order; NaN without intersections.
std::array<double, 2> crossings(const Disk& a, const Disk& b) {
  const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  const double along = (a.radius * a.radius - b.radius * b.radius + square) / (2.0 * square);
  const double across = std::sqrt(a.radius * a.radius / square - along * along);
  const double middle = a.x + along * dx, half = std::abs(across * dy);
  return {middle - half, middle + half};
}

/// Returns the upper envelope of two surfaces.
Surface merged(const Surface& a, const Surface& b) {
  Surface surface;
  double begin = 0.0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const double end = std::min(a[i].end, b[j].end);
    const Disk one = disk_of(a[i]), other = disk_of(b[j]);
    if (one == plane || other == plane) {
      append(surface, end, one == plane ? other : one);
    } else {
      const auto take_higher = [&](double to) {
        if (!(to > begin)) return;
        const double middle = 0.5 * (begin + to);
        append(surface, to, one.height_at(middle) >= other.height_at(middle) ? one : other);
        begin = to;
      };
      for (const double crossing : crossings(one, other))
        if (begin < crossing && crossing < end) take_higher(crossing);
      take_higher(end);
    }
    begin = end;
    if (a[i].end <= end) ++i;
    if (b[j].end <= end) ++j;
  }
  return surface;
}

Surface surface_of(std::span<const Disk> disks, double length) {
  if (disks.size() == 1) return surface_of(disks.front(), length);
  const std::size_t half = disks.size() / 2;
  return merged(surface_of(disks.first(half), length), surface_of(disks.subspan(half), length));
}

/// Integrals of h and of (x - about) h, with h the height of a surface.
struct Integrals {
  double area = 0.0, moment = 0.0;
};

/// Returns the integrals of sqrt(r^2 - u^2) and, up to a constant, of u sqrt(r^2 - u^2), from the centre of a
/// disk to u.
Integrals primitive(double u, double radius) {
  const double root = std::sqrt(std::max(0.0, radius * radius - u * u));
  const double angle = root > 0.0 ? arctangent(u / root) : u < 0.0 ? -0.5 * pi : 0.5 * pi;
  return {0.5 * (u * root + radius * radius * angle), -root * root * root / 3.0};
}

Integrals integrals(const Surface& surface, double from, double to, double about) {
  Integrals sum;
  double begin = 0.0;
  for (const SurfaceArc& arc : surface) {
    const double first = std::max(begin, from), last = std::min(arc.end, to);
    begin = arc.end;
    if (!(last > first) || arc.radius == 0.0) continue;
    const double u = first - arc.x, v = last - arc.x;
    const Integrals low = primitive(u, arc.radius), high = primitive(v, arc.radius);
    const double area = arc.y * (v - u) + high.area - low.area;
    sum.area += area;
    sum.moment += (arc.x - about) * area + 0.5 * arc.y * (v * v - u * u) + high.moment - low.moment;
  }
  return sum;
}

}  // namespace

std::vector<SurfaceArc> free_surface(const Grains& grains, const Boundary& boundary) {
  if (!(boundary.length > 0.0)) return {};
  const std::vector<Disk> disks = upper_disks(grains, boundary);
  if (disks.empty()) return {{boundary.length, 0.0, 0.0, 0.0}};
  return surface_of(disks, boundary.length);
}

double height_of(const Surface& surface, double place) {
  if (surface.empty()) return 0.0;
  const auto arc = std::ranges::lower_bound(surface, place, {}, &SurfaceArc::end);
  const Disk disk = disk_of(arc == surface.end() ? surface.back() : *arc);
  return disk == plane ? 0.0 : disk.height_at(place);
}

double area_below(const Surface& surface, double from, double to) {
  return integrals(surface, from, to, 0.0).area;
}

double bed_volume(const Grains& grains, const Boundary& boundary) {
  return area_below(free_surface(grains, boundary), 0.0, boundary.length);
}

double mean_height(const Grains& grains, const Boundary& boundary, double centre, double half_width) {
  const std::vector<SurfaceArc> surface = free_surface(grains, boundary);
  const double half = boundary.periodic ? std::min(half_width, 0.5 * boundary.length) : half_width;
  double area = 0.0, width = 0.0;
  for (const int image : {-1, 0, 1}) {
    if (image != 0 && !boundary.periodic) continue;
    const double from = std::max(0.0, centre - half + image * boundary.length);
    const double to = std::min(boundary.length, centre + half + image * boundary.length);
    if (!(to > from)) continue;
    area += area_below(surface, from, to);
    width += to - from;
  }
  return width > 0.0 ? area / width : 0.0;
}

double surface_inclination(const Grains& grains, const Boundary& boundary) {
  const double length = boundary.length;
  if (boundary.periodic || !(length > 0.0)) return 0.0;
  // The moment is about the middle of the bed, so that the integral of the distances is zero.
  const double moment =
      integrals(free_surface(grains, boundary), 0.25 * length, 0.75 * length, 0.5 * length).moment;
  return arctangent(moment / (length * length * length / 96.0));
}

}  // namespace talus::stress
