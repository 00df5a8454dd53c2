#pragma once
// Which points are slaves of which surfaces (paper §2: single and double passing).

#include <cstdint>
#include <span>
#include <vector>

#include "core/footprint.hpp"
#include "mesh/model.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

/// Single pass: of two surfaces the finer one's sampling points are slaves, and the sharp corners
/// of the coarser one, which would otherwise pass through the finer one's segments unseen. Within
/// one surface, and in a double pass, every point is a slave.
class PassRule {
 public:
  /// Looks at the surfaces as they are at `positions` (m, by node).
  void update(const ContactSurfaces& surfaces, std::span<const Vec2> positions, int passes);

  [[nodiscard]] bool mayBeSlave(EntryId slave, std::uint32_t slaveLoop,
                                std::uint32_t masterLoop) const {
    return passes_ == 2 || slaveLoop == masterLoop || isFiner(slaveLoop, masterLoop) ||
           sharp_[slave.value] != 0;
  }

  void addTo(Footprint& footprint) const { footprint.add(Use::kSearch, fineness_, sharp_); }

 private:
  [[nodiscard]] bool isFiner(std::uint32_t a, std::uint32_t b) const {
    return fineness_[a] != fineness_[b] ? fineness_[a] < fineness_[b] : a > b;
  }

  int passes_ = 1;
  std::vector<double> fineness_;     ///< m, mean length of a loop's pieces
  std::vector<std::uint8_t> sharp_;  ///< by entry: is its sampling point a sharp convex corner
};

}  // namespace yadefrag
