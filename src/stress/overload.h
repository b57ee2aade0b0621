#pragma once
/// Which grains are overloaded (paper, section V A).

#include "core/bed_frame.h"

namespace talus::stress {

/// Whether a grain with stress ratio `gamma` carries more than the packing's Coulomb threshold
/// Gamma_c = sin(theta_c): gamma >= gamma_c (T23). A grain that carries nothing (NaN) is not.
inline bool is_overloaded(double gamma, double gamma_c) { return gamma >= gamma_c; }

/// Overloaded among the free grains of a frame.
struct OverloadCount {
  Index overloaded = 0;
  Index loaded = 0;  ///< grains that carry something

  /// p_o; NaN where no grain carries anything.
  double fraction() const { return static_cast<double>(overloaded) / static_cast<double>(loaded); }
};
OverloadCount count_overloaded(const BedFrame& bed, double gamma_c);

}  // namespace talus::stress
