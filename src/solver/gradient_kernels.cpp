#include "solver/gradient_kernels.h"

namespace talus {

GradientKernels gradient_kernels() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return gradient_kernels_avx2();
#endif
  return gradient_kernels_baseline();
}

}  // namespace talus
