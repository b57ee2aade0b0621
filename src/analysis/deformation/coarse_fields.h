#pragma once
/// Continuum fields of the bed by coarse graining (Goldhirsch 2010) with the boundary forces of Weinhart et
/// al. (2012). The fields satisfy the balances of mass and momentum exactly up to the floor and walls, and
/// their integrals equal the sums over the packing.

#include <vector>

#include "analysis/cells.h"
#include "analysis/record.h"
#include "core/bed_frame.h"
#include "core/tensor.h"

namespace talus::analysis {

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

/// Returns the shear rate, 2 sqrt(-det) of the deviator of the symmetric part of a velocity gradient, 1/s;
/// for simple shear this is the usual rate.
double shear_rate(const Tensor2& velocity_gradient);

/// The continuum fields of a frame. Holds copies of all the data it needs.
class CoarseFields {
 public:
  /// Prepares the fields. `cutoff`: radius of the support of the coarse-graining function, m, at most half
  /// the period.
  CoarseFields(const BedFrame& bed, double cutoff);

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
