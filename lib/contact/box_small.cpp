#include "contact/box_small.hpp"

#include <algorithm>
#include <cmath>

#include "core/tolerances/solver.hpp"

namespace yadefrag {
namespace {

struct TwoByTwo {
  double diagonal[2];
  double across;
};

/// |λ − clamp(λ − r/G)|·G of one row.
double rowError(double diagonal, double lambda, double r, double lower, double upper) {
  return diagonal * std::abs(lambda - std::clamp(lambda - r / diagonal, lower, upper));
}

void finish(BoxResult& result, double error, double largest) {
  result.residual = largest > 0 ? error / largest : error;
  result.converged = result.residual <= tolerance::kBoxResidual;
  result.pivots = result.refinements = 0;
}

bool solveOne(const BoxProblem& p, BoxResult& result) {
  const double diagonal = p.values.empty() ? 0 : p.values[0];
  result.lambda.resize(1);
  double& lambda = result.lambda[0];
  lambda = std::clamp(0., p.lower[0], p.upper[0]);
  if (!(diagonal > 0)) {
    finish(result, 0, 0);
    return true;
  }
  const double g = p.constant[0];
  if (!std::isfinite(g / diagonal)) return false;
  lambda = std::clamp(-g / diagonal, p.lower[0], p.upper[0]);
  const double r = diagonal * lambda + g;
  finish(result, rowError(diagonal, lambda, r, p.lower[0], p.upper[0]), std::abs(g));
  return true;
}

bool readTwo(const BoxProblem& p, TwoByTwo& m) {
  m = {{0, 0}, 0};
  for (std::uint32_t row = 0; row < 2; ++row)
    for (std::uint32_t k = p.offsets[row]; k < p.offsets[row + 1]; ++k)
      (p.columns[k] == row ? m.diagonal[row] : m.across) = p.values[k];
  const double square = m.diagonal[0] * m.diagonal[1];
  return m.diagonal[0] > 0 && m.diagonal[1] > 0 &&
         square - m.across * m.across > tolerance::kIndependentRows * square;
}

double errorOfTwo(const BoxProblem& p, const TwoByTwo& m, const double (&lambda)[2]) {
  double error = 0;
  for (int i = 0; i < 2; ++i) {
    const double r = m.diagonal[i] * lambda[i] + m.across * lambda[1 - i] + p.constant[i];
    const double one = rowError(m.diagonal[i], lambda[i], r, p.lower[i], p.upper[i]);
    if (!(one <= error)) error = one;  // NaN is kept
  }
  return error;
}

bool solveTwo(const BoxProblem& p, BoxResult& result) {
  TwoByTwo m;
  if (!readTwo(p, m)) return false;
  const auto& g = p.constant;
  const double largest = std::max(std::abs(g[0]), std::abs(g[1]));
  const double factor = m.across / m.diagonal[0];
  double lambda[2];
  lambda[1] = -(g[1] - factor * g[0]) / (m.diagonal[1] - factor * m.across);
  lambda[0] = -(g[0] + m.across * lambda[1]) / m.diagonal[0];
  double error = errorOfTwo(p, m, lambda);
  bool inside = true;
  for (int i = 0; i < 2; ++i) inside = inside && lambda[i] >= p.lower[i] && lambda[i] <= p.upper[i];
  if (!inside) error = kNoBound;

  // Otherwise one of them is at a bound; the other one is then determined.
  for (int i = 0; i < 2 && !inside; ++i)
    for (const double bound : {p.lower[i], p.upper[i]}) {
      if (!std::isfinite(bound)) continue;
      const int j = 1 - i;
      double trial[2];
      trial[i] = bound;
      trial[j] = std::clamp(-(g[j] + m.across * bound) / m.diagonal[j], p.lower[j], p.upper[j]);
      const double trialError = errorOfTwo(p, m, trial);
      if (trialError < error) {
        error = trialError;
        lambda[0] = trial[0], lambda[1] = trial[1];
      }
    }
  if (!(error <= tolerance::kBoxResidual * largest)) return false;
  result.lambda.assign(lambda, lambda + 2);
  finish(result, error, largest);
  return true;
}

}  // namespace

bool solveSmall(const BoxProblem& problem, BoxResult& result) {
  if (problem.size() == 1) return solveOne(problem, result);
  return problem.size() == 2 && solveTwo(problem, result);
}

}  // namespace yadefrag
