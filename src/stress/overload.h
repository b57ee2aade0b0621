#pragma once
/// Which grains are overloaded.

namespace talus {

/// Whether a grain with stress ratio `gamma` carries more than the packing's Coulomb threshold
/// Gamma_c = sin(theta_c): gamma >= gamma_c (paper, section V A). A grain that carries nothing (NaN) is not.
inline bool is_overloaded(double gamma, double gamma_c) { return gamma >= gamma_c; }

}  // namespace talus
