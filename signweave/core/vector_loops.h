#pragma once

/// How loops over separate arrays of numbers become vector instructions, for files that are compiled with -O3.

/// A function with such loops is compiled twice, for SSE2 and for AVX2, and the machine's own is taken when the program
/// starts. Both give the same bits: no operation is joined with another (-ffp-contract=off). Sanitizers cannot
/// instrument that choice. (Loops over quaternions as they are stored gain nothing: shuffling eats what the wider
/// vectors give.)
#if defined(__x86_64__) && defined(__GNUC__) && !defined(SIGNWEAVE_SANITIZED)
#define SIGNWEAVE_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define SIGNWEAVE_VECTOR_CLONES
#endif
/// Before a loop: what is written may lie over what is read, but no iteration reads what another writes.
#if defined(__clang__)
#define SIGNWEAVE_INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#else
#define SIGNWEAVE_INDEPENDENT _Pragma("GCC ivdep")
#endif
