/// same_bits THREADS: runs the rocked beds on this many threads, and prints ten times the hash of everything
/// that each has gone through until then. same_bits libm: prints a hash of the C library's sines and similar
/// functions, which differ between processors.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "base/hash.h"
#include "reliability/rocked_bed.h"

namespace talus::test {
namespace {

void print_hashes(const RockedBed& bed, int threads) {
  Hasher hash;
  const std::int64_t print_every = bed.steps / 10, look_every = std::max<std::int64_t>(1, bed.steps / 1000);
  const RockedRun run = rock(bed, bed.steps, threads, [&](const World& world) {
    if (world.step % look_every == 0) hash.add(hash_of(world));
    if (world.step % print_every == 0)
      std::printf("%s %lld %s\n", bed.name.c_str(), static_cast<long long>(world.step),
                  hash_text(hash.value()).c_str());
  });
  std::printf("%s changes %lld\n%s team %d\n", bed.name.c_str(), static_cast<long long>(run.changes),
              bed.name.c_str(), run.team);
  std::fflush(stdout);
}

void print_libm() {
  Hasher hash;
  for (int k = 1; k <= 20'000; ++k) {
    const double x = 1e-3 * k;
    for (double value : {std::sin(x), std::cos(x), std::exp(x), std::pow(x, 1.3), std::atan(x)})
      hash.add(value);
  }
  std::printf("libm %s\n", hash_text(hash.value()).c_str());
}

}  // namespace
}  // namespace talus::test

int main(int count, char** arguments) {
  const std::string argument = count == 2 ? arguments[1] : "";
  const int threads = std::atoi(argument.c_str());
  if (argument == "libm") {
    talus::test::print_libm();
  } else if (threads >= 1) {
    for (const auto& bed : talus::test::rocked_beds()) talus::test::print_hashes(bed, threads);
  } else {
    std::fputs("usage: same_bits THREADS | libm\n", stderr);
    return 64;
  }
}
