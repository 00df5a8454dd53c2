#pragma once
// Vectors of three components and quaternions, each in one register of four doubles: an operation
// on all components is one instruction where the machine has AVX. Products and sums are in the
// order of Eigen's functions, so that every bit is the same.
//
//   vector:      | x | y | z | anything |
//   quaternion:  | x | y | z | w        |

#include <cmath>

// GCC warns that code with AVX and code without pass such arguments differently. All functions with
// such arguments or results, here and where this header is included, are always inlined.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace yadefrag {

using FourLanes = double __attribute__((vector_size(32)));

[[gnu::always_inline]] inline FourLanes loadThree(const double* from) {
  return FourLanes{from[0], from[1], from[2], 0};
}
[[gnu::always_inline]] inline FourLanes loadFour(const double* from) {
  return FourLanes{from[0], from[1], from[2], from[3]};
}
[[gnu::always_inline]] inline void storeThree(const FourLanes& value, double* to) {
  to[0] = value[0], to[1] = value[1], to[2] = value[2];
}
[[gnu::always_inline]] inline void storeFour(const FourLanes& value, double* to) {
  for (int i = 0; i < 4; ++i) to[i] = value[i];
}

/// Lanes x, y, z, w of the result, each by the number of a lane of `value`.
template <int x, int y, int z, int w>
[[gnu::always_inline]] inline FourLanes permuted(const FourLanes& value) {
  return __builtin_shufflevector(value, value, x, y, z, w);
}

[[gnu::always_inline]] inline FourLanes cross(const FourLanes& a, const FourLanes& b) {
  return permuted<1, 2, 0, 3>(a) * permuted<2, 0, 1, 3>(b) -
         permuted<2, 0, 1, 3>(a) * permuted<1, 2, 0, 3>(b);
}
/// In the order of Eigen's sums, with which YADE was compiled: that of `dot` is another one from
/// Eigen 5 on, which alone has the header `Version`.
[[gnu::always_inline]] inline double dot(const FourLanes& a, const FourLanes& b) {
  const FourLanes products = a * b;
#if __has_include(<Eigen/Version>)
  return (products[0] + products[1]) + products[2];
#else
  return products[0] + (products[1] + products[2]);
#endif
}
[[gnu::always_inline]] inline double squaredNorm(const FourLanes& a) {
  const FourLanes squares = a * a;
  return squares[0] + (squares[1] + squares[2]);
}
[[gnu::always_inline]] inline double norm(const FourLanes& a) { return std::sqrt(squaredNorm(a)); }

/// Product of quaternions: the rotation b, then a.
[[gnu::always_inline]] inline FourLanes quaternionProduct(const FourLanes& a, const FourLanes& b) {
  const FourLanes signs{1, 1, 1, -1};
  return permuted<3, 3, 3, 3>(a) * b + signs * (permuted<0, 1, 2, 0>(a) * permuted<3, 3, 3, 0>(b)) +
         signs * (permuted<1, 2, 0, 1>(a) * permuted<2, 0, 1, 1>(b)) -
         permuted<2, 0, 1, 2>(a) * permuted<1, 2, 0, 2>(b);
}
[[gnu::always_inline]] inline double squaredNormOfFour(const FourLanes& a) {
  const FourLanes squares = a * a;
  return (squares[0] + squares[1]) + (squares[2] + squares[3]);
}

}  // namespace yadefrag
