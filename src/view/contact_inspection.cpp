#include "view/contact_inspection.h"

#include <cmath>

#include "view/inspection.h"

namespace talus {
namespace {

double mobilised(double fn, double ft, double friction) {
  return fn > 0.0 && friction > 0.0 ? std::abs(ft) / (friction * fn) : not_known;
}

}  // namespace

ContactInspection inspect_contact(const BedFrame& bed, const ContactKey& key, double friction) {
  ContactInspection of;
  of.key = key;
  of.friction = friction;
  of.mobilisation = not_known;
  const FrameContacts& contacts = bed.frame.contacts;
  if (const auto found = contact_of_key(contacts, key)) {
    const auto c = static_cast<std::size_t>(*found);
    of.carries = true;
    of.fn = contacts.fn[c];
    of.ft = contacts.ft[c];
    of.nx = contacts.nx[c];
    of.ny = contacts.ny[c];
    of.px = contacts.px[c];
    of.py = contacts.py[c];
    of.status = contacts.status[c];
    if (is_with_wall(bed.frame, *found)) of.friction = bed.statics.wall_friction;
    of.mobilisation = mobilised(of.fn, of.ft, of.friction);
  }
  of.a_name = body_name(bed, key.a, -of.nx);
  of.b_name = body_name(bed, key.b, of.nx);
  return of;
}

std::vector<Plot> contact_plots(std::span<const HistoryInstant> instants, std::span<const double> friction,
                                double weight, const PlotAbscissa& abscissa) {
  PlotSeries normal{"f_n", {}, {}}, tangential{"f_t", {}, {}}, mobilisation{"|f_t|/μf_n", {}, {}},
      sliding{"slides", {}, {}, true};
  for (std::size_t k = 0; k < instants.size(); ++k) {
    const HistoryInstant& at = instants[k];
    const double x = place_on(abscissa, at.tilt, at.time);
    for (PlotSeries* series : {&normal, &tangential, &mobilisation, &sliding}) series->x.push_back(x);
    normal.y.push_back(at.fn / weight);
    tangential.y.push_back(at.ft / weight);
    mobilisation.y.push_back(mobilised(at.fn, at.ft, friction[k]));
    sliding.y.push_back(1.0);
  }
  std::vector<Plot> plots = {
      plot_along_run("contact forces", "f/mg", {std::move(normal), std::move(tangential)}),
      plot_along_run("mobilisation", "", {std::move(mobilisation), std::move(sliding)})};
  name_axis(abscissa.axis, plots);
  return plots;
}

}  // namespace talus
