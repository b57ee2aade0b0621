#pragma once
/// Hand-made frames.

#include <cstdint>

#include "core/snapshot.h"

namespace talus::test {

struct Packing {
  Frame frame;
  RunStatics statics;

  operator BedFrame() const { return {frame, statics}; }
};

/// Returns a packing without grains; mean diameter 1 m, friction 0.5.
Packing empty_packing(double length, bool periodic);
/// Appends a free grain and returns its id.
Index add_grain(Packing& packing, double x, double y, double radius = 0.5, Tensor2 moment = {});
/// Appends a floor grain; must follow all free grains.
Index add_floor_grain(Packing& packing, double x, double y, double radius = 0.5);
/// Appends a contact; the normal points to b, and the force (fn, ft) acts on b. Sliding if |ft| = mu fn. A b
/// after all grains is a wall on the right.
void add_contact(Packing& packing, Index a, Index b, double fn, double ft = 0.0, int shift = 0);
/// Appends a contact with the wall on the left, the first body after the grains.
void add_left_wall_contact(Packing& packing, Index a, double fn, double ft = 0.0);
/// Computes internal moments from the contacts, with talus_stress.
void moments_from_contacts(Packing& packing);
/// Computes gamma of all grains from their internal moments.
void gamma_from_moments(Packing& packing);

/// Returns columns x rows grains of diameter 1 in a triangular lattice, with the first row at y = 1/2. Every
/// second row is shifted by half a diameter, so that the lattice is continuous across a period of `columns`.
Packing triangular_lattice(Index columns, Index rows, bool periodic);
/// Returns grains at random places with random symmetric moments of positive trace. Coordinates are multiples
/// of 1/1024 in [0, length) x [0, height), so that differences and images are exact.
Packing random_packing(std::uint64_t seed, Index count, double length, double height, bool periodic);

/// Returns the packing with all x shifted by `shift` modulo the length.
Packing moved(Packing packing, double shift);
/// Returns the packing mirrored: x' = length - x, modulo the length if periodic.
Packing mirrored(Packing packing);

}  // namespace talus::test
