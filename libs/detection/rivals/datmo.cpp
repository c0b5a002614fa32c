#include "redbee/detection/rivals/datmo.hpp"

#include <algorithm>
#include <opencv2/core/eigen.hpp>

#include "redbee/detection/rivals/registration.hpp"

namespace redbee {
namespace {

constexpr double kThresholdPx = 1.0;  // 0.5 was no better
constexpr float kGatePx = 12;
constexpr int kMaxMissed = 3;

GridFlowParameters gridParameters() {
  GridFlowParameters parameters;
  parameters.grid_px = {10, 10};
  parameters.window_px = 13;
  parameters.min_eigenvalue = 1e-3;
  parameters.max_there_and_back_px = 0.5;
  return parameters;
}

cv::Point2f transferred(const cv::Matx33d& H, const cv::Point2f& point) {
  const cv::Vec3d p = H * cv::Vec3d(point.x, point.y, 1);
  return {static_cast<float>(p[0] / p[2]), static_cast<float>(p[1] / p[2])};
}

std::vector<MovingPoint> strayPoints(const GridTracks& tracks, const cv::Matx33d& H) {
  std::vector<MovingPoint> points;
  for (size_t i = 0; i < tracks.current.size(); ++i) {
    const cv::Point2f difference = tracks.current[i] - transferred(H, tracks.previous[i]);
    points.push_back(
        {tracks.current[i], difference, static_cast<float>(cv::norm(difference) / kThresholdPx)});
  }
  return points;
}

}  // namespace

GroupFilter::Track GroupFilter::begin(const cv::Point2f& centre) {
  Track track{cv::KalmanFilter(4, 2, 0, CV_32F)};
  cv::KalmanFilter& filter = track.filter;
  filter.transitionMatrix = (cv::Mat_<float>(4, 4) << 1, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1, 0, 0, 0, 0, 1);
  cv::setIdentity(filter.measurementMatrix);
  cv::setIdentity(filter.processNoiseCov, cv::Scalar(0.5));
  cv::setIdentity(filter.measurementNoiseCov, cv::Scalar(16));
  cv::setIdentity(filter.errorCovPost, cv::Scalar(16));
  filter.statePost = (cv::Mat_<float>(4, 1) << centre.x, centre.y, 0, 0);
  return track;
}

void GroupFilter::predict(Track& track, const cv::Matx33d& background) {
  cv::Mat& state = track.filter.statePost;
  const cv::Point2f warped = transferred(background, {state.at<float>(0), state.at<float>(1)});
  state.at<float>(0) = warped.x;
  state.at<float>(1) = warped.y;
  track.filter.predict();
  ++track.missed;
}

GroupFilter::Track* GroupFilter::nearest(const cv::Point2f& centre) {
  Track* best = nullptr;
  double best_distance = kGatePx;
  for (Track& track : tracks_) {
    const cv::Mat& state = track.filter.statePre;
    if (track.missed == 0 || state.empty()) continue;
    const double distance = cv::norm(centre - cv::Point2f(state.at<float>(0), state.at<float>(1)));
    if (distance >= best_distance) continue;
    best = &track;
    best_distance = distance;
  }
  return best;
}

std::vector<FlowCluster> GroupFilter::confirmedGroups(std::vector<FlowCluster> groups,
                                                      const cv::Matx33d& background) {
  for (Track& track : tracks_) predict(track, background);
  std::vector<FlowCluster> confirmed;
  std::vector<Track> begun;
  for (FlowCluster& group : groups) {
    Track* track = nearest(group.centre);
    if (track == nullptr) {
      begun.push_back(begin(group.centre));
      continue;
    }
    track->filter.correct((cv::Mat_<float>(2, 1) << group.centre.x, group.centre.y));
    track->missed = 0;
    if (++track->hits >= kConfirmFrames) confirmed.push_back(std::move(group));
  }
  const auto gone = [](const Track& track) { return track.missed > kMaxMissed; };
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(), gone), tracks_.end());
  std::move(begun.begin(), begun.end(), std::back_inserter(tracks_));
  return confirmed;
}

Datmo::Datmo(const ObjectParameters& objects)
    : Rival(objects), flow_(gridParameters()), filters_(kDecisionLevels) {}

void Datmo::reset() {
  flow_.reset();
  filters_.assign(kDecisionLevels, {});
}

RivalScore Datmo::scoreFrame(const FrameInput& input) {
  RivalScore scored;
  const bool first = !flow_.hasPrevious();
  const GridTracks tracks = flow_.advance(input.grey);
  if (first) return scored;
  std::optional<cv::Matx33d> H;
  if (input.motion) {
    cv::eigen2cv(planeHomography(input.cameras(), *input.motion), H.emplace());
  } else {
    H = registerTracks(tracks);
  }
  if (!H) {
    scored.status = DetectorStatus::kNoHomography;
    return scored;
  }
  scored.status = DetectorStatus::kGood;
  scored.background = *H;
  scored.score = paintClusters(input.grey.size(), strayPoints(tracks, *H), {},
                               [&](size_t level, std::vector<FlowCluster> groups) {
                                 return filters_[level].confirmedGroups(std::move(groups), *H);
                               });
  return scored;
}

}  // namespace redbee
