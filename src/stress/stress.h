#pragma once
/// Stress turns the contact forces of a World or Frame into the stresses of grains: the internal moment of
/// each grain, its stress state with the ratio Gamma = Q/P, and whether that is overloaded. free_surface.h
/// has the shape of the bed.
///
/// Principal values and ratios of a stress or of an internal moment, (T21) and (T22) of docs/theory.md.

#include <span>
#include <vector>

#include "core/snapshot.h"
#include "core/types.h"
#include "core/world.h"

namespace talus::stress {

/// Stress state of the symmetric part of a tensor.
struct StressState {
  double mean = 0.0;      ///< P = s1 + s2 (the paper's convention: no factor 1/2)
  double deviator = 0.0;  ///< Q = s1 - s2 >= 0
  double ratio = 0.0;     ///< Gamma = Q/P; NaN if P <= 0, as in a grain that carries no load
  double axis = 0.0;      ///< angle of the major principal direction to x, rad, in (-pi/2, pi/2]
};

StressState stress_state(const Tensor2& tensor);

// Grain stresses: the internal moments of Moreau (1997; paper, Eq. 4; docs/theory.md).

/// Computes the internal moment of each grain, M_ij = - sum_a r_i f_j - (1/2) I omega^2 delta_ij (T19), with
/// r from the centre of the grain to the contact and f the force on the grain: one tensor for each grain,
/// floor included, in J per metre of thickness. Compression is positive. yx - xy is the torque of the contact
/// forces on the grain, counter-clockwise positive; at rest it vanishes, and M is symmetric, unless contacts
/// resist rolling. The moment of a set of grains is the sum of their moments.
void internal_moments(const Grains& grains, const Contacts& contacts, std::vector<Tensor2>& moments);

/// Returns the sum of the moments of grains first ... last - 1, in that order.
Tensor2 sum_of_moments(const std::vector<Tensor2>& moments, Index first, Index last);

// Overloaded grains (paper, section V A).

/// Whether a grain with stress ratio `gamma` is overloaded, gamma >= gamma_c (T23), with the Coulomb
/// threshold of the packing Gamma_c = sin(theta_c). A grain that carries no load (NaN) is not overloaded.
inline bool is_overloaded(double gamma, double gamma_c) { return gamma >= gamma_c; }

/// Numbers of overloaded and of loaded grains among the free grains of a frame.
struct OverloadCount {
  Index overloaded = 0;
  Index loaded = 0;  ///< number of grains that carry load

  /// Returns p_o; NaN if no grain carries load.
  double fraction() const { return static_cast<double>(overloaded) / static_cast<double>(loaded); }
};
OverloadCount count_overloaded(const BedFrame& bed, double gamma_c);

// Scalars of the entire bed.

/// Returns the area of the free grains, m^2.
double solid_area(const Grains& grains);

/// Returns the height of the centre of mass of the free grains above y = 0, m.
double centre_of_mass_height(const Grains& grains);

/// Returns the status of a contact with given forces. Sliding means |f_t| = mu f_n within `tolerance` f_n.
ContactStatus contact_status(double fn, double ft, double friction, double tolerance = 1e-6);

/// Returns the number of contacts of each of the first `count` grains. Contact c is between the bodies a[c]
/// and b[c], and carries force, as all contacts of a frame.
std::vector<Index> contacts_of_grains(std::span<const Index> a, std::span<const Index> b, Index count);

/// Returns the coordination number z: mean number of contacts of the grains that have any; 0 if none has.
double coordination_number(std::span<const Index> contacts_of_grains);

}  // namespace talus::stress
