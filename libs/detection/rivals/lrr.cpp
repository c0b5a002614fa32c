#include "redbee/detection/rivals/lrr.hpp"

#include <algorithm>
#include <cmath>

#include "redbee/detection/rivals/spectral_clustering.hpp"
#include "redbee/geometry/decompositions.hpp"
#include "redbee/geometry/products.hpp"

namespace redbee {
namespace {

constexpr double kFirstMu = 1e-6;
constexpr double kRho = 1.1;
constexpr double kGreatestMu = 1e10;
constexpr double kTolerance = 1e-8;
constexpr int kMaxIterations = 1000;
constexpr double kRankTolerance = 1e-10;

/// Columns: orthonormal basis of the row space.
Eigen::MatrixXd rowSpace(const Eigen::MatrixXd& X) {
  const ThinSvd svd = thinSvd(X);
  const Eigen::Index rank = (svd.values.array() > kRankTolerance * svd.values(0)).count();
  return svd.V.leftCols(rank);
}

/// Nearest matrix of small nuclear norm: singular values less `by`.
Eigen::MatrixXd shrinkSingularValues(const Eigen::MatrixXd& M, double by) {
  const ThinSvd svd = thinSvd(M);
  const Eigen::VectorXd kept = (svd.values.array() - by).max(0.0);
  return productTransposed(svd.U * kept.asDiagonal(), svd.V);
}

Eigen::MatrixXd shrinkColumns(const Eigen::MatrixXd& M, double by) {
  const Eigen::RowVectorXd length = M.colwise().norm();
  const Eigen::RowVectorXd scale = (length.array() > by).select((length.array() - by) / length.array(), 0.0);
  return M * scale.asDiagonal();
}

}  // namespace

LowRankRepresentation lowRankRepresentation(const Eigen::MatrixXd& X, double lambda) {
  const Eigen::MatrixXd basis = rowSpace(X);
  const Eigen::MatrixXd A = product(X, basis);
  const Eigen::MatrixXd inner = transposedProduct(A, A) + Eigen::MatrixXd::Identity(A.cols(), A.cols());
  const LltFactors solver(inner);
  Eigen::MatrixXd Z = Eigen::MatrixXd::Zero(A.cols(), X.cols());
  Eigen::MatrixXd Y1 = Eigen::MatrixXd::Zero(X.rows(), X.cols());
  Eigen::MatrixXd Y2 = Z;
  LowRankRepresentation answer;
  answer.E = Y1;
  double mu = kFirstMu;
  while (answer.iterations < kMaxIterations && !answer.converged) {
    const Eigen::MatrixXd J = shrinkSingularValues(Z + Y2 / mu, 1 / mu);
    Z = solver.solve(transposedProduct(A, X - answer.E + Y1 / mu) + J - Y2 / mu);
    answer.E = shrinkColumns(X - product(A, Z) + Y1 / mu, lambda / mu);
    const Eigen::MatrixXd data_gap = X - product(A, Z) - answer.E;
    const Eigen::MatrixXd copy_gap = Z - J;
    answer.constraint = data_gap.cwiseAbs().maxCoeff();
    answer.converged = std::max(answer.constraint, copy_gap.cwiseAbs().maxCoeff()) < kTolerance;
    Y1 += mu * data_gap;
    Y2 += mu * copy_gap;
    mu = std::min(kGreatestMu, kRho * mu);
    ++answer.iterations;
  }
  answer.Z = product(basis, Z);
  return answer;
}

std::vector<int> lrrClusters(const Eigen::MatrixXd& X, int count) {
  Eigen::MatrixXd with_ones(X.rows() + 1, X.cols());
  with_ones << X, Eigen::RowVectorXd::Ones(X.cols());
  // Z = B Z_r with B orthonormal: its left singular vectors are B times those of the few rows of Z_r.
  const LowRankRepresentation answer = lowRankRepresentation(with_ones);
  const Eigen::MatrixXd basis = rowSpace(with_ones);
  const ThinSvd svd = leftThinSvd(transposedProduct(basis, answer.Z));
  const Eigen::VectorXd& values = svd.values;
  const Eigen::Index rank = std::max<Eigen::Index>(1, (values.array() > 1e-4 * values(0)).count());
  Eigen::MatrixXd U = product(basis, svd.U.leftCols(rank)) * values.head(rank).cwiseSqrt().asDiagonal();
  U.rowwise().normalize();
  const Eigen::MatrixXd W = productTransposed(U, U).array().square().square();
  constexpr bool kNormalisedCut = false;
  return spectralClusters(W, count, kNormalisedCut);
}

}  // namespace redbee
