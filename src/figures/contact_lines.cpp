#include "figures/contact_lines.h"

#include <cmath>

#include "stress/free_surface.h"

namespace talus::figures {
namespace {

constexpr double samples_per_diameter = 4.0;

/// Appends a line with its second end in the next period to the left or right, or on the edge.
void append_cut(std::vector<ContactLine>& lines, const ContactLine& line, bool to_left, double length) {
  const double edge = to_left ? 0.0 : length;
  const double period = to_left ? -length : length;
  const double y = line.y1 + (line.y2 - line.y1) * (edge - line.x1) / (line.x2 - line.x1);
  lines.push_back({line.x1, line.y1, edge, y, line.contact});
  lines.push_back({edge - period, y, line.x2 - period, line.y2, line.contact});
}

}  // namespace

std::vector<ContactLine> contact_lines(const BedFrame& bed) {
  const Frame& frame = bed.frame;
  const FrameContacts& contacts = frame.contacts;
  std::vector<ContactLine> lines;
  for (Index c = 0; c < contacts.count(); ++c) {
    const Index a = contacts.a[c], b = contacts.b[c];
    ContactLine line{frame.x[a], frame.y[a], contacts.px[c], contacts.py[c], c};
    if (b < frame.grain_count()) {
      line.x2 = frame.x[b] + contacts.shift[c] * bed.statics.length;
      line.y2 = frame.y[b];
    }
    if (contacts.shift[c] == 0)
      lines.push_back(line);
    else
      append_cut(lines, line, contacts.shift[c] < 0, bed.statics.length);
  }
  return lines;
}

SurfaceLine surface_line(const BedFrame& bed) {
  const RunStatics& statics = bed.statics;
  Grains grains;
  grains.free_count = statics.free_count;
  grains.x = bed.frame.x;
  grains.y = bed.frame.y;
  grains.radius = statics.radius;
  Boundary boundary;
  boundary.periodic = statics.periodic;
  boundary.length = statics.length;
  SurfaceLine line;
  const std::vector<stress::SurfaceArc> surface = stress::free_surface(grains, boundary);
  const double samples = std::ceil(statics.length / statics.mean_diameter * samples_per_diameter);
  for (double k = 0.5; k < samples; ++k) {
    line.x.push_back(k * statics.length / samples);
    line.y.push_back(stress::height_of(surface, line.x.back()));
  }
  return line;
}

}  // namespace talus::figures
