#pragma once
// Factor of the rows and columns of G + ε·1 that are free (G has a unit diagonal).

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace yadefrag {

/// A symmetric matrix, both triangles, as compressed sparse rows.
struct SparseView {
  std::span<const std::uint32_t> offsets;
  std::span<const std::uint32_t> columns;
  std::span<const double> values;

  [[nodiscard]] std::size_t size() const { return offsets.size() - 1; }
  [[nodiscard]] double rowTimes(std::size_t row, const double* x) const {
    double sum = 0;
    for (std::uint32_t k = offsets[row]; k < offsets[row + 1]; ++k)
      sum += values[k] * x[columns[k]];
    return sum;
  }
};

class FreeSetFactor {
 public:
  FreeSetFactor();
  ~FreeSetFactor();

  /// Sets a new matrix and deletes the factor. The view must stay valid while it is used.
  void setMatrix(const SparseView& matrix);
  /// Returns false if the matrix is not definite, or not finite.
  bool factorize(const std::vector<std::uint8_t>& isFree, double added);
  /// Solves for the free rows; `x` is the right-hand side and the solution; its other rows do not
  /// change.
  void solve(std::vector<double>& x);

 private:
  struct Sparse;

  bool factorizeDense(double added);
  bool factorizeSparse(const std::vector<std::uint8_t>& isFree, double added);

  SparseView matrix_;
  bool dense_ = true;
  std::vector<std::uint32_t> rows_;   ///< free rows
  std::vector<std::uint32_t> place_;  ///< by row: index among the free rows
  std::vector<double> triangle_;      ///< lower Cholesky factor, row by row, full square
  std::vector<double> side_;
  std::unique_ptr<Sparse> sparse_;
};

}  // namespace yadefrag
