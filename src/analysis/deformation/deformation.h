#pragma once
/// Local strain and non-affine displacement of the neighbourhood of each grain between two frames.

#include <vector>

#include "analysis/cells.h"
#include "analysis/record.h"
#include "core/snapshot.h"
#include "core/tensor.h"

namespace talus::analysis {

/// Radius of the neighbourhood of a grain, in D: neighbours are the grains, floor grains included, with
/// centres within this distance of its own, the first two shells.
inline constexpr double deformation_reach = 2.0;

/// Share of the grains, those with the largest strain, whose part of the total strain measures localisation.
inline constexpr double most_strained_share = 0.1;

/// Deformation of the neighbours of one grain. NaN if they do not span the plane: fewer than two, or in one
/// line.
struct LocalDeformation {
  /// G = F - 1, the gradient of displacements du_i / dX_j that best fits those of the neighbours relative to
  /// the grain.
  Tensor2 gradient{not_known, not_known, not_known, not_known};
  /// D2min of Falk and Langer (1998), m^2, here the mean over the neighbours of the squared residual; theirs
  /// is the sum.
  double nonaffine = not_known;
};

/// Returns the deformation of each free grain from frame `before` to frame `bed`, with the neighbours in the
/// earlier frame (T27), (T28). Displacements are unwrapped across the period; only the nearest periodic image
/// of a neighbour counts. NaN throughout if the two frames do not have the same grains.
std::vector<LocalDeformation> local_deformations(const Frame& before, const BedFrame& bed);

// Strain measures of F = 1 + G = R U, a stretch U with principal values s1 >= s2 followed by a rotation R.
// They are exact for large displacements, and a rigid motion of all neighbours has no strain. (T29)

/// Returns s1 - s2 >= 0, which for simple shear is the shear strain; for the gradient of a velocity the shear
/// rate, 1/s: 2 sqrt(-det) of the deviator of its symmetric part.
double shear_strain(const Tensor2& gradient);
/// Returns the relative change of area, det F - 1; negative if the neighbourhood contracts.
double area_strain(const Tensor2& gradient);
/// Returns twice the angle of R, rad, counter-clockwise positive; for small displacements this is their curl.
double vorticity(const Tensor2& gradient);

/// Sets members of a record that are defined in the table of quantities.
void measure_deformation(const Frame& before, const BedFrame& bed, FrameRecord& record);

// Continuum fields of the bed by coarse graining (Goldhirsch 2010) with the boundary forces of Weinhart et
// al. (2012). The fields satisfy the balances of mass and momentum exactly up to the floor and walls, and
// their integrals equal the sums over the packing.

/// Diameter of the support of the coarse-graining function for the granular temperature in analyses, in D.
inline constexpr double temperature_width = 5.0;

/// Returns Lucy's function in the plane at a distance (m) from its centre, 1/m^2. It vanishes from `cutoff`
/// (m) outwards and has an integral of 1. (T31)
double lucy_function(double distance, double cutoff);

/// The fields of the free grains at one point, in the frame of the bed and per metre of thickness.
struct CoarseField {
  double density = 0.0;    ///< kg/m^3 (T32)
  Vec2 momentum;           ///< momentum density, kg/(m^2 s) (T32)
  Tensor2 contact_stress;  ///< Pa, compression positive; the first index is that of the branch vector (T33)
  Tensor2 kinetic_stress;  ///< Pa, from the velocities relative to the field at this point (T34)
  Vec2 boundary_force;     ///< force density of floor and walls on grains, N/m^3; 0 far from them (T35)
  Tensor2 velocity_gradient;  ///< dV_i / dx_j of V = momentum / density, 1/s; NaN if density is 0 (T36)
  /// Granular temperature, m^2/s^2 (T37); NaN with fewer than four grains, or if all are in one line.
  double temperature = not_known;

  /// Returns the velocity V, momentum over density, m/s; NaN if the density is 0.
  Vec2 velocity() const { return {momentum.x / density, momentum.y / density}; }
  /// Returns the total stress, contact plus kinetic, Pa, compression positive.
  Tensor2 stress() const;
};

/// The continuum fields of a frame. Holds copies of all the data it needs.
class CoarseFields {
 public:
  /// Prepares the fields. `cutoff`: radius of the support of the coarse-graining function, m, at most half
  /// the period.
  CoarseFields(const BedFrame& bed, double cutoff) : CoarseFields(bed, cutoff, true) {}

  /// Returns the fields at the point (x, y), m, in the frame of the bed.
  CoarseField at(double x, double y) const;

 private:
  /// Sources of a field: grains at their own positions, or points on branch vectors with their share of the
  /// stress.
  template <typename What>
  struct Sources {
    std::vector<double> x, y;
    std::vector<What> what;
    Cells cells;
  };
  struct MovingMass {
    double mass;
    Vector2 velocity;
  };
  friend std::vector<double> granular_temperatures(const BedFrame& bed, double cutoff);

  CoarseFields(const BedFrame& bed, double cutoff, bool with_contacts);
  void add_contacts(const BedFrame& bed);
  template <typename What, typename Visit>
  void visit_sources(const Sources<What>& sources, double x, double y, const Visit& visit) const;

  double cutoff_, period_;
  Sources<MovingMass> grains_;
  Sources<Tensor2> branches_;
  Sources<Vector2> boundary_;
};

/// Returns the temperature of CoarseFields at the centre of each free grain; contacts have no effect.
std::vector<double> granular_temperatures(const BedFrame& bed, double cutoff);

/// Sets members of a record that are defined in the table of quantities.
void measure_granular_temperature(const BedFrame& bed, FrameRecord& record);

}  // namespace talus::analysis
