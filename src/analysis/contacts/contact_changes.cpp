#include "analysis/contacts/contact_changes.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "base/errors.h"

namespace talus::analysis {
namespace {

/// Identification of a contact that is the same in every frame.
struct ContactKey {
  Index a = 0, b = 0;
  Index image = 0;  ///< number of additional periods at which b touches a, compared with the unwrapped bed
  Index place = 0;  ///< index in its frame

  auto bodies() const { return std::array<Index, 3>{a, b, image}; }
};

std::vector<ContactKey> keys_of(const Frame& frame) {
  const FrameContacts& contacts = frame.contacts;
  std::vector<ContactKey> keys;
  keys.reserve(contacts.a.size());
  for (Index c = 0; c < contacts.count(); ++c) {
    const Index a = contacts.a[c], b = contacts.b[c];
    const bool grains = b < frame.grain_count();  // otherwise a plane, which has one image
    keys.push_back({a, b, grains ? contacts.shift[c] + frame.image[a] - frame.image[b] : 0, c});
  }
  std::ranges::sort(keys, {}, &ContactKey::bodies);
  return keys;
}

/// Returns the indices of the contacts in the first list that are not in the second.
std::vector<Index> places_of_rest(const std::vector<ContactKey>& keys,
                                  const std::vector<ContactKey>& without) {
  std::vector<ContactKey> rest;
  std::ranges::set_difference(keys, without, std::back_inserter(rest), {}, &ContactKey::bodies,
                              &ContactKey::bodies);
  std::vector<Index> places;
  for (const ContactKey& key : rest) places.push_back(key.place);
  std::ranges::sort(places);
  return places;
}

}  // namespace

ContactChanges contact_changes(const Frame& before, const Frame& after) {
  if (before.grain_count() != after.grain_count())
    throw Error(ExitCode::internal, "cannot compare the contacts of frames with different grains");
  const std::vector<ContactKey> earlier = keys_of(before), later = keys_of(after);
  return {places_of_rest(later, earlier), places_of_rest(earlier, later)};
}

}  // namespace talus::analysis
