// Numeric Jacobians, to check analytic ones.
#pragma once

#include <Eigen/Core>

namespace redbee::test {

/// Central differences of a function of n variables around zero.
template <int kRows, int kCols, typename Function>
Eigen::Matrix<double, kRows, kCols> numericJacobian(const Function& f, double step = 1e-6) {
  Eigen::Matrix<double, kRows, kCols> J;
  for (int i = 0; i < kCols; ++i) {
    Eigen::Matrix<double, kCols, 1> d = Eigen::Matrix<double, kCols, 1>::Zero();
    d(i) = step;
    J.col(i) = (f(d) - f(-d)) / (2 * step);
  }
  return J;
}

}  // namespace redbee::test
