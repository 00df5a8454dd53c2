#pragma once
// Is the running YADE laid out as pkg/abi declares it? Version, precision and features come first,
// in pkg/python/yadefrag/support.py: another YADE may not even let this library load.

#include <stdexcept>

namespace yadefrag {

// The running YADE is not the one this was built for; what() is one sentence for the user.
class UnsupportedYade : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Writes attributes of scratch objects through YADE's Python and reads them through the
// declarations. The running scene is read only. Throws UnsupportedYade.
void checkRunningYade();

}  // namespace yadefrag
