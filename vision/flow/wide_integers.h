#pragma once

/// Compiles a function twice, also for 256-bit registers. The processor determines the version that runs; the results
/// are equal for integers. They are equal for floating point only while no target has FMA ("avx2" has none), because
/// FMA rounds once instead of twice, and only without reductions, because their order depends on the width of the
/// registers.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__ELF__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define HEDGEHOP_HAS_AVX2
#define HEDGEHOP_WIDE [[gnu::target_clones("avx2", "default")]]
#define HEDGEHOP_TARGET_DEFAULT [[gnu::target("default")]]
#else
#define HEDGEHOP_WIDE
#define HEDGEHOP_TARGET_DEFAULT
#endif
