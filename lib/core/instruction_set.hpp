#pragma once
// Vector instructions for which some loops are compiled separately.

namespace yadefrag {

/// Results have the same bits with each.
enum class InstructionSet { kBaseline, kAvx2, kAvx512 };

/// The instruction set of this machine for most loops.
inline InstructionSet bestInstructionSet() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2")) return InstructionSet::kAvx2;
#endif
  return InstructionSet::kBaseline;
}

/// The widest instruction set of this machine, for the loops that gain by it (`runForWide`).
inline InstructionSet widestInstructionSet() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx2"))
    return InstructionSet::kAvx512;
#endif
  return bestInstructionSet();
}

/// Runs `work()`, compiled for the instruction set. Its operator must be always inlined.
template <class Work>
auto runBaseline(Work work) {
  return work();
}
#ifdef __x86_64__
template <class Work>
[[gnu::target("avx2")]] auto runAvx2(Work work) {
  return work();
}
// Without the last word GCC would use half of each register.
#ifdef __clang__
#define YADEFRAG_WIDE "avx512f,avx512dq,avx512vl"
#else
#define YADEFRAG_WIDE "avx512f,avx512dq,avx512vl,prefer-vector-width=512"
#endif
template <class Work>
[[gnu::target(YADEFRAG_WIDE)]] auto runAvx512(Work work) {
  return work();
}
#undef YADEFRAG_WIDE
#endif

template <class Work>
auto runFor(InstructionSet set, Work work) {
#ifdef __x86_64__
  if (set != InstructionSet::kBaseline) return runAvx2(work);
#endif
  static_cast<void>(set);
  return runBaseline(work);
}

/// The same, with AVX-512, too.
template <class Work>
auto runForWide(InstructionSet set, Work work) {
#ifdef __x86_64__
  if (set == InstructionSet::kAvx512) return runAvx512(work);
#endif
  return runFor(set, work);
}

}  // namespace yadefrag
