#pragma once
// Python's lock (the GIL), taken for a while.

#include "abi/basics.hpp"

namespace yadefrag {

/// Holds the GIL as long as it lives, whether the thread had it or not.
class WithGil {
 public:
  WithGil() : state_(PyGILState_Ensure()) {}
  ~WithGil() { PyGILState_Release(state_); }
  WithGil(const WithGil&) = delete;
  WithGil& operator=(const WithGil&) = delete;

 private:
  const PyGILState_STATE state_;
};

}  // namespace yadefrag
