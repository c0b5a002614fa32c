// 3x3 matrices as nine numbers, row by row, as in messages and files.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace redbee {

using RowMajor3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

inline std::vector<double> rowByRow(const Eigen::Matrix3d& M) {
  const RowMajor3d rows = M;
  return {rows.data(), rows.data() + rows.size()};
}

}  // namespace redbee
