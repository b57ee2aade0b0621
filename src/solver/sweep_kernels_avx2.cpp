#define KERNEL_NAME sweep_kernels_avx2
#include "solver/sweep_kernels.inc"
