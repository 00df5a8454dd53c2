#pragma once
// Acquires Python's lock (the GIL) temporarily.

#include "abi/yade.hpp"

namespace yadefrag {

/// Holds the GIL during its lifetime, whether the thread had it before or not.
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
