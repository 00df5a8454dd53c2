#pragma once
// Checks that the running YADE has the layout that pkg/abi declares. Version, precision and
// features are checked before, in pkg/python/yadefrag/support.py: with another YADE this library
// may even fail to load.

#include <stdexcept>

namespace yadefrag {

// The running YADE is not the version of this build; what() is one sentence for the user.
class UnsupportedYade : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Writes attributes of scratch objects through YADE's Python interface and reads them through the
// declarations. The running scene is only read. Throws UnsupportedYade.
void checkRunningYade();

}  // namespace yadefrag
