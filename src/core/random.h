#pragma once
/// Random numbers that are the same on every platform, unlike those of std:: distributions.

#include <cstdint>

namespace talus {

/// Generator PCG-XSH-RR 64/32 (O'Neill 2014, pcg-random.org). A copy forks the stream.
struct Random {
  explicit Random(std::uint64_t seed);

  std::uint32_t next();
  /// Returns a number uniform in [0, 1), with 53 random bits.
  double uniform();
  /// Returns a number uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Returns an integer uniform in 0 ... bound - 1, without bias. bound > 0.
  std::uint32_t below(std::uint32_t bound);

  std::uint64_t state = 0;
};

}  // namespace talus
