#include "redbee/detection/rivals/trajectory_rival.hpp"

#include <algorithm>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <set>
#include <utility>

#include "redbee/detection/rivals/graded_score.hpp"
#include "redbee/detection/rivals/lrr.hpp"
#include "redbee/detection/rivals/randomized_voting.hpp"
#include "redbee/detection/rivals/registration.hpp"
#include "redbee/detection/rivals/ssc.hpp"
#include "redbee/geometry/decompositions.hpp"
#include "redbee/geometry/products.hpp"

namespace redbee {
namespace {

constexpr float kDistanceUnitPx = 1;
constexpr float kTrackingErrorPx = 0.6F;
constexpr int kMotions = 5;
constexpr TrajectoryRivalParameters kRvParameters{16, 0.15};
constexpr TrajectoryRivalParameters kLrrParameters{24, 0.2};
constexpr TrajectoryRivalParameters kSscParameters{24, 0.1};
constexpr double kReachPx = 16;  // bridges the places of lost tracks
constexpr int kAveragePx = 25;
constexpr float kDecisionFraction = 0.38F;
constexpr double kRegisteredPx =
    1;  // the image counts as registered if tracks are this close to the background's motions
constexpr Eigen::Index kAffineRank = 3;

cv::Mat1b fillFromNearest(cv::Size image, const Eigen::MatrixXd& X, const std::vector<uint8_t>& scores) {
  cv::Mat1b empty(image, 255);
  const auto pixelOf = [&](Eigen::Index i) {
    const Eigen::Vector2d p = X.col(i).tail<2>();
    return cv::Point(std::clamp(cvRound(p.x()), 0, image.width - 1),
                     std::clamp(cvRound(p.y()), 0, image.height - 1));
  };
  for (Eigen::Index i = 0; i < X.cols(); ++i) empty(pixelOf(i)) = 0;
  cv::Mat1f distance;
  cv::Mat1i cell;
  cv::distanceTransform(empty, distance, cell, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
  std::vector<uint8_t> score_of_cell(scores.size() + 1, 0);
  for (Eigen::Index i = 0; i < X.cols(); ++i)
    score_of_cell[static_cast<size_t>(cell(pixelOf(i)))] = scores[static_cast<size_t>(i)];
  cv::Mat1b map = cv::Mat1b::zeros(image);
  for (int y = 0; y < map.rows; ++y) {
    for (int x = 0; x < map.cols; ++x) {
      if (distance(y, x) <= kReachPx) map(y, x) = score_of_cell[static_cast<size_t>(cell(y, x))];
    }
  }
  return map;
}

/// Centred and scaled to a largest coordinate of 1, as input of the subspace methods.
Eigen::MatrixXd scaled(const Eigen::MatrixXd& X) {
  Eigen::MatrixXd Y = X;
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    auto rows = Y(Eigen::seq(axis, Eigen::last, 2), Eigen::all);
    const double mean = rows.mean();
    rows.array() -= mean;
  }
  return Y / std::max(Y.cwiseAbs().maxCoeff(), 1.0);
}

GridTracks lastStepOfBackground(const Eigen::MatrixXd& X, const Eigen::VectorXd& distance) {
  GridTracks tracks;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    if (distance(i) > kRegisteredPx) continue;
    const Eigen::Vector4f last = X.col(i).tail<4>().cast<float>();
    tracks.previous.emplace_back(last(0), last(1));
    tracks.current.emplace_back(last(2), last(3));
  }
  tracks.sampled = tracks.current.size();
  return tracks;
}

}  // namespace

std::vector<int> backgroundLabels(const std::vector<int>& labels, int count, double least_fraction) {
  std::vector<long> members;
  members.reserve(static_cast<size_t>(count));
  for (int label = 0; label < count; ++label)
    members.push_back(std::count(labels.begin(), labels.end(), label));
  const long largest = *std::max_element(members.begin(), members.end());
  const double enough =
      std::min(least_fraction * static_cast<double>(labels.size()), static_cast<double>(largest));
  std::vector<int> background;
  for (int label = 0; label < count; ++label) {
    if (static_cast<double>(members[static_cast<size_t>(label)]) >= enough) background.push_back(label);
  }
  return background;
}

