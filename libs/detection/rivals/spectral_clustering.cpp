#include "redbee/detection/rivals/spectral_clustering.hpp"

#include <Spectra/SymEigsSolver.h>

#include <algorithm>
#include <opencv2/core/eigen.hpp>

namespace redbee {
namespace {

constexpr int kRestarts = 10;
constexpr int kIterations = 200;
constexpr double kMoved = 1e-6;
constexpr uint64_t kSeed = 1;

/// k-means++ with restarts. OpenCV uses the thread's random generator, which is seeded and restored.
std::vector<int> kMeans(const Eigen::MatrixXd& rows, int count) {
  cv::Mat samples;
  cv::eigen2cv(Eigen::MatrixXf(rows.cast<float>()), samples);
  const cv::RNG kept = cv::theRNG();
  cv::theRNG() = cv::RNG(kSeed);
  cv::Mat labels;
  cv::kmeans(samples, count, labels, {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, kIterations, kMoved},
             kRestarts, cv::KMEANS_PP_CENTERS);
  cv::theRNG() = kept;
  return {labels.begin<int>(), labels.end<int>()};
}

/// Ascending. OpenCV's solver is compiled already: Eigen's takes a compiler seconds.
Eigen::MatrixXd leadingOfAllEigenvectors(const Eigen::MatrixXd& M, int count) {
  cv::Mat1d matrix, values, rows;
  cv::eigen2cv(M, matrix);
  cv::eigen(matrix, values, rows);
  Eigen::MatrixXd vectors;
  cv::cv2eigen(rows.rowRange(0, count).t(), vectors);
  return vectors.rowwise().reverse();
}

/// Eigenvectors of the `count` largest eigenvalues; Lanczos, and all of them where that does not converge.
Eigen::MatrixXd leadingEigenvectors(const Eigen::MatrixXd& M, int count) {
  Spectra::DenseSymMatProd<double> product(M);
  const int basis = std::min<int>(static_cast<int>(M.rows()), std::max(2 * count + 1, 20));
  Spectra::SymEigsSolver<Spectra::DenseSymMatProd<double>> solver(product, count, basis);
  solver.init();
  solver.compute(Spectra::SortRule::LargestAlge);
  if (solver.info() == Spectra::CompInfo::Successful) return solver.eigenvectors();
  return leadingOfAllEigenvectors(M, count);
}

}  // namespace

std::vector<int> spectralClusters(const Eigen::MatrixXd& W, int count, bool rows_to_unit) {
  if (W.rows() < 2 * count) return std::vector<int>(static_cast<size_t>(W.rows()), 0);
  const Eigen::VectorXd root = W.rowwise().sum().cwiseMax(1e-12).cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd vectors = leadingEigenvectors(root.asDiagonal() * W * root.asDiagonal(), count);
  if (rows_to_unit) {
    vectors.rowwise().normalize();
  } else {
    vectors = root.asDiagonal() * vectors;
  }
  return kMeans(vectors, count);
}

}  // namespace redbee
