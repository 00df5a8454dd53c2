#pragma once
// Releases Python's lock (the GIL) temporarily.

#include "abi/yade.hpp"

namespace yadefrag {

/// Releases the GIL during its lifetime; does nothing in a thread that does not have it.
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
