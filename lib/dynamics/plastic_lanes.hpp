#pragma once
// Data of kLanes triangles that yield, in the layout of the vector loops.

#include <array>
#include <cstdint>

#include "dynamics/element_chunks.hpp"
#include "dynamics/yield_law.hpp"
#include "mesh/plastic_material.hpp"

namespace yadefrag {

/// Values of kLanes elements between the trial and the forces.
struct alignas(64) TrialLanes {
  double zx[kLanes], zy[kLanes], wx[kLanes], wy[kLanes];
  double inverseZ[kLanes], part[kLanes], across[kLanes];
  double squaredMises[kLanes];
  double volume[kLanes];  ///< J
  double mean[kLanes];    ///< Pa, of τ
  double kept[kLanes];    ///< part of the deviator that remains

  void set(std::size_t k, const ElasticTrial& t, double keptPart) {
    zx[k] = t.zx, zy[k] = t.zy, wx[k] = t.wx, wy[k] = t.wy;
    inverseZ[k] = t.inverseZ, part[k] = t.part, across[k] = t.across, kept[k] = keptPart;
  }
};

/// Elastic shape of kLanes elements; lanes after the chunk's last element repeat that element.
struct alignas(64) StateLanes {
  double edges[4][kLanes], thickness[kLanes];
};

/// Copy of kLanes successive elements' state, for a step that is undone.
struct FormerLanes {
  std::uint32_t first, count;
  double edges[4][kLanes], thickness[kLanes], strain[kLanes], temperature[kLanes];

  // Not `= default`, with which emplace_back would set all values, which are written at once, to 0.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init,modernize-use-equals-default)
  FormerLanes() {}
};

/// The yield stress of a metal for the vector loops; of a frictional material only the kind.
struct YieldCurve {
  enum class Kind {
    kAlone,   ///< no vector loop: elements are returned one by one
    kLine,    ///< without effects of rate and temperature, and linear
    kCurved,  ///< Johnson and Cook's law, or the power law
    kCone,    ///< a frictional material
  };
  Kind kind = Kind::kAlone;
  double stiffness = 0;  ///< Pa, 3μ
  double leastStep = 0;  ///< 1/Pa
  /// Y₀ = base + factor (begin + p/unit)ⁿ
  double base = 0, factor = 0, begin = 0, unit = 1, exponent = 1;
  double shift = 0;       ///< p₀
  double rateFactor = 0;  ///< C
  double perRate = 0;     ///< 1/(ṗ₀ Δt)
  double heating = 0;     ///< K m³/J
  /// m; K, infinite if the temperature has no effect; Tₘ − T₀, K.
  double thermalExponent = 1, startTemperature = 0, range = 1;
  std::array<double, 6> binomial{};  ///< coefficients of (1 + x)ⁿ

  YieldCurve() = default;
  /// `dt` (s): the step.
  YieldCurve(const PlasticMaterial& m, double shear, double heatingByWork, double dt);
};

}  // namespace yadefrag
