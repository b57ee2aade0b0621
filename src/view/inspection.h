#pragma once
/// Properties of one grain and of one contact.

#include <optional>
#include <string>
#include <vector>

#include "analysis/overload/clusters.h"
#include "analysis/overload/coarse_graining.h"
#include "core/bed_frame.h"
#include "stress/stress_state.h"
#include "view/selection.h"

namespace talus::view {

/// Contact of the selected grain.
struct GrainContact {
  ContactKey key;
  Index other = -1;           ///< grain or plane
  std::string other_name;     ///< "grain 431", "floor grain 8012", "left wall"
  double fn = 0.0, ft = 0.0;  ///< N (per metre of thickness)
  double nx = 0.0, ny = 0.0;  ///< unit vector, outwards from the grain
  ContactStatus status = ContactStatus::open;
};

/// Properties of one grain.
struct Inspection {
  Index grain = -1;
  bool free = true;
  double radius = 0.0, mass = 0.0;
  double x = 0.0, y = 0.0, vx = 0.0, vy = 0.0, omega = 0.0;
  std::vector<GrainContact> contacts;
  Tensor2 internal_moment;
  stress::StressState state;  ///< state of the internal moment; its ratio is the gamma of the single grain
  double gamma = 0.0;         ///< value of the frame: that of the neighbourhood of diameter l_min
  bool overloaded = false;
  Index cluster = -1;  ///< index among the overloaded clusters; -1: none
  Index cluster_size = 0;
  analysis::NeighbourhoodCurve curve;  ///< gamma_l over l (paper, Fig. 11)
  std::optional<double>
      coarse_graining_length;  ///< m; empty if the grain is not overloaded; the cut-off if it is cut off
  double neighbourhood_gamma = 0.0;  ///< gamma_l at ViewState::neighbourhood
};

/// Returns "grain 431", "floor grain 8012" or, for a plane, "left wall". A plane is named by its direction
/// from the grain, given by the x component nx of the normal.
std::string body_name(const BedFrame& bed, Index body, double nx);

/// Inspects a grain of a frame of mapped_frame. A floor grain has contacts, but no neighbourhoods. `clusters`
/// are those of the overloaded grains of the frame, found by the rule; `neighbourhood` (m) is the diameter
/// for neighbourhood_gamma.
Inspection inspect(const BedFrame& bed, const analysis::Clusters& clusters,
                   const analysis::CoarseGrainingRule& rule, double neighbourhood, Index grain);

/// Properties of one contact.
struct ContactInspection {
  ContactKey key;
  std::string a_name, b_name;  ///< "grain 431", "floor grain 8012", "left wall"
  bool carries = false;  ///< whether it carries force in the frame shown; if not, the values below are 0
  double fn = 0.0,
         ft = 0.0;  ///< force on b, along the normal from a to b and along the normal turned by +90 deg, N/m
  double nx = 0.0, ny = 0.0;
  double px = 0.0, py = 0.0;  ///< m
  ContactStatus status = ContactStatus::open;
  double friction = 0.0;      ///< mu in the frame shown
  double mobilisation = 0.0;  ///< |f_t| / (mu f_n); NaN without friction
};

/// Inspects a contact; one that is open is taken to be between grains.
ContactInspection inspect_contact(const BedFrame& bed, const ContactKey& key);

/// Returns the mobilised share of friction, |f_t| / (friction f_n); NaN if the contact is open or has no
/// friction.
double mobilised(double fn, double ft, double friction);

/// Returns the grain whose disc contains the point (m, frame of the bed; in a periodic bed, any image of it),
/// else the grain with the nearest edge, up to a mean diameter away.
std::optional<Index> find_grain(const BedFrame& bed, double x, double y);

}  // namespace talus::view
