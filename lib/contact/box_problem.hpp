#pragma once
// The forces of one contact group: find λ with lower ≤ λ ≤ upper such that r = Gλ + g is
// complementary to it: r ≥ 0 where λ is at its lower bound, r ≤ 0 where it is at its upper bound, r
// = 0 in between. G is symmetric and positive semi-definite; redundant rows (both passes of master
// and slave) make it singular. A normal row has 0 ≤ λ < ∞, and r is its gap. A friction row has −b
// ≤ λ ≤ b, and r is its slip.

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
  std::vector<double> lower, upper;  ///< N; may be −∞ and ∞; lower ≤ upper

  [[nodiscard]] std::size_t size() const { return constant.size(); }
  /// Sets G from entries of both triangles in any order; repeated entries are added. The columns of
  /// the result ascend.
  void setMatrix(std::size_t size, std::span<const MatrixEntry> entries);
};

struct BoxResult {
  std::vector<double> lambda;  ///< N
  /// Largest error of the original problem over max |g|: Gᵢᵢ·|λᵢ − clamp(λᵢ − rᵢ/Gᵢᵢ)|, which is
  /// the error of a gap or slip. Rows with Gᵢᵢ = 0 (all nodes fixed) are excluded.
  double residual = 0;
  int pivots = 0;          ///< changes of the set of free rows
  int refinements = 0;     ///< solutions after the first that removed the regularisation
  bool converged = false;  ///< residual within the tolerance, or of the size of rounding
};

/// Solves a sequence of problems, and keeps its memory; the result depends on the arguments only.
/// Method: block principal pivoting on G + ε·diag(G), which is definite, with projected Newton
/// steps if it stalls; proximal iterations remove the effect of ε. If they fail, a larger ε is
/// used; if that fails, too, Gauss–Seidel sweeps. A problem without a solution (a node between two
/// walls that approach each other) ends with bounded forces and `converged` false. Numbers never
/// cause an exception, not even NaN.
class BoxSolver {
 public:
  BoxSolver();
  ~BoxSolver();
  BoxSolver(BoxSolver&&) noexcept;
  BoxSolver& operator=(BoxSolver&&) noexcept;

  /// `start`: initial λ (that of the previous step), or empty. The result is valid until the next
  /// call.
  const BoxResult& solve(const BoxProblem& problem, std::span<const double> start = {});

 private:
  struct Work;
  std::unique_ptr<Work> work_;
  BoxResult result_;
};

}  // namespace yadefrag
