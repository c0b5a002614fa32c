#include "rivals/trajectory_rival.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "rivals/graded_score.hpp"
#include "rivals/lrr.hpp"
#include "rivals/randomized_voting.hpp"
#include "rivals/registration.hpp"
#include "rivals/ssc.hpp"

namespace redbee {
namespace {

constexpr float kDistanceUnitPx = 1;
constexpr int kRvMotions = 5;
constexpr int kLrrMotions = 3;
constexpr int kSscMotions = 5;
constexpr double kSameMotionPx = 1;
constexpr double kSpreadShare = 0.5;
// Of the tracks' spacing: tracks are lost, and where they were must not go without a score.
constexpr double kReach = 2;
constexpr Eigen::Index kAffineRank = 3;

/// Standard deviations of x and of y over the points of the last frame that carry this label; any for -1.
Eigen::Vector2d spread(const Eigen::MatrixXd& X, const std::vector<int>& labels, int label) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Vector2d squares = Eigen::Vector2d::Zero();
  int count = 0;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    if (label >= 0 && labels[static_cast<size_t>(i)] != label) continue;
    const Eigen::Vector2d point = X.col(i).tail<2>();
    sum += point;
    squares += point.cwiseAbs2();
    ++count;
  }
  if (count == 0) return Eigen::Vector2d::Zero();
  const Eigen::Vector2d mean = sum / count;
  return (squares / count - mean.cwiseAbs2()).cwiseMax(0).cwiseSqrt();
}

cv::Mat fillFromNearest(cv::Size picture, const std::vector<cv::Point2f>& points,
                        const std::vector<uint8_t>& scores, double reach_px) {
  cv::Mat empty(picture, CV_8U, cv::Scalar(255));
  const auto pixelOf = [&](const cv::Point2f& p) {
    return cv::Point(std::clamp(cvRound(p.x), 0, picture.width - 1),
                     std::clamp(cvRound(p.y), 0, picture.height - 1));
  };
  for (const cv::Point2f& point : points) empty.at<uint8_t>(pixelOf(point)) = 0;
  cv::Mat distance, cell;
  cv::distanceTransform(empty, distance, cell, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
  std::vector<uint8_t> score_of_cell(points.size() + 1, 0);
  for (size_t i = 0; i < points.size(); ++i)
    score_of_cell[static_cast<size_t>(cell.at<int>(pixelOf(points[i])))] = scores[i];
  cv::Mat map = cv::Mat::zeros(picture, CV_8U);
  for (int y = 0; y < map.rows; ++y) {
    for (int x = 0; x < map.cols; ++x) {
      if (distance.at<float>(y, x) <= reach_px)
        map.at<uint8_t>(y, x) = score_of_cell[static_cast<size_t>(cell.at<int>(y, x))];
    }
  }
  return map;
}

/// About the points' centre, the largest coordinate 1: what the subspace methods are fed with.
Eigen::MatrixXd scaled(const Eigen::MatrixXd& X) {
  Eigen::MatrixXd Y = X;
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    auto rows = Y(Eigen::seq(axis, Eigen::last, 2), Eigen::all);
    const double mean = rows.mean();
    rows.array() -= mean;
  }
  return Y / std::max(Y.cwiseAbs().maxCoeff(), 1.0);
}

GridTracks lastStep(const Eigen::MatrixXd& X, const std::vector<bool>& of) {
  GridTracks tracks;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    if (!of[static_cast<size_t>(i)]) continue;
    const Eigen::Vector4f last = X.col(i).tail<4>().cast<float>();
    tracks.previous.emplace_back(last(0), last(1));
    tracks.current.emplace_back(last(2), last(3));
  }
  tracks.sampled = tracks.current.size();
  return tracks;
}

}  // namespace

int backgroundLabel(const Eigen::MatrixXd& X, const std::vector<int>& labels, int count) {
  const Eigen::Vector2d whole = spread(X, labels, -1);
  int best = 0;
  std::pair<bool, long> best_rank{false, -1};
  for (int label = 0; label < count; ++label) {
    const bool wide = (spread(X, labels, label).array() >= kSpreadShare * whole.array()).all();
    const std::pair<bool, long> rank{wide, std::count(labels.begin(), labels.end(), label)};
    if (rank <= best_rank) continue;
    best = label;
    best_rank = rank;
  }
  return best;
}

