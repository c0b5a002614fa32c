// Matrix products that are compiled once: Eigen instantiates its blocked product for each combination of
// sizes, which takes a compiler half a second. The results are those of Eigen's operators to the bit.
#pragma once

#include <Eigen/Core>

namespace redbee {

/// A B, A' B and A B'.
Eigen::MatrixXd product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
Eigen::MatrixXd transposedProduct(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
Eigen::MatrixXd productTransposed(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

namespace fixed_size {

struct Sizes {
  int rows, depth, columns;
};
/// Column-major, without gaps.
void multiply(const double* A, const double* B, double* C, Sizes sizes);
void multiplyTransposed(const double* A, const double* B, double* C, Sizes sizes);
/// The same with C row-major, where the sums run in another order.
void multiplyTransposedToRows(const double* A, const double* B, double* C, Sizes sizes);

/// Where Eigen takes the blocked product.
template <int kRows, int kDepth, int kColumns>
constexpr bool isBlocked() {
  constexpr int kLarge = 8, kLeastSum = 20;
  return kRows > 1 && kColumns > 1 && kRows + kDepth + kColumns >= kLeastSum &&
         (kDepth >= kLarge || (kDepth > 1 && kRows >= kLarge && kColumns >= kLarge));
}

}  // namespace fixed_size

/// The same for matrices of fixed size, without allocation.
template <int kRows, int kDepth, int kColumns>
Eigen::Matrix<double, kRows, kColumns> product(const Eigen::Matrix<double, kRows, kDepth>& A,
                                               const Eigen::Matrix<double, kDepth, kColumns>& B) {
  if constexpr (fixed_size::isBlocked<kRows, kDepth, kColumns>()) {
    Eigen::Matrix<double, kRows, kColumns> C;
    fixed_size::multiply(A.data(), B.data(), C.data(), {kRows, kDepth, kColumns});
    return C;
  } else {
    return A * B;
  }
}

template <int kRows, int kDepth, int kColumns>
Eigen::Matrix<double, kRows, kColumns> productTransposed(const Eigen::Matrix<double, kRows, kDepth>& A,
                                                         const Eigen::Matrix<double, kColumns, kDepth>& B) {
  if constexpr (fixed_size::isBlocked<kRows, kDepth, kColumns>()) {
    Eigen::Matrix<double, kRows, kColumns> C;
    fixed_size::multiplyTransposed(A.data(), B.data(), C.data(), {kRows, kDepth, kColumns});
    return C;
  } else {
    return A * B.transpose();
  }
}

/// J P J', a covariance after the linear map J.
template <int kRows, int kSize>
Eigen::Matrix<double, kRows, kRows> mappedCovariance(const Eigen::Matrix<double, kRows, kSize>& J,
                                                     const Eigen::Matrix<double, kSize, kSize>& P) {
  return productTransposed(product(J, P), J);
}

/// J P J' + Q, row-major, as Eigen computes the product within a sum.
template <int kRows, int kSize>
Eigen::Matrix<double, kRows, kRows, Eigen::RowMajor> mappedCovariancePlus(
    const Eigen::Matrix<double, kRows, kSize>& J, const Eigen::Matrix<double, kSize, kSize>& P,
    const Eigen::Matrix<double, kRows, kRows>& Q) {
  static_assert(fixed_size::isBlocked<kRows, kSize, kRows>());
  Eigen::Matrix<double, kRows, kRows, Eigen::RowMajor> C;
  fixed_size::multiplyTransposedToRows(product(J, P).data(), J.data(), C.data(), {kRows, kSize, kRows});
  return C + Q;
}

}  // namespace redbee
