#pragma once
// Block principal pivoting for bounds (J. J. Júdice, F. M. Pires, Comput. Oper. Res. 21 (1994)
// 587).

#include <cstdint>
#include <vector>

#include "contact/solve_free_set.hpp"

namespace yadefrag {

/// The problem, scaled so that G has a unit diagonal.
struct ScaledBox {
  SparseView matrix;
  std::vector<double> constant, lower, upper;
  std::vector<double> slack;  ///< by row: errors of λ and r below this are rounding

  [[nodiscard]] std::size_t size() const { return constant.size(); }
};

enum class RowState : std::uint8_t { kAtLower, kAtUpper, kFree };

class BoxPivoting {
 public:
  /// Sets a new matrix, and the initial states from `lambda` (within the bounds).
  void begin(const ScaledBox& box, const std::vector<double>& lambda, bool isGuess);
  /// Solves with H = G + ε·1 and c = g − ε·centre. Returns false if it takes too many pivots or if
  /// a number is not finite.
  bool solve(const ScaledBox& box, double added, const std::vector<double>& centre,
             std::vector<double>& lambda);

  [[nodiscard]] int pivots() const { return pivots_; }

 private:
  /// The shifted problem: H and c.
  struct Shifted {
    const ScaledBox& box;
    double added;
    const std::vector<double>& centre;

    [[nodiscard]] double residual(std::size_t i, const std::vector<double>& lambda) const;
  };
  bool solveForStates(const Shifted& shifted, std::vector<double>& lambda);
  void findWrong(const Shifted& shifted, const std::vector<double>& lambda);
  void flip(const ScaledBox& box, std::uint32_t row, double lambda);
  void beginDescent(const Shifted& shifted, const std::vector<double>& lambda);
  bool descend(const Shifted& shifted, const std::vector<double>& target);
  void readStates(const Shifted& shifted);

  FreeSetFactor factor_;
  std::vector<RowState> state_;
  std::vector<std::uint8_t> isFree_;
  std::vector<std::uint32_t> wrong_;  ///< rows whose state is contradicted
  std::vector<double> side_;
  std::vector<double> current_, slope_, step_;  ///< of the descent: λ, r at λ, step to the next λ
  double factored_ = -1;  ///< ε of the factor for the present free rows, or negative
  int pivots_ = 0;
};

}  // namespace yadefrag
