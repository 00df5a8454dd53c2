#pragma once
// External forces on the nodes, and loads on pieces of the boundary.

#include <cstdint>
#include <span>
#include <vector>

#include "fracture/fracture.hpp"
#include "time/surface_loads.hpp"

namespace yadefrag {

class Loads {
 public:
  // --- for the next step only
  std::vector<Vec2> outerForces;  ///< N, by node; empty: none
  struct GivenPressure {
    std::uint32_t function;
    double value;  ///< Pa
  };
  std::vector<GivenPressure> givenPressures;  ///< values of pressures with a function

  // --- permanent
  std::vector<Pressure> pressures;
  AbsorbingBoundary absorbing;

  /// See World::setPressure and World::setAbsorbing.
  void setPressure(const Model& model, const ContactSurfaces& surfaces,
                   std::span<const NodeId> nodes, TimeTable value, std::uint32_t function,
                   bool intoCracks);
  void setAbsorbing(const Model& model, const ContactSurfaces& surfaces,
                    std::span<const NodeId> nodes);

  /// `numbers`: new number of each segment, none() of removed ones.
  void renumber(std::span<const SegmentId> numbers);
  /// Segments were divided, but not by a crack: the last segments are new. `parents`: by new
  /// segment, the one of which it was a part.
  void onDivision(const ContactSurfaces& surfaces, std::span<const SegmentId> parents);
  /// Extends pressures to the faces of cracks. Those of cohesive cracks have none.
  void spread(const Model& model, const ContactSurfaces& surfaces, const Fracture& fracture);

  /// Adds up external forces and pressures at `time` (s).
  void sum(const Model& model, const ContactSurfaces& surfaces, double time);
  /// (N) By node; empty: none.
  [[nodiscard]] const std::vector<Vec2>& forces() const {
    return pressures.empty() ? outerForces : sum_;
  }
  void endStep() { outerForces.clear(), givenPressures.clear(); }

 private:
  void removeUnused();
  [[nodiscard]] double valueOf(const Pressure& pressure, double time) const;

  std::vector<Vec2> sum_;  // N, by node; empty without pressures
};

}  // namespace yadefrag
