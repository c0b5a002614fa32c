#include "redbee/geometry/decompositions.hpp"

#include <Eigen/SVD>

namespace redbee {
namespace {

using Svd = Eigen::JacobiSVD<Eigen::MatrixXd>;

}  // namespace

ThinSvd thinSvd(const Eigen::MatrixXd& M) {
  const Svd svd(M, Eigen::ComputeThinU | Eigen::ComputeThinV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

ThinSvd leftThinSvd(const Eigen::MatrixXd& M) {
  const Svd svd(M, Eigen::ComputeThinU);
  return {svd.matrixU(), svd.singularValues(), {}};
}

LltFactors::LltFactors(const Eigen::MatrixXd& M) : factors_(M) {}

Eigen::MatrixXd LltFactors::solve(const Eigen::MatrixXd& B) const { return factors_.solve(B); }

}  // namespace redbee
