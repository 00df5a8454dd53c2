#pragma once
// The data that yade.timing reads.

namespace yade {

struct TimingInfo {
  using delta = unsigned long long;
  long nExec;
  delta nsec;
  static bool enabled;
};

class TimingDeltas;  // used by pointer only

}  // namespace yade
