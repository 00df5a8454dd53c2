#pragma once
// What yade.timing reads.

namespace yade {

struct TimingInfo {
  using delta = unsigned long long;
  long nExec;
  delta nsec;
  static bool enabled;
};

class TimingDeltas;  // only ever held by pointer

}  // namespace yade
