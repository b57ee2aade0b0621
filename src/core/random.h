#pragma once
/// Random numbers that are the same everywhere, unlike std:: distributions, which differ between libraries.

#include <cstdint>

namespace talus {

/// PCG-XSH-RR 64/32 (O'Neill 2014, pcg-random.org). A value: copy it to fork a stream.
struct Random {
  explicit Random(std::uint64_t seed);

  std::uint32_t next();
  /// Uniform in [0, 1), with 53 random bits.
  double uniform();
  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform in 0 ... bound - 1, without bias. bound > 0.
  std::uint32_t below(std::uint32_t bound);

  std::uint64_t state = 0;
};

}  // namespace talus
