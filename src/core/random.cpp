#include "core/random.h"

namespace talus {
namespace {
constexpr std::uint64_t pcg_multiplier = 6364136223846793005ULL;
constexpr std::uint64_t pcg_increment = 1442695040888963407ULL;
}  // namespace

Random::Random(std::uint64_t seed) : state(seed + pcg_increment) { next(); }

std::uint32_t Random::next() {
  const std::uint64_t old = state;
  state = old * pcg_multiplier + pcg_increment;
  const auto shifted = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
  const auto rotation = static_cast<std::uint32_t>(old >> 59);
  return (shifted >> rotation) | (shifted << ((32 - rotation) & 31));
}

double Random::uniform() {
  const std::uint64_t high = next();
  const std::uint64_t bits = (high << 21) ^ next() >> 11;  // 32 + 21 = 53 bits
  return static_cast<double>(bits) * 0x1.0p-53;
}

std::uint32_t Random::below(std::uint32_t bound) {
  const std::uint32_t threshold = (0u - bound) % bound;
  for (;;) {
    const std::uint32_t draw = next();
    if (draw >= threshold) return draw % bound;
  }
}

}  // namespace talus
