#pragma once
// The energy of a body with smoothed strains (ElementKind::kSmoothed).
//
// F splits into a similarity (a, b) = (F₁₁+F₂₂, F₂₁−F₁₂) and a distortion (c, d) = (F₁₁−F₂₂,
// F₂₁+F₁₂). In these the corotational law is W = ½μ(c² + d²) + ½(λ+μ)(√(a² + b²) − 2)²: the first
// term is that of the distortion, the second that of the dilatation, without shear. With ⟨·⟩ the
// mean over the triangles at a node, weighted by volume, a body's energy is
//   Σ_triangles V (1−α)·½μ(c² + d²)
//     + Σ_nodes V [α·½μ(⟨c⟩² + ⟨d⟩²) + ½(λ+μ)(√(⟨a⟩² + ⟨b⟩²) − 2)²],  V of a node: a third of each.
// Around an axis the strain along the circle is averaged at the nodes, too, and V is by mass.
// The dilatation at nodes is that of Dohrmann et al. 2000 (Int. J. Numer. Meth. Eng. 47, 1549) and
// Bonet et al. 2001 (Commun. Numer. Meth. Eng. 17, 551); the mixture of triangles and nodes is the
// α-FEM of Liu et al. 2008 (Comput. Methods Appl. Mech. Eng. 197, 3883). Forces are the exact
// gradient of this energy. Uniform strains are exact. A mean has at most the energy of the values
// that it averages, so that the critical step of linear triangles is stable. Where c and d vanish
// everywhere the body is only scaled, so that only rigid motions have no energy.

#include <cmath>

#include "elements/elastic_law.hpp"
#include "mesh/body_material.hpp"

namespace yadefrag {

/// α. With 0.4 a cantilever four triangles high bends as by theory, on all meshes and up to ν =
/// 0.49 (mechanics/patch_test.cpp, lib/README.md). A larger α is softer on all of them.
inline constexpr double kSmoothedShare = .4;

/// F (1), or the stress ∂W/∂(a, b, c, d) (Pa), as a similarity a, b and a distortion c, d.
struct alignas(32) SplitGradient {
  double part[4] = {};

  SplitGradient& operator+=(const SplitGradient& other) {
    for (int j = 0; j < 4; ++j) part[j] += other.part[j];
    return *this;
  }
  friend SplitGradient operator-(const SplitGradient& a, const SplitGradient& b) {
    SplitGradient difference;
    for (int j = 0; j < 4; ++j) difference.part[j] = a.part[j] - b.part[j];
    return difference;
  }
  friend SplitGradient operator*(double factor, const SplitGradient& a) {
    SplitGradient product;
    for (int j = 0; j < 4; ++j) product.part[j] = factor * a.part[j];
    return product;
  }
};

inline SplitGradient splitGradient(const Matrix2& f) {
  return {{f.xx + f.yy, f.yx - f.xy, f.xx - f.yy, f.yx + f.xy}};
}

/// (Pa) P = ∂W/∂F from the stress in a, b, c, d.
inline Matrix2 piolaOf(const SplitGradient& stress) {
  const auto& [a, b, c, d] = stress.part;
  return {a + c, d - b, d + b, a - c};
}

/// (J/m³) Energy density of a node's mean gradient and of its mean strain h along the circle around
/// an axis, by which the dilatation grows: a further λeh + ½(λ+2μ)h², with e = √(a² + b²) − 2.
inline double nodeEnergyDensity(const SplitGradient& mean, const ElasticMaterial& m,
                                double around = 0) {
  const auto& [a, b, c, d] = mean.part;
  const double dilatation = std::sqrt(a * a + b * b) - 2;
  return kSmoothedShare * m.shearModulus() / 2 * (c * c + d * d) +
         (m.lame() + m.shearModulus()) / 2 * dilatation * dilatation +
         m.lame() * dilatation * around + m.waveModulus() / 2 * around * around;
}

/// (Pa) Derivative of that energy density with respect to h.
inline double stressAround(const SplitGradient& mean, const ElasticMaterial& m, double around) {
  const auto& [a, b, c, d] = mean.part;
  return m.lame() * (std::sqrt(a * a + b * b) - 2) + m.waveModulus() * around;
}

/// (Pa) Gradient of that energy density.
inline SplitGradient nodeStress(const SplitGradient& mean, const ElasticMaterial& m,
                                double around = 0) {
  const auto& [a, b, c, d] = mean.part;
  const double length = std::sqrt(a * a + b * b);
  const double similar =
      (m.lame() + m.shearModulus()) * (1 - 2 / length) + m.lame() * around / length;
  const double distorted = kSmoothedShare * m.shearModulus();
  return {{similar * a, similar * b, distorted * c, distorted * d}};
}

}  // namespace yadefrag
