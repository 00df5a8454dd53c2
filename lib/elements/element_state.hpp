#pragma once
// State of single elements, by kind, for output and for the energy balance.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/tolerances/dynamics.hpp"
#include "elements/elastic_law.hpp"
#include "elements/plastic_return.hpp"
#include "elements/smoothed_law.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

// --- Resistance to collapse. The elastic law has a finite energy at zero area, so that an impact
// could invert an element whatever the step. An element compressed to x < 1 of the area fraction
// `kBarrierBegin` therefore has the additional energy density κ(1 − x)³/x: its first two
// derivatives vanish at x = 1, so that forces and stiffness have no jump there, and nothing changes
// above.

/// κ relative to (λ + 2μ) kBarrierBegin². A larger one makes a step too long as soon as an element
/// enters the barrier, a smaller one lets elements become so flat that they need more steps: a
/// column that hits a wall at 1.5 of the wave speed takes 4500, 1900, 1600 steps with 3, 10, 20.
inline constexpr double kBarrier = 10;

/// The energy density as a function of J = det F, and its derivatives with respect to J.
struct CollapseBarrier {
  double energy = 0;                ///< J/m³
  double slope = 0, curvature = 0;  ///< Pa

  /// `modulus`: λ + 2μ (Pa). No barrier for an inverted element, in which no step may end.
  CollapseBarrier(double area, double modulus) {
    if (!(area > 0 && area < tolerance::kBarrierBegin)) return;
    const double x = area / tolerance::kBarrierBegin, y = 1 - x;
    const double unit = kBarrier * modulus * tolerance::kBarrierBegin;
    energy = unit * tolerance::kBarrierBegin * y * y * y / x;
    slope = unit * (3 - 2 * x - 1 / (x * x));
    curvature = unit / tolerance::kBarrierBegin * (2 / (x * x * x) - 2);
  }
};

/// ∂J/∂F
inline Matrix2 cofactor(const Matrix2& f) { return {f.yy, -f.yx, -f.xy, f.xx}; }

/// F, and the stretch along the circle around an axis, which J = det F contains.
struct Deformation {
  Matrix2 plane;
  double hoop = 1;

  [[nodiscard]] double volume() const { return determinant(plane) * hoop; }
  /// δJ
  [[nodiscard]] double growth(const Matrix2& step, double hoopStep) const {
    return hoop * contract(cofactor(plane), step) + determinant(plane) * hoopStep;
  }
};

/// (J/m³) Twice the barrier's energy density at the half step between two deformations
/// (energy_ledger.hpp).
inline double twiceBarrierEnergy(const Deformation& now, const Deformation& before,
                                 double modulus) {
  const CollapseBarrier a(now.volume(), modulus), b(before.volume(), modulus);
  const Matrix2 step = now.plane - before.plane;
  const double hoopStep = now.hoop - before.hoop;
  return a.energy + b.energy -
         (a.slope * now.growth(step, hoopStep) - b.slope * before.growth(step, hoopStep)) / 2;
}

// --- Deformation, stress and energy of single elements, for output.

/// (Pa) Elastic moduli of successive elements: those of the body or of the element's own material.
class Moduli {
 public:
  explicit Moduli(const ElasticMaterial& m) : lame(m.lame()), shear(m.shearModulus()) {}
  /// Does nothing if the body has one material.
  void take(const Model& model, const Component& body, ElementId element) {
    if (body.isMixed()) *this = Moduli(model.materialOf(element).material);
  }

  double lame, shear;
};

/// (m³) Of the stress-free shape.
inline double volumeOf(const Model& model, ElementId element) {
  return model.triangles.area[element.value] * model.depthOf(element);
}

/// Of a field by node (m; m/s), the mean at the element's corners of its part along x, over the
/// stress-free radius: of the places the stretch along the circle around the axis, of velocities
/// its rate. `inPlane`: the value in a plane scene.
inline double overRadius(const Model& model, ElementId element, const std::vector<Vec2>& places,
                         double inPlane) {
  if (!model.axisymmetric) return inPlane;
  const auto& nodes = model.triangles.nodes[element.value];
  return (places[nodes[0].value].x + places[nodes[1].value].x + places[nodes[2].value].x) /
         (3 * model.triangles.radius[element.value]);
}

/// The deformation gradient F at the present positions.
Matrix2 deformationGradient(const Model& model, ElementId element);

/// (1/m) Inverse of the edges of the stress-free shape, which flow has changed.
std::array<double, 4> elasticEdges(const Model& model, ElementId element);
/// The deformation gradient from that shape; F without flow.
Matrix2 elasticGradient(const Model& model, ElementId element);