Eigen::VectorXd distanceFromAffineMotion(const Eigen::MatrixXd& tracks, const Eigen::MatrixXd& X,
                                         const std::vector<bool>& of) {
  const auto members = std::count(of.begin(), of.end(), true);
  if (members <= kAffineRank)
    return Eigen::VectorXd::Constant(tracks.cols(), std::numeric_limits<double>::infinity());
  Eigen::MatrixXd own(X.rows(), members);
  Eigen::Index column = 0;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    if (of[static_cast<size_t>(i)]) own.col(column++) = X.col(i);
  }
  const Eigen::VectorXd mean = own.rowwise().mean();
  own.colwise() -= mean;
  const Eigen::MatrixXd basis = leftThinSvd(productTransposed(own, own)).U.leftCols(kAffineRank);
  const Eigen::MatrixXd centred = tracks.colwise() - mean;
  const Eigen::MatrixXd off = centred - product(basis, transposedProduct(basis, centred));
  return (off.colwise().squaredNorm().transpose() * 2.0 / static_cast<double>(X.rows())).cwiseSqrt();
}

Eigen::VectorXd distanceFromBackground(const Eigen::MatrixXd& tracks, const Eigen::MatrixXd& X,
                                       const std::vector<int>& labels, const std::vector<int>& background) {
  Eigen::VectorXd least = Eigen::VectorXd::Constant(tracks.cols(), std::numeric_limits<double>::infinity());
  for (const int still : background) {
    std::vector<bool> of;
    of.reserve(labels.size());
    for (const int label : labels) of.push_back(label == still);
    least = least.cwiseMin(distanceFromAffineMotion(tracks, X, of));
  }
  return least;
}

Eigen::MatrixXd thinned(const Eigen::MatrixXd& X, int cell_px) {
  std::set<std::pair<int, int>> taken;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < X.cols(); ++i) {
    const Eigen::Vector2d end = X.col(i).tail<2>() / cell_px;
    if (taken.emplace(cvFloor(end.x()), cvFloor(end.y())).second) kept.push_back(i);
  }
  return X(Eigen::all, kept);
}

TrajectoryRival::TrajectoryRival(const ObjectParameters& objects, TrajectoryClustering clustering,
                                 const TrajectoryRivalParameters& parameters)
    : Rival(objects),
      clustering_(std::move(clustering)),
      parameters_(parameters),
      window_(TrajectoryWindowParameters{}) {}

RivalScore TrajectoryRival::scoreFrame(const FrameInput& input) {
  RivalScore scored;
  if (!window_.advance(input.grey)) {
    scored.status = DetectorStatus::kNoHomography;
    return scored;
  }
  const Eigen::MatrixXd tracks = window_.trajectories();
  if (tracks.cols() == 0) return scored;
  const Eigen::MatrixXd X = thinned(tracks, parameters_.clustered_px);
  if (X.cols() < 4 * kMotions) return scored;
  const std::vector<int> labels = clustering_(X, kMotions);
  const Eigen::VectorXd distance = distanceFromBackground(
      tracks, X, labels, backgroundLabels(labels, kMotions, parameters_.background_fraction));
  std::vector<uint8_t> scores;
  for (const double px : distance)
    scores.push_back(gradedScore((static_cast<float>(px) - kTrackingErrorPx) / kDistanceUnitPx));
  scored.status = DetectorStatus::kGood;
  scored.score =
      averagedScore(fillFromNearest(input.grey.size(), tracks, scores), kAveragePx, kDecisionFraction);
  scored.background = registerTracks(lastStepOfBackground(tracks, distance)).value_or(cv::Matx33d::eye());
  return scored;
}

RandomizedVoting::RandomizedVoting(const ObjectParameters& objects)
    : TrajectoryRival(
          objects, [](const Eigen::MatrixXd& X, int count) { return randomizedVotingClusters(X, count); },
          kRvParameters) {}

Lrr::Lrr(const ObjectParameters& objects)
    : TrajectoryRival(
          objects, [](const Eigen::MatrixXd& X, int count) { return lrrClusters(scaled(X), count); },
          kLrrParameters) {}

Ssc::Ssc(const ObjectParameters& objects)
    : TrajectoryRival(
          objects, [](const Eigen::MatrixXd& X, int count) { return sscClusters(scaled(X), count); },
          kSscParameters) {}

}  // namespace redbee
