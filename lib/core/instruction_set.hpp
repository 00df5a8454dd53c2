#pragma once
// Vector instructions for which some loops are compiled separately.

namespace yadefrag {

/// Results have the same bits with each.
enum class InstructionSet { kBaseline, kAvx2 };

/// The widest instruction set of this machine.
inline InstructionSet bestInstructionSet() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2")) return InstructionSet::kAvx2;
#endif
  return InstructionSet::kBaseline;
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
#endif

template <class Work>
auto runFor(InstructionSet set, Work work) {
#ifdef __x86_64__
  if (set == InstructionSet::kAvx2) return runAvx2(work);
#endif
  static_cast<void>(set);
  return runBaseline(work);
}

}  // namespace yadefrag
