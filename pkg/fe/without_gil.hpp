#pragma once
// Python's lock (the GIL), given up for a while.

#include "abi/basics.hpp"

namespace yadefrag {

/// Gives the GIL up as long as it lives; does nothing in a thread that does not hold it.
class WithoutGil {
 public:
  WithoutGil() : state_(PyGILState_Check() != 0 ? PyEval_SaveThread() : nullptr) {}
  ~WithoutGil() {
    if (state_) PyEval_RestoreThread(state_);
  }
  WithoutGil(const WithoutGil&) = delete;
  WithoutGil& operator=(const WithoutGil&) = delete;

 private:
  PyThreadState* const state_;
};

}  // namespace yadefrag
