// The compiler's own header without the macro by which Eigen decides to fuse a multiplication and an addition into one
// instruction, which rounds once: the x86-64 baseline has none, and results should agree (signweave_compiler.cmake).
#include_next <arm_neon.h>
#undef __ARM_FEATURE_FMA
