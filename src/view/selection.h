#pragma once
/// Selection as plain data, and functions that find grains and contacts by position.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/bed_frame.h"

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

/// Returns the index of the contact whose point, or an image of it, is nearest to a point (m), within `reach`
/// (m).
std::optional<Index> find_contact(const BedFrame& bed, double x, double y, double reach);

ContactKey key_of(const FrameContacts& contacts, Index c);

/// Returns the index of the contact with that key in a frame; nothing if it carries no force there.
std::optional<Index> contact_of_key(const FrameContacts& contacts, const ContactKey& key);

}  // namespace talus::view
