#pragma once
// Forces and torques on bodies, read without a call for each body.

#include <cstddef>

#include "abi/yade.hpp"
#include "core/four_lanes.hpp"

namespace yadefrag {

/// Of one step, after ForceContainer::sync. YADE's arrays may end before the last body: those
/// behind have no force.
class SummedForces {
 public:
  SummedForces() = default;
  SummedForces(yade::ForceContainer& forces, std::size_t numBodies) {
    if (numBodies == 0) return;
    // A YADE without OpenMP makes its arrays longer where they end before a body.
    const auto last = static_cast<int>(numBodies) - 1;
    forces.getForce(last), forces.getTorque(last);
    forces_ = &forces.getForce(0), torques_ = &forces.getTorque(0);
    // YADE's function returns an element of its array, or for bodies behind its end another zero.
    const auto isInArray = [&](std::size_t id) {
      return &forces.getForce(static_cast<int>(id)) == forces_ + id;
    };
    std::size_t above = numBodies;
    while (size_ < above) {
      const std::size_t middle = size_ + (above - size_) / 2;
      isInArray(middle) ? size_ = middle + 1 : above = middle;
    }
  }
  [[gnu::always_inline]] [[nodiscard]] FourLanes forceOn(std::size_t id) const {
    return id < size_ ? loadThree(forces_[id].data()) : FourLanes{};
  }
  [[gnu::always_inline]] [[nodiscard]] FourLanes torqueOn(std::size_t id) const {
    return id < size_ ? loadThree(torques_[id].data()) : FourLanes{};
  }

 private:
  const yade::Vector3r* forces_ = nullptr;
  const yade::Vector3r* torques_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace yadefrag
