#include "solver/sweep_kernels.h"

namespace talus::solver {

SweepKernels sweep_kernels() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return sweep_kernels_avx2();
#endif
  return sweep_kernels_baseline();
}

}  // namespace talus::solver
