#pragma once
// Loads on pieces of the boundary in its present shape: pressure, and dashpots that absorb waves.
// Segments keep their numbers when nodes split, so that both follow cracks.

#include <cstdint>
#include <span>
#include <vector>

#include "core/step_times.hpp"
#include "mesh/model.hpp"
#include "mesh/motion.hpp"
#include "surface/contact_surface.hpp"
#include "time/energy_ledger.hpp"

namespace yadefrag {

struct Pressure {
  std::vector<SegmentId> segments;
  TimeTable value;  ///< Pa, towards the body, as a function of simulated time
  /// Number of a script's function that returns the value; 0: the table is used.
  std::uint32_t function = 0;
  /// Segments with this number or a higher one that are connected to the pressure's segments take
  /// part, too; kNever: none.
  std::uint32_t firstNew = kNever;
  static constexpr std::uint32_t kNever = ~std::uint32_t{0};
};

/// Adds the segments from `firstNew` on that are connected, at either end, to a segment of the
/// pressure.
void spread(Pressure& pressure, const ContactSurfaces& surfaces);

/// Adds the forces of `pressure` (Pa) on the segments to `forces` (N, by node): half of each
/// segment's force at both ends, along the present normal.
void addPressure(const Model& model, const ContactSurfaces& surfaces,
                 std::span<const SegmentId> segments, double pressure, std::vector<Vec2>& forces);

/// Dashpots ρc of Lysmer and Kuhlemeyer (1969, J. Eng. Mech. Div. 95, 859): against the normal
/// velocity with the speed of compression waves, against the tangential one with that of shear
/// waves. Plane waves at normal incidence are absorbed; oblique ones are partly reflected.
class AbsorbingBoundary {
 public:
  std::vector<SegmentId> segments;

  /// Finds the triangles behind the segments of bodies with several materials; `correct` asserts
  /// that it has been called for the present segments.
  void findTriangles(const Model& model, const ContactSurfaces& surfaces);
  /// Corrects the velocities by the dashpots' forces. Implicit, −C(vⁿ⁻½ + vⁿ⁺½)/2, and therefore
  /// stable for any step; `before` (m/s): vⁿ⁻½, `place` (m): xⁿ, by node.
  void correct(Model& model, const ContactSurfaces& surfaces, std::span<const Vec2> place,
               std::span<const Vec2> before, const StepLength& step, double drag);
  /// Adds the dashpots' work in the step, with the mean velocity, to `damping`.
  void addWork(EnergyLedger& ledger, const Model& model, std::span<const Vec2> before,
               const StepLength& step) const;

 private:
  /// (kg/s) A symmetric matrix for the boundary around one node.
  struct Dashpot {
    NodeId node;
    double xx = 0, xy = 0, yy = 0;
    Vec2 force = {};  // N, in the last step
  };
  void collect(const Model& model, const ContactSurfaces& surfaces, std::span<const Vec2> place);

  std::vector<Dashpot> dashpots_;
  std::vector<ElementId> behind_;  // by index in `segments`; empty: all bodies have one material
};

}  // namespace yadefrag
