#pragma once
// The plastic deformation of a triangle, kept while its stress-free shape is divided.

#include <optional>

#include "elements/elastic_law.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

inline Matrix2 operator*(const Matrix2& a, const Matrix2& b) {
  return {a.xx * b.xx + a.xy * b.yx, a.xx * b.xy + a.xy * b.yy,  //
          a.yx * b.xx + a.yy * b.yx, a.yx * b.xy + a.yy * b.yy};
}

/// D Dₑ⁻¹ = Fₚ⁻¹
class FlowedShape {
 public:
  FlowedShape(const Triangles& triangles, ElementId element) {
    if (!triangles.plastic.isUsed()) return;
    const Matrix2 d = undeformed(triangles, element);
    const double det = determinant(d);
    flowed_ = Matrix2{d.yy / det, -d.xy / det, -d.yx / det, d.xx / det} *
              elastic(triangles.plastic, element);
  }
  void keep(Triangles& triangles, ElementId element) const {
    if (!flowed_) return;
    const Matrix2 m = undeformed(triangles, element) * *flowed_;
    auto& edges = triangles.plastic.edges;
    const std::size_t e = element.value;
    edges[0][e] = m.xx, edges[1][e] = m.xy, edges[2][e] = m.yx, edges[3][e] = m.yy;
  }

  static Matrix2 elastic(const PlasticState& state, ElementId element) {
    const std::size_t e = element.value;
    return {state.edges[0][e], state.edges[1][e], state.edges[2][e], state.edges[3][e]};
  }

 private:
  static Matrix2 undeformed(const Triangles& triangles, ElementId element) {
    const auto& i = triangles.inverseEdges[element.value];
    return {i[0], i[1], i[2], i[3]};
  }

  std::optional<Matrix2> flowed_;
};

}  // namespace yadefrag
