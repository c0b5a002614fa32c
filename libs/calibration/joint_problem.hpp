// The joint least-squares problem (Ceres): states of all frames, biases, mounting, time shift, ground or
// target.
#pragma once

#include <ceres/problem.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "redbee/calibration/imu_history.hpp"
#include "redbee/calibration/joint_state.hpp"
#include "redbee/calibration/target_pose_cost.hpp"
#include "redbee/geometry/camera.hpp"
#include "redbee/geometry/homography.hpp"

namespace redbee::calibration {

/// Homography of the ground from frame a to frame b (indices), measured by vision.
struct GroundHomography {
  size_t a = 0;
  size_t b = 0;
  Eigen::Matrix3d H;                        ///< ideal pixels, h33 = 1
  Matrix8d information = Matrix8d::Zero();  ///< of the scaled entries
  int points = 0;
  double rms_px = 0;  ///< of the points' transfer errors
};

/// Pose of a known target in one frame.
struct TargetPose {
  size_t frame = 0;
  Eigen::Quaterniond q_CT = Eigen::Quaterniond::Identity();
  Eigen::Vector3d p_CT = Eigen::Vector3d::Zero();  ///< m
  Matrix6d information = Matrix6d::Zero();         ///< of (left perturbation of R_CT [rad], p_CT [m])
  double rms_px = 0;                               ///< of the corners
};

/// Height of the camera above the ground.
struct HeightObservation {
  double t_imu_s = 0;
  double height_m = 0;
  double sigma_m = 0;
};

/// Standard deviations of the priors.
struct JointPriors {
  Eigen::Quaterniond q_CI = Eigen::Quaterniond::Identity();
  double rotation_sigma_rad = 0.1;
  Eigen::Vector3d p_IC = Eigen::Vector3d::Zero();
  double p_IC_sigma_m = 0.05;
  double timeshift_s = 0;
  double timeshift_sigma_s = 0.03;
  double gyro_bias_sigma = 0.01;   ///< rad/s
  double accel_bias_sigma = 0.15;  ///< m/s^2
  double tilt_sigma_rad = 0.05;
  double height_m = 2;  ///< of the first frame's camera; starting value
  double height_sigma_m = 2;
};

struct JointInput {
  const ImuHistory* imu = nullptr;
  const Camera* camera = nullptr;
  ImuNoise noise;
  double gravity = 9.81;  ///< m/s^2
  std::vector<GroundHomography> ground;
  std::vector<TargetPose> target;  ///< either this or `ground` is empty
  std::vector<HeightObservation> heights;
  JointPriors priors;
  double vision_variance_scale = 1;  ///< the measured information matrices are divided by this
  double imu_variance_scale = 1;     ///< the preintegrations' covariances are multiplied by this
};

/// How well one group of measurements fits.
struct GroupFit {
  double chi2 = 0;          ///< sum of squared whitened residuals
  double median_ratio = 0;  ///< median chi2 of one measurement over the median of its chi-square distribution
  double redundancy = 0;    ///< degrees of freedom remaining for the group after the fit
  int measurements = 0;
};

/// Covariances in the tangent space and of derived quantities.
struct JointCovariance {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();    ///< rad^2, of R_CI, left perturbation (axes of C)
  Eigen::Matrix3d p_IC = Eigen::Matrix3d::Zero();        ///< m^2
  double timeshift = 0;                                  ///< s^2
  Eigen::Matrix2d tilt = Eigen::Matrix2d::Zero();        ///< rad^2, about G's x and y up to their order
  Eigen::Matrix3d gyro_bias = Eigen::Matrix3d::Zero();   ///< of the first stretch
  Eigen::Matrix3d accel_bias = Eigen::Matrix3d::Zero();  ///< of the first stretch
  double first_height = 0;                               ///< m^2, camera at the first frame
  double last_height = 0;                                ///< m^2, camera at the last frame

  JointCovariance scaled(double factor) const;
};

struct JointAnalysis {
  bool valid = false;  ///< false: the information matrix is singular
  JointCovariance covariance;
  GroupFit vision;
  GroupFit imu;
};

class JointProblem {
 public:
  /// Estimates `state` in place; the IMU is linearised at its biases and timeshift_s. Both arguments must
  /// outlive this object.
  JointProblem(const JointInput& input, JointState& state);

  /// False if Ceres found no usable solution.
  bool solve();
  /// At the current state. Robust losses count as weights.
  JointAnalysis analyse();
  /// Squared whitened residual of every homography or target pose, in the input's order.
  std::vector<double> visionChi2();
  const std::string& report() const { return report_; }

 private:
  void addFrames();
  void addImu();
  void addGround();
  void addTarget();
  void addHeights();
  void addPriors();
  Eigen::Vector3d rateAt(const FrameState& frame) const;
  std::vector<double*> orderedParameters();
  void fillGroup(GroupFit& group, const std::vector<ceres::ResidualBlockId>& blocks, int size, double median);

  const JointInput& input_;
  JointState& state_;
  ceres::Problem problem_;
  std::vector<ceres::ResidualBlockId> vision_;
  std::vector<ceres::ResidualBlockId> imu_;
  std::vector<ceres::ResidualBlockId> others_;
  std::string report_;
};

/// Camera height above the ground at a frame's exposure [m].
double cameraHeight(const JointState& state, size_t frame);
/// Adds the time shift's step to the states and sets it to zero, so that the IMU can be preintegrated again.
void absorbTimeshiftStep(JointState& state, const JointInput& input);
/// Motion of the camera over the ground between two frames that a state predicts.
PlaneMotion predictedMotion(const JointState& state, size_t a, size_t b);
/// Its homography, ideal pixels, h33 = 1.
Eigen::Matrix3d predictedHomography(const JointState& state, const JointInput& input, size_t a, size_t b);

}  // namespace redbee::calibration
