#pragma once

/// Lets loops over separate arrays of numbers compile to vector instructions, in files that are compiled with -O3. A
/// function with such loops is compiled twice, for SSE2 and for AVX2, and the version for the machine is selected when
/// the program starts. Both give the same bits, because operations are never fused (-ffp-contract=off). Sanitizers
/// cannot instrument this selection. (Loops over quaternions in their stored layout gain nothing: shuffling costs what
/// the wider vectors save.)

#if defined(__x86_64__) && defined(__GNUC__) && !defined(SIGNWEAVE_SANITIZED)
#define SIGNWEAVE_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define SIGNWEAVE_VECTOR_CLONES
#endif
/// Put before a loop: the output may overlap the input, but no iteration reads what another one writes.
#if defined(__clang__)
#define SIGNWEAVE_INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#else
#define SIGNWEAVE_INDEPENDENT _Pragma("GCC ivdep")
#endif
