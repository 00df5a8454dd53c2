#include "contact/box_pivoting.hpp"

#include <algorithm>
#include <cmath>

#include "core/tolerances/solver.hpp"

namespace yadefrag {

void BoxPivoting::begin(const ScaledBox& box, const std::vector<double>& lambda, bool isGuess) {
  const std::size_t n = box.size();
  factor_.setMatrix(box.matrix);
  state_.resize(n);
  isFree_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const bool atLower = lambda[i] <= box.lower[i];
    const bool atUpper = lambda[i] >= box.upper[i];
    // Without a guess, rows that are violated at λ are free.
    const double r = isGuess ? 0 : box.matrix.rowTimes(i, lambda.data()) + box.constant[i];
    const bool stays = (atLower && atUpper) || (atLower && r >= 0) || (atUpper && r <= 0);
    state_[i] = !stays ? RowState::kFree : atLower ? RowState::kAtLower : RowState::kAtUpper;
    isFree_[i] = !stays;
  }
  factored_ = -1;
  pivots_ = 0;
}

double BoxPivoting::Shifted::residual(std::size_t i, const std::vector<double>& lambda) const {
  return box.matrix.rowTimes(i, lambda.data()) + box.constant[i] + added * (lambda[i] - centre[i]);
}

bool BoxPivoting::solve(const ScaledBox& box, double added, const std::vector<double>& centre,
                        std::vector<double>& lambda) {
  const Shifted shifted{box, added, centre};
  std::size_t fewest = box.size() + 1;
  int blocksLeft = tolerance::kBlocksWithoutGain;
  for (int i = 0; i < tolerance::kMostPivots; ++i) {
    if (!solveForStates(shifted, lambda)) return false;
    findWrong(shifted, lambda);
    if (wrong_.empty()) return true;
    ++pivots_;
    factored_ = -1;
    if (blocksLeft < 0) {
      if (!descend(shifted, lambda)) return false;
      continue;
    }
    if (wrong_.size() < fewest) {
      fewest = wrong_.size();
      blocksLeft = tolerance::kBlocksWithoutGain;
    } else if (--blocksLeft < 0) {
      beginDescent(shifted, lambda);
      continue;
    }
    for (const std::uint32_t row : wrong_) flip(box, row, lambda[row]);
  }
  return false;
}

void BoxPivoting::flip(const ScaledBox& box, std::uint32_t row, double lambda) {
  RowState& state = state_[row];
  if (state != RowState::kFree)
    state = RowState::kFree;
  else
    state = lambda < box.lower[row] ? RowState::kAtLower : RowState::kAtUpper;
  isFree_[row] = state == RowState::kFree;
}

bool BoxPivoting::solveForStates(const Shifted& shifted, std::vector<double>& lambda) {
  const ScaledBox& box = shifted.box;
  const std::size_t n = box.size();
  if (factored_ != shifted.added) {
    if (!factor_.factorize(isFree_, shifted.added)) return false;
    factored_ = shifted.added;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const bool low = state_[i] == RowState::kAtLower;
    lambda[i] = isFree_[i] ? 0 : (low ? box.lower[i] : box.upper[i]);
  }
  side_.resize(n);
  for (std::size_t i = 0; i < n; ++i)
    if (isFree_[i]) side_[i] = -shifted.residual(i, lambda);
  factor_.solve(side_);
  for (std::size_t i = 0; i < n; ++i) {
    if (isFree_[i]) lambda[i] = side_[i];
    if (!std::isfinite(lambda[i])) return false;
  }
  return true;
}

void BoxPivoting::findWrong(const Shifted& shifted, const std::vector<double>& lambda) {
  const ScaledBox& box = shifted.box;
  wrong_.clear();
  for (std::uint32_t i = 0; i < box.size(); ++i) {
    bool wrong = false;
    if (isFree_[i]) {
      wrong = lambda[i] < box.lower[i] - box.slack[i] || lambda[i] > box.upper[i] + box.slack[i];
    } else if (box.lower[i] < box.upper[i]) {
      const double r = shifted.residual(i, lambda);
      wrong = state_[i] == RowState::kAtLower ? r < -box.slack[i] : r > box.slack[i];
    }
    if (wrong) wrong_.push_back(i);
  }
}

void BoxPivoting::beginDescent(const Shifted& shifted, const std::vector<double>& lambda) {
  const ScaledBox& box = shifted.box;
  current_.resize(box.size());
  for (std::size_t i = 0; i < box.size(); ++i)
    current_[i] = std::clamp(lambda[i], box.lower[i], box.upper[i]);
  readStates(shifted);
}

/// Rows at a bound whose r pushes them against it stay there; the others are free.
void BoxPivoting::readStates(const Shifted& shifted) {
  const ScaledBox& box = shifted.box;
  slope_.resize(box.size());
  for (std::size_t i = 0; i < box.size(); ++i) {
    slope_[i] = shifted.residual(i, current_);
    const bool low = current_[i] <= box.lower[i];
    const bool high = current_[i] >= box.upper[i];
    const bool stays = (low && high) || (low && slope_[i] > 0) || (high && slope_[i] < 0);
    state_[i] = !stays ? RowState::kFree : low ? RowState::kAtLower : RowState::kAtUpper;
    isFree_[i] = !stays;
  }
}

/// Moves from `current_` towards the target, clamped to the bounds, as far as the energy decreases
/// sufficiently.
bool BoxPivoting::descend(const Shifted& shifted, const std::vector<double>& target) {
  const ScaledBox& box = shifted.box;
  step_.resize(box.size());
  for (double part = 1; part > tolerance::kLeastDescent; part *= .5) {
    double first = 0;
    double second = 0;
    for (std::size_t i = 0; i < box.size(); ++i) {
      const double moved = current_[i] + part * (target[i] - current_[i]);
      step_[i] = std::clamp(moved, box.lower[i], box.upper[i]) - current_[i];
      first += step_[i] * slope_[i];
    }
    for (std::size_t i = 0; i < box.size(); ++i)
      second += step_[i] * (box.matrix.rowTimes(i, step_.data()) + shifted.added * step_[i]);
    if (!(first + .5 * second <= tolerance::kArmijo * first) || first >= 0) continue;
    for (std::size_t i = 0; i < box.size(); ++i)
      current_[i] = std::clamp(current_[i] + step_[i], box.lower[i], box.upper[i]);
    readStates(shifted);
    return true;
  }
  return false;
}

}  // namespace yadefrag
