#pragma once
// The forces of one contact group: find λ with lower ≤ λ ≤ upper such that r = Gλ + g is
// complementary to it: r ≥ 0 where λ is at its lower bound, r ≤ 0 where at its upper, r = 0
// between. G is symmetric and positive semi-definite; redundant rows (both passes of master and
// slave) make it singular. A normal row has 0 ≤ λ < ∞ and r is its gap, a friction row −b ≤ λ ≤ b
// and r its slip.

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace yadefrag {

inline constexpr double kNoBound = std::numeric_limits<double>::infinity();

struct MatrixEntry {
  std::uint32_t row;
  std::uint32_t column;
  double value;
};

struct BoxProblem {
  // G, both triangles, as compressed sparse rows; columns of a row in any order, each once.
  std::vector<std::uint32_t> offsets;
  std::vector<std::uint32_t> columns;
  std::vector<double> values;        ///< m/N
  std::vector<double> constant;      ///< m, g
  std::vector<double> lower, upper;  ///< N; −∞ and ∞ are allowed, lower ≤ upper

  [[nodiscard]] std::size_t size() const { return constant.size(); }
  /// G from entries of both triangles in any order; repeated ones add up. Columns come out
  /// ascending.
  void setMatrix(std::size_t size, std::span<const MatrixEntry> entries);
};

struct BoxResult {
  std::vector<double> lambda;  ///< N
  /// Largest error of the true problem over max |g|: Gᵢᵢ·|λᵢ − clamp(λᵢ − rᵢ/Gᵢᵢ)|, which is the
  /// gap or slip that is wrong. Rows with Gᵢᵢ = 0 (all nodes fixed) are left out.
  double residual = 0;
  int pivots = 0;          ///< changes of the set of free rows
  int refinements = 0;     ///< solves after the first that took the regularisation out again
  bool converged = false;  ///< residual within tolerance or what rounding allows
};

/// Solves one problem after another and keeps its memory; the answer depends on the arguments
/// alone. Block principal pivoting on G + ε·diag(G), which is definite, with projected Newton steps
/// where it stalls; proximal iterations take ε out again; a larger ε if they fail, Gauss–Seidel
/// sweeps if that fails, too. A problem without a solution (a node pinched between walls) ends with
/// a bounded compromise and `converged` false. Never throws on numbers, not even on NaN.
class BoxSolver {
 public:
  BoxSolver();
  ~BoxSolver();
  BoxSolver(BoxSolver&&) noexcept;
  BoxSolver& operator=(BoxSolver&&) noexcept;

  /// `start`: a guess of λ (of the step before), or empty. The result lives until the next call.
  const BoxResult& solve(const BoxProblem& problem, std::span<const double> start = {});

 private:
  struct Work;
  std::unique_ptr<Work> work_;
  BoxResult result_;
};

}  // namespace yadefrag
