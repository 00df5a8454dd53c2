#pragma once
// The elastic law of an element: corotational, W = μ‖F − R‖² + λ/2 tr²(RᵀF − I), where R is the
// rotation nearest to the deformation gradient F. The force is the exact gradient of W, so that
// energy and angular momentum are conserved in large rotations.
//
// tr(RᵀF) = √((F₁₁+F₂₂)² + (F₂₁−F₁₂)²): in the plane no polar decomposition is needed. All
// functions are inlined into the vector loops of element_kernel.cpp.

#include <cmath>

#include "core/vec2.hpp"

namespace yadefrag {

/// A 2 × 2 matrix by rows.
struct Matrix2 {
  double xx, xy, yx, yy;

  friend Matrix2 operator-(const Matrix2& a, const Matrix2& b) {
    return {a.xx - b.xx, a.xy - b.xy, a.yx - b.yx, a.yy - b.yy};
  }
};

[[gnu::always_inline]] inline double determinant(const Matrix2& a) {
  return a.xx * a.yy - a.xy * a.yx;
}
/// a : b
inline double contract(const Matrix2& a, const Matrix2& b) {
  return a.xx * b.xx + a.xy * b.xy + a.yx * b.yx + a.yy * b.yy;
}

/// F = d·D⁻¹ from the present edges d₁ = x₁ − x₀, d₂ = x₂ − x₀ and D⁻¹ by rows.
[[gnu::always_inline]] inline Matrix2 deformationGradient(double d1x, double d1y, double d2x,
                                                          double d2y, double i11, double i12,
                                                          double i21, double i22) {
  return {d1x * i11 + d2x * i21, d1x * i12 + d2x * i22,  //
          d1y * i11 + d2y * i21, d1y * i12 + d2y * i22};
}

/// The rotation R, and tr(RᵀF).
struct PolarRotation {
  double trace, cosine, sine;

  [[gnu::always_inline]] explicit PolarRotation(const Matrix2& f) {
    const double a = f.xx + f.yy;
    const double b = f.yx - f.xy;
    trace = std::sqrt(a * a + b * b);
    const double inverse = 1 / trace;
    cosine = a * inverse;
    sine = b * inverse;
  }
  /// 2μ(F − R) + sR
  [[nodiscard, gnu::always_inline]] Matrix2 stress(const Matrix2& f, double s, double shear) const {
    const double m = 2 * shear;
    return {m * (f.xx - cosine) + s * cosine, m * (f.xy + sine) - s * sine,
            m * (f.yx - sine) + s * sine, m * (f.yy - cosine) + s * cosine};
  }
};

/// (Pa) First Piola–Kirchhoff stress P = ∂W/∂F.
[[gnu::always_inline]] inline Matrix2 firstPiola(const Matrix2& f, double lame, double shear) {
  const PolarRotation r(f);
  return r.stress(f, lame * (r.trace - 2), shear);
}

/// (Pa) ∂W/∂F and ∂W/∂h with a strain h along the circle around an axis: W + μh², where tr(RᵀF − I)
/// contains h.
struct HoopStress {
  Matrix2 plane;
  double hoop;
};
[[gnu::always_inline]] inline HoopStress hoopStress(const Matrix2& f, double h, double lame,
                                                    double shear) {
  const PolarRotation r(f);
  const double mean = lame * (r.trace - 2 + h);
  return {r.stress(f, mean, shear), mean + 2 * shear * h};
}

/// (Pa) An upper bound of the effective traction (fracture/separation.hpp) on all planes, from
/// Mohr's circle with centre c and radius r: √((c + r)² + ((r√(1 + μ²) + μc)/β)²), each term only
/// if positive. The second term is the maximum of |τ| + μσₙ; |τ| is below it for σₙ ≥ 0, and so is
/// |τ| − μ|σₙ| for σₙ < 0. The bound is convex: that of a mean of stresses does not exceed the
/// largest of theirs.
struct TractionBound {
  double shearWeight;        ///< 1/β²
  double friction, incline;  ///< μ, √(1 + μ²)

  TractionBound(double shearFactor, double slope)
      : shearWeight(1 / (shearFactor * shearFactor)),
        friction(slope),
        incline(std::sqrt(1 + slope * slope)) {}
  /// (Pa²)
  [[gnu::always_inline]] double squaredOf(double centre, double radius) const {
    const double pull = centre + radius > 0 ? centre + radius : 0;
    const double sheared = radius * incline + friction * centre;
    const double slip = sheared > 0 ? sheared : 0;
    return pull * pull + shearWeight * slip * slip;
  }
};

/// Parameters of the stress check of brittle elements.
struct StressLimit : TractionBound {
  double squared;  ///< Pa², limit of the squared bound; infinite: no check

  StressLimit(double shearFactor, double slope, double squaredBound)
      : TractionBound(shearFactor, slope), squared(squaredBound) {}
};

/// True if the bound of the effective traction reaches the given limit, for the stress RᵀP and a
/// further mean stress (Pa; −0: none, which costs nothing).
[[gnu::always_inline]] inline bool isStressed(const Matrix2& f, double lame, double shear,
                                              const StressLimit& limit, double further = -0.) {
  const double a = f.xx + f.yy;
  const double b = f.yx - f.xy;
  const double c = f.xx - f.yy;
  const double d = f.yx + f.xy;
  // Sum and difference of the principal stretches are √(a² + b²) and √(c² + d²).
  const double mean = (lame + shear) * (std::sqrt(a * a + b * b) - 2) + further;
  const double radius = shear * std::sqrt(c * c + d * d);
  return limit.squaredOf(mean, radius) >= limit.squared;
}

/// (J/m³) W, with a strain along the circle around an axis.
inline double energyDensity(const Matrix2& f, double lame, double shear, double hoop = 0) {
  const double a = f.xx + f.yy;
  const double b = f.yx - f.xy;
  const double trace = std::sqrt(a * a + b * b);
  const Matrix2 strain = f - Matrix2{a / trace, -b / trace, b / trace, a / trace};
  const double dilatation = trace - 2 + hoop;
  return shear * (contract(strain, strain) + hoop * hoop) + lame / 2 * dilatation * dilatation;
}

}  // namespace yadefrag
