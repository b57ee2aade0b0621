#pragma once
/// Parameters of the contact law.

namespace talus::dynamics {

struct ContactLawParameters {
  double friction = 0.5;                ///< mu between grains, and between grains and floor
  double wall_friction = 0.5;           ///< mu with the side walls
  double rolling_friction = 0.0;        ///< mu_r between grains, and between grains and floor; 0 at walls
  double restitution = 0.0;             ///< e_n: U_n+ = -e_n U_n- (Newton)
  double tangential_restitution = 0.0;  ///< e_t: U_t+ = -e_t U_t- of a sticking contact
  double allowed_overlap = 0.0;         ///< m; smaller overlaps are not corrected
  double overlap_correction = 0.05;  ///< largest share of the excess of an overlap over the allowed one that
                                     ///< is removed in a step (T11)
};

}  // namespace talus::dynamics
