#define KERNEL_NAME gradient_kernels_baseline
#include "solver/gradient_kernels.inc"
