#include "redbee/geometry/products.hpp"

namespace redbee {

Eigen::MatrixXd product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) { return A * B; }

Eigen::MatrixXd transposedProduct(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return A.transpose() * B;
}

Eigen::MatrixXd productTransposed(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return A * B.transpose();
}

namespace fixed_size {

using Input = Eigen::Map<const Eigen::MatrixXd>;

void multiply(const double* A, const double* B, double* C, Sizes sizes) {
  Eigen::Map<Eigen::MatrixXd>(C, sizes.rows, sizes.columns).noalias() =
      Input(A, sizes.rows, sizes.depth) * Input(B, sizes.depth, sizes.columns);
}

void multiplyTransposed(const double* A, const double* B, double* C, Sizes sizes) {
  Eigen::Map<Eigen::MatrixXd>(C, sizes.rows, sizes.columns).noalias() =
      Input(A, sizes.rows, sizes.depth) * Input(B, sizes.columns, sizes.depth).transpose();
}

void multiplyTransposedToRows(const double* A, const double* B, double* C, Sizes sizes) {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Map<Rows>(C, sizes.rows, sizes.columns).noalias() =
      Input(A, sizes.rows, sizes.depth) * Input(B, sizes.columns, sizes.depth).transpose();
}

}  // namespace fixed_size
}  // namespace redbee
