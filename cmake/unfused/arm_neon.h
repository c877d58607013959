// The compiler's own, less the macro by which Eigen decides to join a multiplication and an addition into one instruction, which
// rounds once: x86-64's baseline has none, and results should be the same (signweave_compiler.cmake).
#include_next <arm_neon.h>
#undef __ARM_FEATURE_FMA
