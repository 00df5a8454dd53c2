#pragma once
// Loads on pieces of the boundary that go by its present shape: pressure, and dashpots that let
// waves out. Segments keep their numbers when nodes split, so both follow cracks.

#include <cstdint>
#include <span>
#include <vector>

#include "core/step_length.hpp"
#include "core/time_table.hpp"
#include "dynamics/energy_ledger.hpp"
#include "mesh/model.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

struct Pressure {
  std::vector<SegmentId> segments;
  TimeTable value;  ///< Pa, towards the body, over the simulated time
  /// A script's own function gives the value, by this number; 0: the table does.
  std::uint32_t function = 0;
  /// Segments from this number on that hang together with its own take part, too; kNever: none.
  std::uint32_t firstNew = kNever;
  static constexpr std::uint32_t kNever = ~std::uint32_t{0};
};

/// Adds the segments from `firstNew` on that follow, or are followed by, one of the pressure's.
void spread(Pressure& pressure, const ContactSurfaces& surfaces);

/// Adds what `pressure` (Pa) does on the segments to `forces` (N, by node): half of each at both
/// ends, along the present normal.
void addPressure(const Model& model, const ContactSurfaces& surfaces,
                 std::span<const SegmentId> segments, double pressure, std::vector<Vec2>& forces);

/// Dashpots ρc of Lysmer and Kuhlemeyer (1969, J. Eng. Mech. Div. 95, 859): against the normal
/// velocity with the speed of compression waves, against the tangential one with that of shear
/// waves. Plane waves that come straight at the boundary leave by it; of others a part is
/// reflected.
class AbsorbingBoundary {
 public:
  std::vector<SegmentId> segments;

  /// After bodies or segments have changed: which triangles are behind those of bodies with several
  /// materials.
  void findTriangles(const Model& model, const ContactSurfaces& surfaces);
  /// From the velocities without dashpots to those with, implicit: −C(vⁿ⁻½ + vⁿ⁺½)/2, which is
  /// stable for any step; `before` (m/s): vⁿ⁻½, `place` (m): xⁿ, by node.
  void correct(Model& model, const ContactSurfaces& surfaces, std::span<const Vec2> place,
               std::span<const Vec2> before, const StepLength& step, double drag);
  /// What that took in the step, with its mean velocity, goes to `damping`.
  void book(EnergyLedger& ledger, const Model& model, std::span<const Vec2> before,
            const StepLength& step) const;

 private:
  /// (kg/s) A symmetric matrix, of the boundary around one node.
  struct Dashpot {
    NodeId node;
    double xx = 0, xy = 0, yy = 0;
    Vec2 force = {};  // N, in the last step
  };
  void collect(const Model& model, const ContactSurfaces& surfaces, std::span<const Vec2> place);

  std::vector<Dashpot> dashpots_;
  std::vector<ElementId> behind_;  // by place in `segments`; empty: all bodies have one material
};

}  // namespace yadefrag
