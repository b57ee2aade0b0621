#define KERNEL_NAME sweep_kernels_baseline
#include "solver/sweep_kernels.inc"
