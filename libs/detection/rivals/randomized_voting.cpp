#include "redbee/detection/rivals/randomized_voting.hpp"

#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <optional>
#include <random>

namespace redbee {
namespace {

constexpr size_t kSample = 8;

std::vector<cv::Point2f> pointsAt(const Eigen::MatrixXd& X, Eigen::Index frame) {
  std::vector<cv::Point2f> points;
  for (Eigen::Index i = 0; i < X.cols(); ++i)
    points.emplace_back(static_cast<float>(X(2 * frame, i)), static_cast<float>(X(2 * frame + 1, i)));
  return points;
}

std::vector<size_t> membersOf(const std::vector<int>& labels, int motion) {
  std::vector<size_t> members;
  for (size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == motion) members.push_back(i);
  }
  return members;
}

/// Distances [px] of the second points to the epipolar lines of the first under a fundamental matrix of
/// `sample`; std::nullopt if they do not fix one.
std::optional<Eigen::VectorXd> epipolarDistances(const std::vector<cv::Point2f>& first,
                                                 const std::vector<cv::Point2f>& second,
                                                 const std::vector<size_t>& sample) {
  std::vector<cv::Point2f> a, b;
  for (const size_t i : sample) {
    a.push_back(first[i]);
    b.push_back(second[i]);
  }
  const cv::Mat found = cv::findFundamentalMat(a, b, cv::FM_8POINT);
  if (found.rows != 3 || found.cols != 3) return std::nullopt;
  const cv::Matx33d F = found;
  Eigen::VectorXd distances(static_cast<Eigen::Index>(first.size()));
  for (size_t i = 0; i < first.size(); ++i) {
    const cv::Vec3d line = F * cv::Vec3d(first[i].x, first[i].y, 1);
    const double product = line.dot(cv::Vec3d(second[i].x, second[i].y, 1));
    distances(static_cast<Eigen::Index>(i)) =
        std::abs(product) / std::max(std::hypot(line[0], line[1]), 1e-12);
  }
  return distances;
}

}  // namespace

std::vector<int> randomizedVotingClusters(const Eigen::MatrixXd& X, int count,
                                          const RandomizedVotingParameters& parameters) {
  const auto n = static_cast<size_t>(X.cols());
  std::vector<int> labels(n, 0);
  const Eigen::Index frames = X.rows() / 2;
  if (n < kSample * static_cast<size_t>(count) || frames < 2) return labels;
  std::vector<std::vector<cv::Point2f>> points;
  for (Eigen::Index f = 0; f < frames; ++f) points.push_back(pointsAt(X, f));
  std::mt19937 random(parameters.seed);
  std::uniform_int_distribution<int> any_motion(0, count - 1);
  for (int& label : labels) label = any_motion(random);
  std::uniform_int_distribution<size_t> any_first(0, points.size() - 2);
  Eigen::MatrixXd votes = Eigen::MatrixXd::Zero(X.cols(), count);
  for (int round = 0; round < parameters.rounds; ++round) {
    const size_t first = any_first(random);
    const size_t second = std::uniform_int_distribution<size_t>(first + 1, points.size() - 1)(random);
    for (int motion = 0; motion < count; ++motion) {
      const std::vector<size_t> members = membersOf(labels, motion);
      if (members.size() < kSample) continue;
      std::vector<size_t> sample;
      std::sample(members.begin(), members.end(), std::back_inserter(sample), kSample, random);
      if (const auto distances = epipolarDistances(points[first], points[second], sample))
        votes.col(motion).array() += (-parameters.decay_per_px * distances->array()).exp();
    }
    for (size_t i = 0; i < n; ++i) {
      Eigen::Index best = 0;
      votes.row(static_cast<Eigen::Index>(i)).maxCoeff(&best);
      labels[i] = static_cast<int>(best);
    }
  }
  return labels;
}

}  // namespace redbee