/// Δt Ḟ: the change of F over a step at the present velocities.
Matrix2 deformationStep(const Model& model, ElementId element, double dt);

/// The stretch along the circle around the axis; 1 in a plane scene.
inline double hoopStretch(const Model& model, ElementId element) {
  return overRadius(model, element, model.nodes.position, 1);
}
Deformation deformation(const Model& model, ElementId element);
/// One step of Δt (s) before that of now.
Deformation deformationBefore(const Model& model, ElementId element, const Deformation& now,
                              double dt);

/// (Pa) Cauchy stress xx, yy, xy of the F of one element, without strain smoothing. Cracks average
/// it over the elements at a node, which is a smoothing of its own. `dt`: as below.
std::array<double, 3> stressOf(const Model& model, ElementId element, double dt = 0);
/// (Pa) Cauchy stress xx, yy, xy of the F of one elastic element with these moduli.
std::array<double, 3> elasticStressOf(const Model& model, ElementId element, const Moduli& moduli);

/// (1/s) Rate of deformation xx, yy, xy of one element: the symmetric part of ḞF⁻¹.
std::array<double, 3> strainRateOf(const Model& model, ElementId element);

/// (Pa) The stress of every element from which its forces are computed.
/// `dt` (s): the last step, for bodies that yield; 0: their rate has no effect.
std::vector<std::array<double, 3>> stresses(const Model& model, double dt = 0);

/// (Pa) The stress zz across the plane; 0 in plane stress.
std::vector<double> stressesAcross(const Model& model, double dt = 0);

// --- Energy and stress of bodies with smoothed strains (smoothed_law.hpp), for output and for the
// energy balance.

/// The gradient F of the triangles at a node, and the strain along the circle around an axis,
/// summed with a third of their volumes, or the part by mass, now and one step before.
struct NodeSum {
  SplitGradient now, before;         ///< m³
  double around = 0, wasAround = 0;  ///< m³
  double volume = 0;                 ///< m³

  /// `share`: Model::massShare of the node's corner.
  void add(const Model& model, ElementId element, double share, double dt);
  NodeSum& operator+=(const NodeSum& other);
  friend NodeSum operator*(double factor, const NodeSum& sum);
  /// (J) The node's part of the energy at the half step (energy_ledger.hpp).
  [[nodiscard]] double energy(const ElasticMaterial& material) const;
};

// The following functions ignore all bodies without smoothed strains.

/// (J) Energy of some triangles at the half step; there must be no others at their nodes.
double smoothedEnergy(const Model& model, std::span<const ElementId> elements, double dt);

/// Sets the Cauchy stresses (Pa: xx, yy, xy), by triangle, from which the forces are computed.
void setSmoothedStresses(const Model& model, std::vector<std::array<double, 3>>& stresses);
/// The same around the axis.
void setSmoothedAround(const Model& model, std::vector<double>& stresses);

// --- State, stress and energy of bodies that yield, for output and for the energy balance. The
// stored state is that of the last forces, at xⁿ⁻¹; here it is returned to the yield surface at xⁿ,
// as the next step will do. `dt` (s): the last step.

/// By triangle; those of bodies that do not yield have no meaning.
[[nodiscard]] std::vector<YieldPoint> presentPoints(const Model& model, double dt);
/// An element at the present positions, with its own volume strain, not that of its nodes.
[[nodiscard]] Returned presentState(const Model& model, ElementId element, double dt);

/// (J) Energies of these bodies at the half step (energy_ledger.hpp).
struct YieldingEnergy {
  double strain = 0;
  /// Half of the dissipation of the last motion, which the ledger does not yet contain.
  double dissipated = 0;
};
[[nodiscard]] YieldingEnergy yieldingEnergy(const Model& model, double dt);
/// Energies of some elements at the half step; these must be whole fragments.
[[nodiscard]] YieldingEnergy yieldingEnergy(const Model& model, std::span<const ElementId> elements,
                                            double dt);
/// Damage by triangle; 0 where the material does not fail.
[[nodiscard]] std::vector<double> presentDamage(const Model& model, double dt);

/// (Pa) Cauchy stress xx, yy, xy of the elements of these bodies.
void setYieldingStresses(const Model& model, double dt,
                         std::vector<std::array<double, 3>>& stresses);
/// (Pa) Their stress zz; 0 in plane stress.
void setYieldingAcross(const Model& model, double dt, std::vector<double>& stresses);
/// Triangles of a body that flow without any motion.
[[nodiscard]] std::size_t countYielding(const Model& model, ComponentId body);

}  // namespace yadefrag
