#pragma once
/// The parameters of the contact law.

namespace talus::dynamics {

struct ContactLawParameters {
  double friction = 0.5;                ///< mu between grains, and with the floor
  double wall_friction = 0.5;           ///< mu with the side walls
  double rolling_friction = 0.0;        ///< mu_r between grains, and with the floor; walls have none
  double restitution = 0.0;             ///< e_n: U_n+ = -e_n U_n- (Newton)
  double tangential_restitution = 0.0;  ///< e_t: U_t+ = -e_t U_t- of a contact that sticks
  double allowed_overlap = 0.0;         ///< m: overlaps up to this stay as they are
  double overlap_correction = 0.05;     ///< share of what an overlap is above the allowed, taken back in each
                                        ///< step, or less (T11)
};

}  // namespace talus::dynamics
