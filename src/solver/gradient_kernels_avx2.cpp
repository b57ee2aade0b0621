#define KERNEL_NAME gradient_kernels_avx2
#include "solver/gradient_kernels.inc"
