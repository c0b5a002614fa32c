// Inertial-optical flow: Meier, Brockers, Matthies, Siegwart, Weiss, "Detection and Characterization of
// Moving Objects with Aerial Vehicles Using Inertial-Optical Flow", IROS 2015.
//
// Points are tracked from frame to frame and their flow is compensated by the IMU's rotation. The rest must
// lie on the epipolar line of the direction of travel, have the right sign, and be no shorter than the
// ground's and no longer than the nearest surface's. Points that violate this are clustered by position and
// flow; each cluster is an object, its convex hull the mask. Score: hulls at increasing thresholds, see
// paintClusters().
//
// Without an IMU, rotation and direction come from the essential matrix of the points, and the bound by the
// ground is left out. Departures: the points lie on a grid; direction of travel and height are those of this
// project's inertial filter, which like theirs is corrected by vision. The thresholds are not published: the
// neighbours' distance, the direction's error and an average over a box at the end are tuned
// (EXPERIMENTS.md), with kDecisionScore where the mean F1 of the development clips is best.
#pragma once

#include "redbee/detection/rivals/grid_flow.hpp"
#include "redbee/detection/rivals/rival.hpp"

namespace redbee {

class Meier : public Rival {
 public:
  explicit Meier(const ObjectParameters& objects);
  DetectorNeeds needs() const override { return {false, true, 1}; }

 private:
  void reset() override { flow_.reset(); }
  RivalScore scoreFrame(const FrameInput& input) override;

  GridFlow flow_;
};

}  // namespace redbee
