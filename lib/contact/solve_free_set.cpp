#include "contact/solve_free_set.hpp"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "core/tolerances/solver.hpp"

namespace yadefrag {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Cholesky factor in place, lower triangle of a row-major square matrix. Plain loops: below some
/// dozen rows the blocking of Eigen costs more than the work.
bool choleskySmall(double* m, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    double* row = m + i * n;
    double diagonal = row[i];
    for (std::size_t j = 0; j < i; ++j) {
      const double* other = m + j * n;
      double sum = row[j];
      for (std::size_t k = 0; k < j; ++k) sum -= row[k] * other[k];
      row[j] = sum / other[j];
      diagonal -= row[j] * row[j];
    }
    if (!(diagonal > 0)) return false;
    row[i] = std::sqrt(diagonal);
  }
  return true;
}

void substitute(const double* m, std::size_t n, double* x) {
  for (std::size_t i = 0; i < n; ++i) {
    double sum = x[i];
    for (std::size_t k = 0; k < i; ++k) sum -= m[i * n + k] * x[k];
    x[i] = sum / m[i * n + i];
  }
  for (std::size_t i = n; i-- > 0;) {
    x[i] /= m[i * n + i];
    for (std::size_t k = 0; k < i; ++k) x[k] -= m[i * n + k] * x[i];
  }
}

}  // namespace

/// The pattern is that of the whole matrix, so that one order of elimination is valid for every
/// free set: rows that are not free become rows of the unit matrix.
struct FreeSetFactor::Sparse {
  Eigen::SparseMatrix<double> lower;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::AMDOrdering<int>> ldlt;
  Eigen::VectorXd side, solution;

  void analyze(const SparseView& matrix) {
    const auto n = static_cast<Eigen::Index>(matrix.size());
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(matrix.values.size());
    for (std::uint32_t i = 0; i < matrix.size(); ++i) {
      entries.emplace_back(i, i, 1);  // present even if G has no such entry
      for (std::uint32_t k = matrix.offsets[i]; k < matrix.offsets[i + 1]; ++k)
        if (matrix.columns[k] < i) entries.emplace_back(i, matrix.columns[k], matrix.values[k]);
    }
    lower.resize(n, n);
    lower.setFromTriplets(entries.begin(), entries.end());
    ldlt.analyzePattern(lower);
    side.resize(n);
  }
};

FreeSetFactor::FreeSetFactor() = default;
FreeSetFactor::~FreeSetFactor() = default;

void FreeSetFactor::setMatrix(const SparseView& matrix) {
  matrix_ = matrix;
  const std::size_t n = matrix.size();
  dense_ = n <= tolerance::kDenseRows ||
           (n <= tolerance::kMostDenseRows && 4 * matrix.values.size() > n * n);
  if (dense_) return;
  if (!sparse_) sparse_ = std::make_unique<Sparse>();
  sparse_->analyze(matrix);
}

bool FreeSetFactor::factorize(const std::vector<std::uint8_t>& isFree, double added) {
  rows_.clear();
  for (std::uint32_t i = 0; i < isFree.size(); ++i)
    if (isFree[i]) rows_.push_back(i);
  return dense_ ? factorizeDense(added) : factorizeSparse(isFree, added);
}

bool FreeSetFactor::factorizeDense(double added) {
  const std::size_t n = rows_.size();
  constexpr std::uint32_t kNotFree = 0xffffffff;
  place_.assign(matrix_.size(), kNotFree);
  for (std::uint32_t i = 0; i < n; ++i) place_[rows_[i]] = i;
  triangle_.assign(n * n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t row = rows_[i];
    for (std::uint32_t k = matrix_.offsets[row]; k < matrix_.offsets[row + 1]; ++k)
      if (const std::uint32_t j = place_[matrix_.columns[k]]; j <= i && j != kNotFree)
        triangle_[i * n + j] = matrix_.values[k];
    triangle_[i * n + i] += added;
  }
  if (n <= tolerance::kPlainCholesky) return choleskySmall(triangle_.data(), n);
  Eigen::Map<RowMajor> m(triangle_.data(), static_cast<Eigen::Index>(n),
                         static_cast<Eigen::Index>(n));
  const Eigen::LLT<Eigen::Ref<RowMajor>, Eigen::Lower> inPlace(m);
  return inPlace.info() == Eigen::Success;
}

bool FreeSetFactor::factorizeSparse(const std::vector<std::uint8_t>& isFree, double added) {
  auto& lower = sparse_->lower;
  for (std::uint32_t i : rows_) sparse_->side[i] = 0;
  std::fill_n(lower.valuePtr(), lower.nonZeros(), 0.);
  // Column j of the lower triangle is row j of the upper one.
  for (std::uint32_t j = 0; j < isFree.size(); ++j) {
    const int begin = lower.outerIndexPtr()[j];
    lower.valuePtr()[begin] = isFree[j] ? 1 + added : 1;
  }
  for (const std::uint32_t i : rows_)
    for (std::uint32_t k = matrix_.offsets[i]; k < matrix_.offsets[i + 1]; ++k)
      if (const std::uint32_t j = matrix_.columns[k]; j < i && isFree[j])
        lower.coeffRef(i, j) = matrix_.values[k];
  sparse_->ldlt.factorize(lower);
  return sparse_->ldlt.info() == Eigen::Success && sparse_->ldlt.vectorD().minCoeff() > 0;
}

void FreeSetFactor::solve(std::vector<double>& x) {
  if (!dense_) {
    sparse_->side.setZero();
    for (const std::uint32_t i : rows_) sparse_->side[i] = x[i];
    sparse_->solution = sparse_->ldlt.solve(sparse_->side);
    for (const std::uint32_t i : rows_) x[i] = sparse_->solution[i];
    return;
  }
  side_.resize(rows_.size());
  for (std::size_t i = 0; i < rows_.size(); ++i) side_[i] = x[rows_[i]];
  substitute(triangle_.data(), rows_.size(), side_.data());
  for (std::size_t i = 0; i < rows_.size(); ++i) x[rows_[i]] = side_[i];
}

}  // namespace yadefrag
