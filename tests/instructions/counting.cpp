// For tests/benchmark/unused_spheres.py, which loads it into yade: it starts and stops the counting
// of callgrind.

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>

extern "C" void startCounting() {
  CALLGRIND_START_INSTRUMENTATION;
  CALLGRIND_ZERO_STATS;
}

/// What was counted goes to a file of its own, the next of a row.
extern "C" void stopCounting() {
  CALLGRIND_STOP_INSTRUMENTATION;
  CALLGRIND_DUMP_STATS;
}
#else
extern "C" void startCounting() {}
extern "C" void stopCounting() {}
#endif
