#pragma once
/// What there is to say of one contact.

#include <span>
#include <string>
#include <vector>

#include "view/history.h"
#include "view/plots.h"
#include "view/selection.h"

namespace talus {

struct ContactInspection {
  ContactKey key;
  std::string a_name, b_name;  ///< "grain 431", "floor grain 8012", "left wall"
  bool carries = false;        ///< force in the frame shown; if not, what follows is 0
  double fn = 0.0, ft = 0.0;   ///< on b along the normal from a to b and along it turned by +90 deg, N/m
  double nx = 0.0, ny = 0.0;
  double px = 0.0, py = 0.0;  ///< m
  ContactStatus status = ContactStatus::open;
  double friction = 0.0;      ///< mu, in the frame shown
  double mobilisation = 0.0;  ///< the size of f_t over mu f_n; NaN without friction
};

/// `friction`: that between grains at the time of the frame. A contact with a side wall has that of the
/// walls.
ContactInspection inspect_contact(const BedFrame& bed, const ContactKey& key, double friction);

/// "contact forces", over the weight `weight` (N/m), and "mobilisation", with 1, where it slides: along the
/// run. `friction` of each instant. An open contact has no mobilisation.
std::vector<Plot> contact_plots(std::span<const HistoryInstant> instants, std::span<const double> friction,
                                double weight, const PlotAbscissa& abscissa);

}  // namespace talus
