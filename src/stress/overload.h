#pragma once
/// Overloaded grains (paper, section V A).

#include "core/bed_frame.h"

namespace talus::stress {

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

}  // namespace talus::stress
