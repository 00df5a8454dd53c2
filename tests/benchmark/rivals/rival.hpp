#pragma once
// What the searches of other libraries look like to the comparison of searches.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/box.hpp"
#include "core/ids.hpp"

namespace yadefrag {

/// Finds all overlapping pairs of closed boxes, again and again as the boxes move.
class Rival {
 public:
  virtual ~Rival() = default;
  /// Takes the boxes for the first time. They stay in place, and change between calls of `update`.
  virtual void build(std::span<const Box> boxes) = 0;
  /// Follows the boxes; only `changed` (ascending) have moved since the last call.
  virtual void update(std::span<const BoxId> changed) = 0;
  /// All pairs, each once, in any order.
  virtual void findPairs(std::vector<BoxPair>& pairs) = 0;
};

struct RivalName {
  const char* name;
  int dimensions;  ///< 2 or 3 if it supports that number only, 0 otherwise
  bool uneven;     ///< false if boxes of very different size take it too long
};

/// Those that were there to be compiled in.
[[nodiscard]] const std::vector<RivalName>& rivalNames();
[[nodiscard]] std::unique_ptr<Rival> makeRival(const std::string& name, int dimensions,
                                               int threads);

std::unique_ptr<Rival> makeOwn(const std::string& name, int threads);
std::unique_ptr<Rival> makeBvh(int threads);
std::unique_ptr<Rival> makeCells(int dimensions);
std::unique_ptr<Rival> makeCgal(int dimensions);
std::unique_ptr<Rival> makeBoost(int dimensions);
std::unique_ptr<Rival> makeBullet();
std::unique_ptr<Rival> makeBox2d();

/// A box in single precision that holds all of `box`.
struct FloatBox {
  float min[3], max[3];
  explicit FloatBox(const Box& box);
};

}  // namespace yadefrag
