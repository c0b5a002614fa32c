#include "redbee/detection/rivals/ssc.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "redbee/detection/rivals/spectral_clustering.hpp"
#include "redbee/geometry/decompositions.hpp"
#include "redbee/geometry/products.hpp"

namespace redbee {
namespace {

constexpr double kAlpha = 800;
constexpr double kKeptFraction = 0.7;

double smallestGreatestCorrelation(const Eigen::MatrixXd& gram) {
  Eigen::MatrixXd off = gram.cwiseAbs();
  off.diagonal().setZero();
  return std::max(off.colwise().maxCoeff().minCoeff(), std::numeric_limits<double>::min());
}

/// (mu1 X'X + mu2 I + mu2 11')^-1, as a product: 1/mu2 (I - V (mu2 I + V'V)^-1 V') with V = [sqrt(mu1) X',
/// sqrt(mu2) 1].
class RidgeInverse {
 public:
  RidgeInverse(const Eigen::MatrixXd& X, double mu1, double mu2) : V_(X.cols(), X.rows() + 1), mu2_(mu2) {
    V_ << std::sqrt(mu1) * X.transpose(), Eigen::VectorXd::Constant(X.cols(), std::sqrt(mu2));
    const Eigen::MatrixXd inner =
        transposedProduct(V_, V_) + mu2 * Eigen::MatrixXd::Identity(V_.cols(), V_.cols());
    inner_ = LltFactors(inner).solve(V_.transpose());
  }
  Eigen::MatrixXd operator*(const Eigen::MatrixXd& B) const {
    const Eigen::MatrixXd small = product(inner_, B);
    return (B - product(V_, small)) / mu2_;
  }

 private:
  Eigen::MatrixXd V_, inner_;
  double mu2_;
};

Eigen::MatrixXd softThreshold(const Eigen::MatrixXd& M, double by) {
  return (M.array().abs() - by).max(0.0) * M.array().sign();
}

/// Keeps the largest entries of the column, up to the fraction of its L1 norm.
void keepLargest(Eigen::Ref<Eigen::VectorXd> column) {
  std::vector<Eigen::Index> order(static_cast<size_t>(column.size()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return column(a) > column(b); });
  const double enough = kKeptFraction * column.sum();
  double sum = 0;
  for (const Eigen::Index i : order) {
    const double value = column(i);
    if (sum > enough) column(i) = 0;
    sum += value;
  }
}

}  // namespace

SparseRepresentation sparseRepresentation(const Eigen::MatrixXd& X, int max_iterations, double tolerance) {
  const Eigen::Index n = X.cols();
  const Eigen::MatrixXd gram = transposedProduct(X, X);
  const double mu1 = kAlpha / smallestGreatestCorrelation(gram);
  constexpr double kMu2 = kAlpha;
  const RidgeInverse inverse(X, mu1, kMu2);
  const Eigen::MatrixXd constant = (mu1 * gram).array() + kMu2;
  SparseRepresentation answer;
  Eigen::MatrixXd& C = answer.C = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd multiplier = Eigen::MatrixXd::Zero(n, n);
  Eigen::RowVectorXd sum_multiplier = Eigen::RowVectorXd::Zero(n);
  while (answer.iterations < max_iterations && !answer.converged) {
    Eigen::MatrixXd right = constant + kMu2 * C - multiplier;
    right.rowwise() -= sum_multiplier;
    Eigen::MatrixXd Z = inverse * right;
    Z.diagonal().setZero();
    C = softThreshold(Z + multiplier / kMu2, 1 / kMu2);
    C.diagonal().setZero();
    multiplier += kMu2 * (Z - C);
    const Eigen::RowVectorXd gap = Z.colwise().sum().array() - 1;
    sum_multiplier += kMu2 * gap;
    answer.consensus = (Z - C).cwiseAbs().maxCoeff();
    answer.affinity_gap = gap.cwiseAbs().maxCoeff();
    answer.converged = answer.consensus < tolerance && answer.affinity_gap < tolerance;
    ++answer.iterations;
  }
  return answer;
}

std::vector<int> sscClusters(const Eigen::MatrixXd& X, int count) {
  Eigen::MatrixXd C = sparseRepresentation(X).C.cwiseAbs();
  for (Eigen::Index i = 0; i < C.cols(); ++i) {
    keepLargest(C.col(i));
    C.col(i) /= std::max(C.col(i).maxCoeff(), std::numeric_limits<double>::epsilon());
  }
  return spectralClusters(C + C.transpose(), count);
}

}  // namespace redbee
