#pragma once
// The return of a trial stress of one triangle to the yield surface, and the flow that follows:
// what goes in and comes out. The return itself is in plastic_lanes.hpp.

#include <array>

#include "elements/cone_return.hpp"
#include "mesh/body_material.hpp"
#include "mesh/plastic_state.hpp"

namespace yadefrag {

/// Constants of a body that yields.
struct YieldConstants {
  enum class Kind {
    kAny,     ///< a metal whose stresses are computed one by one: with a table, or in plane stress
    kLine,    ///< without effects of rate and temperature, and linear
    kCurved,  ///< Johnson and Cook's law, or the power law
    kCone,    ///< a frictional material
  };

  const PlasticMaterial& plastic;
  SolidModuli moduli;
  Cone cone;
  double heating;  ///< K m³/J, of plastic work
  bool planeStress;
  Kind kind;
  /// Of a metal without a table, Y₀ = base + factor (begin + p/unit)ⁿ, n = 0 with one.
  double base, factor, begin = 0, unit = 1, exponent;
  double shift = 0;  ///< p₀
  double bending;    ///< n − 1, 0 with a table
  double accuracy;   ///< change of Δp, of Δp, with which the return ends
  /// m; K, infinite if the temperature has no effect; Tₘ − T₀, K.
  double thermalExponent = 1, startTemperature, range = 1;

  explicit YieldConstants(const BodyMaterial& m);
};

/// State of one triangle (mesh/plastic_state.hpp).
struct YieldPoint {
  std::array<double, 4> edges;
  double thickness, strain, temperature;

  YieldPoint() = default;
  YieldPoint(const PlasticState& state, std::size_t row)
      : edges{state.edges[0][row], state.edges[1][row], state.edges[2][row], state.edges[3][row]},
        thickness(state.thickness[row]),
        strain(state.strain[row]),
        temperature(state.temperature[row]) {}
  void put(PlasticState& state, std::size_t row) const {
    for (std::size_t i = 0; i < 4; ++i) state.edges[i][row] = edges[i];
    state.thickness[row] = thickness;
    state.strain[row] = strain, state.temperature[row] = temperature;
  }
};

/// The present edges x₁ − x₀, x₂ − x₀ of a triangle (m), and its stretch along the circle around
/// the axis.
struct TriangleEdges {
  Vec2 first, second;
  double hoop = 1;

  [[nodiscard]] double twiceArea() const { return cross(first, second); }
  [[nodiscard]] Matrix2 gradient(const std::array<double, 4>& inverse) const {
    return deformationGradient(first.x, first.y, second.x, second.y, inverse[0], inverse[1],
                               inverse[2], inverse[3]);
  }
};

/// (Pa) Yield stress in slow flow; of a cone, √3 ξc.
[[nodiscard]] double yieldStress(const PlasticMaterial& m, double strain, double temperature);

/// The elastic stretch across the plane for which the stress there is zero, if the part `kept` of
/// the deviator remains; `guess`: a near one.
[[nodiscard]] double freeThickness(const Matrix2& f, double guess, double kept,
                                   const SolidModuli& moduli);

/// The trial state; in plane stress with the thickness that is free to change.
[[nodiscard]] ElasticTrial trialOf(const YieldConstants& c, const YieldPoint& point,
                                   const TriangleEdges& now, double& thickness);

/// The edges now and at the last step, and det F now, in three dimensions.
struct TriangleMotion {
  TriangleEdges now, before;
  double size;
};

/// (Pa) The mean of U'(J) at the nodes of an element that has not its own, now and at the last
/// step. Of a cone, `now` is that after all elements have opened, this one by `opening`.
struct NodalPressure {
  double now, before, opening = 0;
};

/// A triangle after the return.
struct Returned {
  YieldPoint point;
  ElasticTrial trial = {Matrix2{1, 0, 0, 1}, 1};
  double mean = 0;         ///< Pa, of τ
  double trialMean = 0;    ///< Pa, the same before the return
  double kept = 1;         ///< part of the trial's deviator that remains
  double opening = 0;      ///< logarithmic volume strain of the flow
  double dissipation = 0;  ///< J/m³ of the undeformed body, Δεₚ:½(τⁿ⁻¹ + τⁿ)

  /// J after the flow.
  [[nodiscard]] double volume() const;
};

/// From the state after the last step to that at the edges now. Without flow the point is
/// unchanged.
[[nodiscard]] Returned returnToYield(const YieldConstants& c, const YieldPoint& point,
                                     const TriangleMotion& motion, double dt,
                                     const NodalPressure* pressure = nullptr);

/// The volume strain of the flow on a cone from this trial and this mean of U'(J) (Pa) at the
/// nodes, if the neighbours open as this triangle does.
[[nodiscard]] double nodalOpening(const YieldConstants& c, const ElasticTrial& trial, double size,
                                  double pressure);

/// (1/m²) Largest |∇N|² of a stress-free shape.
[[gnu::always_inline]] inline double squaredGradient(const std::array<double, 4>& e) {
  const double x = e[0] + e[2], y = e[1] + e[3];
  const double second = e[0] * e[0] + e[1] * e[1], third = e[2] * e[2] + e[3] * e[3];
  return std::max(std::max(x * x + y * y, second), third);
}

/// (J/m³) Elastic energy of the deviator.
[[nodiscard]] double deviatorEnergy(const ElasticTrial& trial, double kept, double shear);
/// (J/m³) U(J)
[[nodiscard]] double volumeEnergy(double volume, double bulk);

}  // namespace yadefrag
