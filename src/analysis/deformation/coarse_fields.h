#pragma once
/// Fields of the bed as a continuum, by coarse graining: Goldhirsch (2010), with the boundaries of Weinhart
/// and others (2012). They obey the balances of mass and momentum exactly, up to floor and walls, and their
/// integrals are the packing's own sums.

#include <vector>

#include "analysis/cells.h"
#include "analysis/record.h"
#include "core/bed_frame.h"
#include "core/tensor.h"

namespace talus::analysis {

/// Diameter, in D, of the support of the coarse-graining function with which an analysis finds the granular
/// temperature.
inline constexpr double temperature_width = 5.0;

/// Lucy's function in the plane at a distance from its centre, 1/m^2: 0 from `cutoff` (m) on, with an
/// integral of 1. (T31)
double lucy_function(double distance, double cutoff);

/// The fields at one point, in the frame of the bed and per metre of thickness, of free grains.
struct CoarseField {
  double density = 0.0;            ///< kg/m^3 (T32)
  Vec2 momentum;                   ///< density of momentum, kg/(m^2 s) (T32)
  Tensor2 contact_stress;          ///< Pa, compression positive; index of the lever first (T33)
  Tensor2 kinetic_stress;          ///< Pa, of velocities about the field's own there (T34)
  Vec2 boundary_force;             ///< force of floor and walls on grains, N/m^3: 0 farther from them (T35)
  Tensor2 velocity_gradient;       ///< dV_i / dx_j of V = momentum / density, 1/s; NaN where nothing is (T36)
  double temperature = not_known;  ///< m^2/s^2 (T37); NaN with less than four grains, or all in one line

  Vec2 velocity() const { return {momentum.x / density, momentum.y / density}; }
  Tensor2 stress() const;
};

/// 2 sqrt(-det) of the deviator of the symmetric part of a velocity gradient, 1/s: the shear rate of a simple
/// shear.
double shear_rate(const Tensor2& velocity_gradient);

/// A frame, ready to be looked at as a continuum. It keeps what it needs.
class CoarseFields {
 public:
  /// `cutoff`: radius of the support of the coarse-graining function, m; twice it is not above the period.
  CoarseFields(const BedFrame& bed, double cutoff);

  CoarseField at(double x, double y) const;

 private:
  /// Grains at places of their own, or points of branch vectors with their part of the stress.
  template <typename What>
  struct Sources {
    std::vector<double> x, y;
    std::vector<What> what;
    Cells cells;
  };
  struct Moving {
    double mass;
    Vector2 velocity;
  };
  friend std::vector<double> granular_temperatures(const BedFrame& bed, double cutoff);

  CoarseFields(const BedFrame& bed, double cutoff, bool with_contacts);
  void add_contacts(const BedFrame& bed);
  template <typename What, typename Visit>
  void near(const Sources<What>& sources, double x, double y, const Visit& visit) const;

  double cutoff_, period_;
  Sources<Moving> grains_;
  Sources<Tensor2> branches_;
  Sources<Vector2> boundary_;
};

/// The temperature at the centre of each free grain, as CoarseFields has it; contacts do not matter.
std::vector<double> granular_temperatures(const BedFrame& bed, double cutoff);

/// Sets members of a record, defined in the table of quantities.
void take_granular_temperature(const BedFrame& bed, FrameRecord& record);

}  // namespace talus::analysis
