#pragma once
/// What is selected, as plain data, and how grains and contacts of a frame are found by their places.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/bed_frame.h"

namespace talus::view {

/// A contact keeps its key from frame to frame: bodies a < b, where b may be a plane, and b touches a from
/// x_b + shift * length.
struct ContactKey {
  Index a = -1, b = -1;
  std::int8_t shift = 0;
  bool operator==(const ContactKey&) const = default;
};

struct Selection {
  std::vector<Index> grains;          ///< by their ids, each once
  std::optional<ContactKey> contact;  ///< instead of grains
  bool operator==(const Selection&) const = default;
};

/// What grains that were found do to those that are selected.
enum class SelectionMode {
  anew,    ///< they take their place
  add,     ///< they come to them
  remove,  ///< they are taken from them
  common,  ///< only those stay that were found
};

/// Both by ascending ids, each once; so is what is returned.
std::vector<Index> combined(const std::vector<Index>& before, const std::vector<Index>& found,
                            SelectionMode mode);

/// The grains with that one, or without it if it is among them.
std::vector<Index> toggled(const std::vector<Index>& grains, Index grain);

/// At most so many: all of them, or every second, third, ... one from the first on.
std::vector<Index> thinned(const std::vector<Index>& grains, std::size_t most);

/// The free grains whose centre, or an image of it in a periodic bed, is within a closed line through these
/// places (m, frame of the bed): from where a ray crosses the line an odd number of times. By ascending ids;
/// none for fewer than three places.
std::vector<Index> grains_within(const BedFrame& bed, std::span<const Vec2> outline);

/// The contact whose point, or an image of it, is nearest to a place (m), not farther than `reach` (m); its
/// place among those of the frame.
std::optional<Index> find_contact(const BedFrame& bed, double x, double y, double reach);

ContactKey key_of(const FrameContacts& contacts, Index c);

/// Where a contact with that key is among those of a frame; none where it carries no force there.
std::optional<Index> contact_of_key(const FrameContacts& contacts, const ContactKey& key);

}  // namespace talus::view
