#pragma once

/// Put before a function of plain loops: it is compiled for wider vector units too, and the one that the processor has
/// is chosen when the program starts. No sum is reordered and nothing is contracted (-ffp-contract=off), so all give
/// the same bits. Left out under sanitizers, whose start-up the choice would precede, and elsewhere than on x86-64.
#if defined(__x86_64__) && defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define MYOTACT_VECTOR_CLONES
#endif
#endif
#ifndef MYOTACT_VECTOR_CLONES
#define MYOTACT_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#endif
#else
#define MYOTACT_VECTOR_CLONES
#endif

/// Put before a helper of such a function, so that it is compiled as a part of each of them.
#define MYOTACT_INTO_CLONES [[gnu::always_inline]] inline

namespace myotact::simulation {

/// Four doubles side by side, anywhere in memory; the compiler maps them to what the processor has. Only reached
/// through pointers: passed by value they would need a calling convention that older processors lack.
typedef double Pack __attribute__((vector_size(32), aligned(8), may_alias));
/// Eight floats, the same way.
typedef float FloatPack __attribute__((vector_size(32), aligned(4), may_alias));

}  // namespace myotact::simulation
