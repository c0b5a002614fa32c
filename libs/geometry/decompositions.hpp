// Decompositions that are compiled once: each of Eigen's takes a compiler seconds wherever it is used.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace redbee {

/// M = U diag(values) V', U and V with min(rows, columns) columns; largest value first.
struct ThinSvd {
  Eigen::MatrixXd U;
  Eigen::VectorXd values;
  Eigen::MatrixXd V;
};
ThinSvd thinSvd(const Eigen::MatrixXd& M);
/// The same without V, which stays empty.
ThinSvd leftThinSvd(const Eigen::MatrixXd& M);

/// L L' of a positive definite matrix.
class LltFactors {
 public:
  explicit LltFactors(const Eigen::MatrixXd& M);
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;

 private:
  Eigen::LLT<Eigen::MatrixXd> factors_;
};

}  // namespace redbee
