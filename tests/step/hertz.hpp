#pragma once
// Half cylinder on a block, pressed until it rests: what the tests of Hertzian contact share.

#include <array>

#include "step/bodies.hpp"

namespace yadefrag::test {

/// The case, in SI units, and its closed form (plane strain, two half spaces).
struct Hertz {
  double radius = .05;  ///< m, of the cylinder
  double line = 35e6;   ///< N/m, load
  ElasticMaterial cylinder{210e9, .3, 7800, false};
  ElasticMaterial block{70e9, .3, 2600, false};  ///< waves as fast as in the cylinder

  [[nodiscard]] double modulus() const;    ///< Pa, E*
  [[nodiscard]] double halfWidth() const;  ///< m
  [[nodiscard]] double pressure() const;   ///< Pa, p₀
};

struct HertzMesh {
  double cylinder, block;  ///< m, edges at the contact
  bool smooth = false;
  int passes = 2;
};

struct PressureAt {
  double x, p;  ///< m, Pa
};

/// What is measured once all is at rest.
struct HertzResult {
  double peak = 0;         ///< Pa, p₀ by least squares of p² = p₀²(1 − x²/a²)
  double fitted = 0;       ///< m, a of the same fit
  double touching = 0;     ///< m, half of what the loaded nodes cover
  double rough = 0;        ///< rms of p − fit within 0.9 a, over p₀
  double waviness = 0;     ///< rms of second differences of p − fit within 0.9 a, over p₀
  double total = 0;        ///< contact force over load
  double kinetic = 0;      ///< over strain energy
  double penetration = 0;  ///< m
  std::vector<PressureAt> profile;
};

HertzResult press(const Hertz& hertz, const HertzMesh& mesh);

}  // namespace yadefrag::test
