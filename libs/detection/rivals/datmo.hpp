// DATMO from an aircraft: Rodriguez-Canosa, Thomas, del Cerro, Barrientos, MacDonald, "A Real-Time Method to
// Detect and Track Moving Objects (DATMO) from Unmanned Aerial Vehicles (UAVs) Using a Single Camera", Remote
// Sensing 2012.
//
// The flow that the camera's motion would give a static ground ("artificial flow") is compared with the flow
// measured; differences above a threshold are grouped, and groups are tracked by a filter, which also
// separates persistent ones from noise. Score: kDecisionScore where groups appear at the threshold below, see
// paintClusters().
//
// The camera's motion is the IMU's here (theirs is parallel tracking and mapping's); without an IMU it is the
// homography of the points. The filter is a constant-velocity Kalman filter of each group's centre. The
// thresholds are not published; confirmation, neighbourhood and minimum number of points were tuned
// (EXPERIMENTS.md).
#pragma once

#include <opencv2/video/tracking.hpp>
#include <vector>

#include "redbee/detection/rivals/flow_clusters.hpp"
#include "redbee/detection/rivals/grid_flow.hpp"
#include "redbee/detection/rivals/rival.hpp"

namespace redbee {

/// Tracks the groups of one decision level.
class GroupFilter {
 public:
  static constexpr int kConfirmFrames = 2;

  /// The groups of this frame that have been tracked for kConfirmFrames frames. `background`: previous to
  /// current.
  std::vector<FlowCluster> confirmedGroups(std::vector<FlowCluster> groups, const cv::Matx33d& background);

 private:
  struct Track {
    cv::KalmanFilter filter;  ///< x, y [px], and velocity relative to the background [px per frame]
    int hits = 1;
    int missed = 0;
  };
  static Track begin(const cv::Point2f& centre);
  static void predict(Track& track, const cv::Matx33d& background);
  Track* nearest(const cv::Point2f& centre);

  std::vector<Track> tracks_;
};

class Datmo : public Rival {
 public:
  explicit Datmo(const ObjectParameters& objects);
  DetectorNeeds needs() const override { return {false, true, 1}; }

 private:
  void reset() override;
  RivalScore scoreFrame(const FrameInput& input) override;

  GridFlow flow_;
  std::vector<GroupFilter> filters_;  ///< one for each decision level
};

}  // namespace redbee
