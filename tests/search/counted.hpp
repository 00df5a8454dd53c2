#pragma once
// Counts comparisons of a list or directory of codes.

#include <cstdint>

namespace yadefrag {

struct Counted {
  std::uint64_t number = 0;
  void range(std::uint64_t more) { number += more; }
  void resort(std::uint64_t more) { number += more; }
};

}  // namespace yadefrag