std::vector<bool> backgroundTracks(const Eigen::MatrixXd& X, const std::vector<int>& labels, int count) {
  const int background = backgroundLabel(X, labels, count);
  std::vector<bool> still;
  for (const int label : labels) still.push_back(label == background);
  const Eigen::VectorXd distance = distanceFromAffineMotion(X, still);
  for (int label = 0; label < count; ++label) {
    std::vector<double> own;
    for (size_t i = 0; i < labels.size(); ++i) {
      if (labels[i] == label) own.push_back(distance(static_cast<Eigen::Index>(i)));
    }
    if (own.empty() || label == background) continue;
    const auto middle = own.begin() + static_cast<std::ptrdiff_t>(own.size() / 2);
    std::nth_element(own.begin(), middle, own.end());
    for (size_t i = 0; i < labels.size(); ++i)
      still[i] = still[i] || (labels[i] == label && *middle < kSameMotionPx);
  }
  return still;
}

Eigen::VectorXd distanceFromAffineMotion(const Eigen::MatrixXd& X, const std::vector<bool>& of) {
  const auto members = std::count(of.begin(), of.end(), true);
  if (members <= kAffineRank) return Eigen::VectorXd::Zero(X.cols());
  Eigen::MatrixXd own(X.rows(), members);
  Eigen::Index column = 0;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    if (of[static_cast<size_t>(i)]) own.col(column++) = X.col(i);
  }
  const Eigen::VectorXd mean = own.rowwise().mean();
  own.colwise() -= mean;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(own * own.transpose(), Eigen::ComputeThinU);
  const Eigen::MatrixXd basis = svd.matrixU().leftCols(kAffineRank);
  const Eigen::MatrixXd centred = X.colwise() - mean;
  const Eigen::MatrixXd off = centred - basis * (basis.transpose() * centred);
  return (off.colwise().squaredNorm().transpose() * 2.0 / static_cast<double>(X.rows())).cwiseSqrt();
}

TrajectoryRival::TrajectoryRival(TrajectoryClustering clustering, int motions,
                                 const TrajectoryWindowParameters& parameters)
    : clustering_(std::move(clustering)), motions_(motions), window_(parameters) {}

RivalOutput TrajectoryRival::judge(const RivalInput& input) {
  RivalOutput output;
  if (!window_.advance(input.grey)) {
    output.status = RivalStatus::kLost;
    return output;
  }
  const Eigen::MatrixXd X = window_.trajectories();
  if (X.cols() < 4 * motions_) return output;
  const std::vector<int> labels = clustering_(X, motions_);
  const std::vector<bool> still = backgroundTracks(X, labels, motions_);
  const Eigen::VectorXd distance = distanceFromAffineMotion(X, still);
  std::vector<cv::Point2f> points;
  std::vector<uint8_t> scores;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    const uint8_t half = gradedScore(static_cast<float>(distance(i)) / kDistanceUnitPx) / 2;
    points.emplace_back(static_cast<float>(X(X.rows() - 2, i)), static_cast<float>(X(X.rows() - 1, i)));
    scores.push_back(static_cast<uint8_t>(still[static_cast<size_t>(i)] ? half : kDecisionScore + half));
  }
  output.status = RivalStatus::kGood;
  output.score = fillFromNearest(input.grey.size(), points, scores, kReach * window_.parameters().grid_px);
  output.background = registerTracks(lastStep(X, still)).value_or(cv::Matx33d::eye());
  return output;
}

std::unique_ptr<Rival> makeRandomizedVoting() {
  const auto clustering = [](const Eigen::MatrixXd& X, int count) {
    return randomizedVotingClusters(X, count);
  };
  return std::make_unique<TrajectoryRival>(clustering, kRvMotions, TrajectoryWindowParameters{});
}

std::unique_ptr<Rival> makeLrr() {
  const auto clustering = [](const Eigen::MatrixXd& X, int count) { return lrrClusters(scaled(X), count); };
  return std::make_unique<TrajectoryRival>(clustering, kLrrMotions, TrajectoryWindowParameters{});
}

std::unique_ptr<Rival> makeSsc() {
  const auto clustering = [](const Eigen::MatrixXd& X, int count) { return sscClusters(scaled(X), count); };
  // Its N x N iterations allow for fewer tracks than the others'.
  TrajectoryWindowParameters parameters;
  parameters.grid_px = 24;
  return std::make_unique<TrajectoryRival>(clustering, kSscMotions, parameters);
}

}  // namespace redbee
