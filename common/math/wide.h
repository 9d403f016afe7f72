// Wider vector instructions where the processor has them.
#pragma once

/// Before a function whose loops the compiler should turn into vector instructions: compiled twice, and the
/// one that this processor can run is chosen when the program starts. Both give the same bits: AVX2 brings no
/// fused multiply-add of its own, and -ffp-contract=off forbids the others.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(PENUMBRA_SANITIZED)
#define PENUMBRA_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define PENUMBRA_WIDE
#endif
