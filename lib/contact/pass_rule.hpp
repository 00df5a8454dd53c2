#pragma once
// Selection of slaves for pairs of surfaces (paper §2: single and double passing).

#include <cstdint>
#include <span>
#include <vector>

#include "core/tolerances/contact.hpp"
#include "mesh/model.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

struct ContactSettings {
  /// 1: of two surfaces the points of the finer one are slaves, and the sharp corners of the other.
  /// 2: every point of both.
  int passes = 1;
  /// Width of the halo over the shortest segment; 0: determined by the bodies' speed.
  double halo = 0;
  tolerance::Contact constants = {};  ///< tests halve and double each of them
};

/// Single pass: of two surfaces the sampling points of the finer one are slaves, and the sharp
/// corners of the coarser one, which would otherwise pass through the finer one's segments
/// undetected. Within one surface, with bodies that can crack, and in a double pass, every point is
/// a slave: a crack creates corners and surfaces. Rejected: new roles at cracks; existing
/// candidates kept the old roles until the next search, so that results depended on the time of
/// that search. All points are slaves of rigid boundaries. Of the points of rigid boundaries only
/// the sharp corners are slaves, in a double pass all convex ones.
class PassRule {
 public:
  /// `reference`: m, stress-free, by node, so that motion does not change the roles. `anyRigid`:
  /// true if there are rigid boundaries.
  void update(const ContactSurfaces& surfaces, std::span<const Vec2> reference,
              const ContactSettings& settings, bool anyRigid = false);

  [[nodiscard]] bool mayBeSlave(const Model& model, const ContactSurfaces& surfaces, EntryId slave,
                                EntryId master) const {
    if (anyRigid_ && isRigid(model, surfaces, slave)) return sharp_[slave.value] != 0;
    if (anyRigid_ && isRigid(model, surfaces, master)) return true;
    if (passes_ == 2 || mayCrack(model, surfaces, slave) || mayCrack(model, surfaces, master))
      return true;
    const std::uint32_t own = surfaces.loop[slave.value], other = surfaces.loop[master.value];
    return own == other || isFiner(own, other) || sharp_[slave.value] != 0;
  }

 private:
  [[nodiscard]] static bool isRigid(const Model& model, const ContactSurfaces& surfaces,
                                    EntryId entry) {
    return model.components[surfaces.component[entry.value].value].rigid;
  }
  [[nodiscard]] static bool mayCrack(const Model& model, const ContactSurfaces& surfaces,
                                     EntryId entry) {
    return model.components[surfaces.component[entry.value].value].brittle.cracks();
  }
  [[nodiscard]] bool isFiner(std::uint32_t a, std::uint32_t b) const {
    return fineness_[a] != fineness_[b] ? fineness_[a] < fineness_[b] : a > b;
  }

  int passes_ = 1;
  bool anyRigid_ = false;
  std::vector<double> fineness_;     ///< of a loop, by its mean piece length; in parts of an octave
  std::vector<std::uint8_t> sharp_;  ///< by entry: true if its sampling point is such a corner
};

}  // namespace yadefrag
