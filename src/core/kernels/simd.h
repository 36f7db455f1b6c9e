// What a kernel file includes, after it has named itself:
//
//   #undef HWY_TARGET_INCLUDE
//   #define HWY_TARGET_INCLUDE "core/kernels/this_file.cpp"
//   #include "core/kernels/simd.h"
//
// With Highway the file is then compiled once for each instruction set, and HWY_DYNAMIC_DISPATCH calls the best one for
// the processor at hand. Without Highway it is compiled once, with lanes of one number. Kernel files include neither
// Eigen nor PCL: code for different instruction sets must not share inline functions that depend on alignment.
//
// Kernels give the same bits with every instruction set: sums run over a fixed number of lanes, whatever the width of
// the registers, and products are not fused with sums. No include guard: it is read once per instruction set.

#ifdef GRASP_AFFORDANCES_HIGHWAY
#include <hwy/foreach_target.h>  // before highway.h

#include <hwy/highway.h>
#else
#include "core/kernels/simd_scalar.h"
#endif
