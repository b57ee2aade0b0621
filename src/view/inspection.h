#pragma once
/// What there is to say of one grain, and of one contact.

#include <optional>
#include <string>
#include <vector>

#include "analysis/overload/clusters.h"
#include "analysis/overload/coarse_graining.h"
#include "core/bed_frame.h"
#include "stress/stress_state.h"
#include "view/selection.h"

namespace talus::view {

/// A contact of the selected grain.
struct GrainContact {
  ContactKey key;
  Index other = -1;           ///< grain, or a plane
  std::string other_name;     ///< "grain 431", "floor grain 8012", "left wall"
  double fn = 0.0, ft = 0.0;  ///< N (per metre of thickness)
  double nx = 0.0, ny = 0.0;  ///< unit, from the grain outwards
  ContactStatus status = ContactStatus::open;
};

/// All there is to say of one grain.
struct Inspection {
  Index grain = -1;
  bool free = true;
  double radius = 0.0, mass = 0.0;
  double x = 0.0, y = 0.0, vx = 0.0, vy = 0.0, omega = 0.0;
  std::vector<GrainContact> contacts;
  Tensor2 internal_moment;
  stress::StressState state;  ///< of the internal moment: its ratio is the gamma of the grain alone
  double gamma = 0.0;         ///< as the frame has it: of the neighbourhood of diameter l_min
  bool overloaded = false;
  Index cluster = -1;  ///< of the overloaded clusters; -1 for none
  Index cluster_size = 0;
  analysis::NeighbourhoodCurve curve;  ///< gamma_l over l (paper, Fig. 11)
  std::optional<double>
      coarse_graining_length;        ///< m; none where it is not overloaded; the cut where it is cut off
  double neighbourhood_gamma = 0.0;  ///< gamma_l at ViewState::neighbourhood
};

/// "grain 431", "floor grain 8012"; of a plane where it is seen from the grain, from which the normal (of x
/// component nx) points to it: "left wall".
std::string body_name(const BedFrame& bed, Index body, double nx);

/// Of a grain of a frame of mapped_frame, floor included; one of the floor has contacts, but no
/// neighbourhoods. `clusters` are those of the overloaded grains of the frame, which are found by the rule;
/// `neighbourhood` (m) is the diameter of neighbourhood_gamma.
Inspection inspect(const BedFrame& bed, const analysis::Clusters& clusters,
                   const analysis::CoarseGrainingRule& rule, double neighbourhood, Index grain);

/// All there is to say of one contact.
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

/// The share of friction that is mobilised, |f_t| / (friction f_n); NaN where it is open, or has none.
double mobilised(double fn, double ft, double friction);

/// The grain whose disc holds the place (m, frame of the bed; in a periodic bed any image of it), else the
/// one whose edge is nearest, not farther than a mean diameter.
std::optional<Index> find_grain(const BedFrame& bed, double x, double y);

}  // namespace talus::view
