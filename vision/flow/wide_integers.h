#pragma once

/// Marks a function of whole numbers alone to be compiled twice, also for registers of 256 bits: which one runs depends
/// on the processor, what it computes does not. Never for floating point.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__ELF__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define HEDGEHOP_HAS_AVX2
#define HEDGEHOP_WIDE [[gnu::target_clones("avx2", "default")]]
#define HEDGEHOP_TARGET_DEFAULT [[gnu::target("default")]]
#else
#define HEDGEHOP_WIDE
#define HEDGEHOP_TARGET_DEFAULT
#endif
