#include "contact/box_pivoting.hpp"

#include <algorithm>
#include <cmath>

#include "core/tolerances.hpp"

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

bool BoxPivoting::solve(const ScaledBox& box, double added, const std::vector<double>& centre,
                        std::vector<double>& lambda) {
  std::size_t fewest = box.size() + 1;
  int blocksLeft = tolerance::kBlocksWithoutGain;
  for (int i = 0; i < tolerance::kMostPivots; ++i) {
    if (!solveForStates(box, added, centre, lambda)) return false;
    findWrong(box, added, centre, lambda);
    if (wrong_.empty()) return true;
    ++pivots_;
    factored_ = -1;
    if (wrong_.size() < fewest) {
      fewest = wrong_.size();
      blocksLeft = tolerance::kBlocksWithoutGain;
    } else if (--blocksLeft < 0) {
      // Single pivots on the last row are finite (K. G. Murty's rule).
      wrong_.assign(1, wrong_.back());
    }
    for (const std::uint32_t row : wrong_) pivot(box, row, lambda[row]);
  }
  return false;
}

void BoxPivoting::pivot(const ScaledBox& box, std::uint32_t row, double lambda) {
  RowState& state = state_[row];
  if (state != RowState::kFree)
    state = RowState::kFree;
  else
    state = lambda < box.lower[row] ? RowState::kAtLower : RowState::kAtUpper;
  isFree_[row] = state == RowState::kFree;
}

bool BoxPivoting::solveForStates(const ScaledBox& box, double added,
                                 const std::vector<double>& centre, std::vector<double>& lambda) {
  const std::size_t n = box.size();
  if (factored_ != added) {
    if (!factor_.factorize(isFree_, added)) return false;
    factored_ = added;
  }
  for (std::size_t i = 0; i < n; ++i)
    lambda[i] = isFree_[i] ? 0 : state_[i] == RowState::kAtLower ? box.lower[i] : box.upper[i];
  side_.resize(n);
  for (std::size_t i = 0; i < n; ++i)
    if (isFree_[i])
      side_[i] = added * centre[i] - box.constant[i] - box.matrix.rowTimes(i, lambda.data());
  factor_.solve(side_);
  for (std::size_t i = 0; i < n; ++i) {
    if (isFree_[i]) lambda[i] = side_[i];
    if (!std::isfinite(lambda[i])) return false;
  }
  return true;
}

void BoxPivoting::findWrong(const ScaledBox& box, double added, const std::vector<double>& centre,
                            const std::vector<double>& lambda) {
  wrong_.clear();
  for (std::uint32_t i = 0; i < box.size(); ++i) {
    bool wrong = false;
    if (isFree_[i]) {
      wrong = lambda[i] < box.lower[i] - box.slack[i] || lambda[i] > box.upper[i] + box.slack[i];
    } else if (box.lower[i] < box.upper[i]) {
      const double r =
          box.matrix.rowTimes(i, lambda.data()) + box.constant[i] + added * (lambda[i] - centre[i]);
      wrong = state_[i] == RowState::kAtLower ? r < -box.slack[i] : r > box.slack[i];
    }
    if (wrong) wrong_.push_back(i);
  }
}

}  // namespace yadefrag
