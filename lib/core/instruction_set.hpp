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

}  // namespace yadefrag
