#pragma once
/// Selection as plain data, grains and contacts by position, and the properties of what is selected.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/overload/clusters.h"
#include "analysis/overload/coarse_graining.h"
#include "core/snapshot.h"
#include "stress/stress.h"

namespace talus::view {

/// Identity of a contact across frames: bodies a < b, where b may be a plane, and b touches a from x_b +
/// shift * length.
struct ContactKey {
  Index a = -1, b = -1;
  std::int8_t shift = 0;
  bool operator==(const ContactKey&) const = default;
};

struct Selection {
  std::vector<Index> grains;          ///< sorted by id, without duplicates
  std::optional<ContactKey> contact;  ///< instead of grains
};

/// Returns the grains, sorted by id, with `grain` added, or removed if it is among them.
std::vector<Index> toggled(std::vector<Index> grains, Index grain);

/// Returns, sorted by id, the free grains whose centre, or an image of it in a periodic bed, lies inside the
/// closed polygon through these points (m, frame of the bed): a ray from the centre crosses it an odd number
/// of times. Empty for fewer than three points.
std::vector<Index> grains_within(const BedFrame& bed, std::span<const Vec2> outline);

/// Returns the contact whose point, or an image of it, is nearest to a point (m), within `reach` (m).
std::optional<ContactKey> find_contact(const BedFrame& bed, double x, double y, double reach);

ContactKey key_of(const FrameContacts& contacts, Index c);

/// Returns the index of the contact with that key in a frame; nothing if it carries no force there.
std::optional<Index> contact_of_key(const FrameContacts& contacts, const ContactKey& key);

/// Contact of the selected grain.
struct GrainContact {
  ContactKey key;
  std::string other_name;     ///< "grain 431", "floor grain 8012", "left wall"
  double fn = 0.0, ft = 0.0;  ///< N (per metre of thickness)
  ContactStatus status = ContactStatus::open;
};

/// Properties of one grain, in addition to those of its frame.
struct Inspection {
  Index grain = -1;
  bool free = true;
  std::vector<GrainContact> contacts;
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

/// A contact in one frame of its history.
struct HistoryInstant {
  double time = 0.0;  ///< s
  double tilt = 0.0;  ///< rad
  /// Force on b, along the normal from a to b and along the normal turned by +90 deg, N per metre of
  /// thickness; 0 if the contact is open.
  double fn = 0.0, ft = 0.0;
  double friction = not_known;  ///< mu of the contact, if it carries force
};
HistoryInstant instant_of(const Frame& frame, const ContactKey& contact);

/// Properties of one contact in the frame shown.
struct ContactInspection : HistoryInstant {
  ContactKey key;
  std::string a_name{}, b_name{};  ///< "grain 431", "floor grain 8012", "left wall"
  bool carries = false;            ///< whether it carries force; if not, the values below are 0
  double nx = 0.0, ny = 0.0;       ///< along f_n, from a to b
  double px = 0.0, py = 0.0;       ///< m
  ContactStatus status = ContactStatus::open;
  double mobilisation = 0.0;  ///< |f_t| / (mu f_n); NaN without friction
};

/// Inspects a contact; one that is open is taken to be between grains.
ContactInspection inspect_contact(const BedFrame& bed, const ContactKey& key);

/// Returns the mobilised share of friction, |f_t| / (friction f_n); NaN without one.
double mobilised(double fn, double ft, double friction);

/// Returns the grain whose disc contains the point (m, frame of the bed; in a periodic bed, any image of it),
/// else the grain with the nearest edge, up to a mean diameter away.
std::optional<Index> find_grain(const BedFrame& bed, double x, double y);

}  // namespace talus::view
