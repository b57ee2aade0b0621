#pragma once
/// Frames made by hand.

#include <cstdint>

#include "core/bed_frame.h"

namespace talus::test {

struct Packing {
  Frame frame;
  RunStatics statics;

  operator BedFrame() const { return {frame, statics}; }
};

/// No grains yet; mean diameter 1 m, friction 0.5.
Packing empty_packing(double length, bool periodic);
/// Appends a free grain and returns its id.
Index add_grain(Packing& packing, double x, double y, double radius = 0.5, Tensor2 moment = {});
/// Appends a grain of the floor; after all free grains.
Index add_floor_grain(Packing& packing, double x, double y, double radius = 0.5);
/// Appends a contact; the normal points to b, the force (fn, ft) acts on b. Sliding where |ft| = mu fn.
void add_contact(Packing& packing, Index a, Index b, double fn, double ft = 0.0, int shift = 0);
/// Internal moments from the contacts, with talus_stress.
void moments_from_contacts(Packing& packing);
/// gamma of all grains from their internal moments.
void gamma_from_moments(Packing& packing);

/// Columns x rows grains of diameter 1 in a triangular lattice, a row at y = 1/2 first; each other row is
/// moved by half a diameter, so that the lattice is whole across a period of `columns`.
Packing triangular_lattice(Index columns, Index rows, bool periodic);
/// Grains at random places, with random symmetric moments of positive trace. Coordinates are multiples of
/// 1/1024 in [0, length) x [0, height), so that differences and images are exact.
Packing random_packing(std::uint64_t seed, Index count, double length, double height, bool periodic);

/// All x moved by `shift` modulo the length.
Packing moved(Packing packing, double shift);
/// Turned by 90 deg: x' = -y, y' = x. Not for a periodic packing.
Packing turned(Packing packing);
/// x' = length - x, modulo the length where periodic.
Packing mirrored(Packing packing);

}  // namespace talus::test
