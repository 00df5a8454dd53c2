#pragma once

#include <cstdint>

namespace yadefrag {

/// Counts nothing. examples/figure14 passes a class that counts comparisons instead.
struct Uncounted {
  void resort(std::uint64_t) {}
  void range(std::uint64_t) {}
};

}  // namespace yadefrag
