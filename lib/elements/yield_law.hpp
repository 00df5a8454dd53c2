#pragma once
// Stress of a triangle that may have flowed, from its elastic deformation Fₑ and its elastic
// stretch λ across the plane (mesh/plastic_state.hpp): hyperelastic in the logarithmic strain, as
// Simo and Hughes 1998, eq. 9.2.6 and box 9.1,
//   W = U(J) + μ e:e,  U = κ/2 [(J² − 1)/2 − log J],  e = dev log V,  κ = λ + 2μ/3,
// so that the return of a trial stress is that of small strains. Per volume of the undeformed body
// the (Kirchhoff) stress is τ = κ/2 (J² − 1) 1 + 2μ e.
//
// As complex numbers z = (F₁₁+F₂₂) + i(F₂₁−F₁₂) and w = (F₁₁−F₂₂) + i(F₂₁+F₁₂), F maps x to
// (z x + w x̄)/2; the stretches are (|z| ± |w|)/2. With u = w/z, in the frame rotated back,
//   e₁₁ − e₂₂ + 2i e₁₂ = 2 u artanh|u|/|u|,  e₃₃ = ⅓ log(λ²/det F),
// and in the present frame u is w z/|z|². e is elastic and therefore small: series.

#include "core/lanes.hpp"
#include "core/tolerances/dynamics.hpp"
#include "elements/elastic_law.hpp"
#include "mesh/body_material.hpp"

namespace yadefrag {

/// artanh(√x)/√x for small x.
[[gnu::always_inline]] inline double artanhFactor(double x) {
  return 1 + x * (1. / 3 + x * (1. / 5 + x * (1. / 7)));
}

/// log(a/b) for a ratio near 1.
[[gnu::always_inline]] inline double logRatio(double a, double b) {
  const double y = (a - b) / (a + b);
  return 2 * y * artanhFactor(y * y);
}

/// (Pa) Bulk and shear modulus of the material itself, in plane stress, too.
struct SolidModuli {
  double bulk, shear;
  explicit SolidModuli(const ElasticMaterial& m)
      : bulk(m.young / (3 * (1 - 2 * m.poisson))), shear(m.shearModulus()) {}
};

/// Deviator of the logarithmic elastic strain, and the volume ratio.
struct ElasticTrial {
  double zx, zy, wx, wy;  ///< z and w
  double inverseZ;        ///< 1/|z|²
  double part;            ///< e₁₁ − e₂₂ + 2i e₁₂ = part · u, u = w z̄/|z|²
  double squared;         ///< |part · u|²
  double across;          ///< 3 e₃₃
  double volume;          ///< J = λ det Fₑ

  ElasticTrial() = default;
  [[gnu::always_inline]] ElasticTrial(const Matrix2& f, double thickness)
      : zx(f.xx + f.yy), zy(f.yx - f.xy), wx(f.xx - f.yy), wy(f.yx + f.xy) {
    const double squaredZ = zx * zx + zy * zy, squaredW = wx * wx + wy * wy;
    inverseZ = 1 / squaredZ;
    const double x = squaredW * inverseZ;
    part = 2 * artanhFactor(x);
    squared = part * part * x;
    const double area = (squaredZ - squaredW) * .25;
    across = logRatio(thickness * thickness, area);
    volume = thickness * area;
  }
  /// With logarithms where the series are not exact to rounding: in a trial, e may be large.
  static ElasticTrial ofAnySize(const Matrix2& f, double thickness) {
    ElasticTrial t(f, thickness);
    const double x = (t.wx * t.wx + t.wy * t.wy) * t.inverseZ;
    if (!(x < 1) || (t.squared < tolerance::kSeries && t.across * t.across < tolerance::kSeries))
      return t;
    const double u = std::sqrt(x);
    t.part = u > 0 ? logOf((1 + u) / (1 - u)) / u : t.part;
    t.squared = t.part * t.part * x;
    t.across = logOf(thickness * thickness * thickness / t.volume);
    return t;
  }
  /// (Pa²) Square of von Mises' equivalent stress, √(3/2 s:s), over μ².
  [[nodiscard, gnu::always_inline]] double squaredMises() const {
    return across * across + 3 * squared;
  }
};

/// e:e' of two deviators in the same frame.
[[gnu::always_inline]] inline double product(const ElasticTrial& a, const ElasticTrial& b) {
  // u = w z̄/|z|²
  const double ax = a.wx * a.zx + a.wy * a.zy, ay = a.wy * a.zx - a.wx * a.zy;
  const double bx = b.wx * b.zx + b.wy * b.zy, by = b.wy * b.zx - b.wx * b.zy;
  const double part = a.part * a.inverseZ * b.part * b.inverseZ;
  return a.across * b.across / 6 + part * (ax * bx + ay * by) / 2;
}

/// κ/2 (J² − 1) = J U'(J), the mean of τ.
[[gnu::always_inline]] inline double meanStress(double volume, double bulk) {
  return bulk / 2 * (volume * volume - 1);
}

/// (Pa) The stress across the plane if the part `kept` of the deviator remains, and Newton's step
/// that makes it 0, by which the logarithm of the thickness decreases.
struct StressAcross {
  double stress, step;

  [[gnu::always_inline]] StressAcross(const ElasticTrial& t, double kept, const SolidModuli& m)
      : stress(meanStress(t.volume, m.bulk) + 2 * m.shear * kept * t.across / 3),
        step(stress / (m.bulk * t.volume * t.volume + 4. / 3 * m.shear * kept)) {}
};

/// (Pa) τ across the plane; arguments as below.
[[gnu::always_inline]] inline double stressAcross(const ElasticTrial& t, double mean, double kept,
                                                  double shear) {
  return mean + 2. / 3 * (shear * kept * t.across);
}

/// (Pa) τ in the plane.
struct PlaneStress {
  double xx, yy, xy;

  /// `mean`: of τ; `kept`: remaining part of the trial's deviator.
  [[gnu::always_inline]] PlaneStress(const ElasticTrial& t, double mean, double kept,
                                     double shear) {
    const double middle = mean - shear * kept * t.across / 3;
    // 2μ (e₁₁ − e₂₂ + 2i e₁₂)/2 in the present frame
    const double by = shear * kept * t.part * t.inverseZ;
    const double half = by * (t.wx * t.zx - t.wy * t.zy);
    xx = middle + half;
    yy = middle - half;
    xy = by * (t.wx * t.zy + t.wy * t.zx);
  }
};

}  // namespace yadefrag
