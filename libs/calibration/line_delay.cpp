#include "redbee/calibration/line_delay.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "redbee/calibration/joint_problem.hpp"
#include "redbee/geometry/rolling_shutter.hpp"
#include "redbee/visual/homography_fit.hpp"
#include "redbee/visual/ransac.hpp"

namespace redbee::calibration {
namespace {

constexpr double kUnit_s = 1e-6;        // of the delay, while it is estimated
constexpr double kHalfWindow_s = 0.01;  // over which the rotation rate changes evenly

using Vector9d = Eigen::Matrix<double, 9, 1>;
using Matrix9d = Eigen::Matrix<double, 9, 9>;
using Design = Eigen::Matrix<double, 2, 9>;

RowMotion rowMotionAt(const JointState& state, const ImuHistory& imu, size_t index) {
  const FrameState& frame = state.frames[index];
  const double t_s = frame.t_cam_s + state.timeshift_s;
  const Eigen::Vector3d bias = state.biases[state.biasIndex(frame.t_cam_s)].gyro;
  const Eigen::Vector3d before = imu.meanRate(t_s - kHalfWindow_s, t_s) - bias;
  const Eigen::Vector3d after = imu.meanRate(t_s, t_s + kHalfWindow_s) - bias;
  const Eigen::Vector3d rate_I = 0.5 * (before + after);
  RowMotion motion;
  motion.rate = state.q_CI * rate_I;
  motion.acceleration = state.q_CI * Eigen::Vector3d((after - before) / kHalfWindow_s);
  motion.velocity = state.q_CI *
                    Eigen::Vector3d(frame.q_GI.conjugate() * frame.v_GI + rate_I.cross(state.p_IC)) /
                    cameraHeight(state, index);
  motion.normal = -(state.q_CI * (frame.q_GI.conjugate() * state.groundNormal()));
  return motion;
}

/// A point of the ideal image, moved to the middle row's time.
class RowMover {
 public:
  RowMover(const Camera& camera, double delay_s) : camera_(delayed(camera, delay_s)) {}

  Eigen::Vector2d moved(const cv::Point2f& ideal, const RowMotion& motion) const {
    const Eigen::Vector2d point(ideal.x, ideal.y);
    const auto raw = camera_.distort(point);
    return raw ? idealPixel(camera_, *raw, motion).value_or(point) : point;
  }

 private:
  static Camera delayed(const Camera& camera, double delay_s) {
    CameraIntrinsics intrinsics = camera.intrinsics();
    intrinsics.line_delay_s = delay_s;
    return Camera(intrinsics, camera.ideal());
  }
  Camera camera_;
};

/// What one match says: information about the delay, and that times its estimate.
struct Evidence {
  double information = 0;
  double weighted = 0;
};

Evidence evidenceOf(const PointTracks& points, const Eigen::Matrix3d& H_px, const Camera& camera,
                    const RowMotion& motion_a, const RowMotion& motion_b) {
  constexpr int kRounds = 5;
  constexpr double kScale_px = 0.5;  // of the robust loss (Geman and McClure)
  constexpr double kFloor_px = 0.03;
  const ImageScaling scaling(camera.ideal().width, camera.ideal().height);
  const ScaledPairs pairs(points, scaling);
  const RowMover mover(camera, kUnit_s);
  Eigen::Matrix3d H = scaling.scale(H_px);
  const auto slopeOf = [&](size_t i) -> Eigen::Vector2d {
    const auto shift = [&](const cv::Point2f& p, const RowMotion& motion) -> Eigen::Vector2d {
      return (mover.moved(p, motion) - Eigen::Vector2d(p.x, p.y)) / scaling.unit_px;
    };
    const Eigen::Vector2d a = pairs.previous(i);
    return transfer(H, a + shift(points.previous[i], motion_a)) - transfer(H, a) -
           shift(points.current[i], motion_b);
  };
  const double scale = kScale_px / scaling.unit_px;
  Vector9d solution = Vector9d::Zero();
  Matrix9d A;
  double variance = 0;
  for (int round = 0; round < kRounds; ++round) {
    A = 1e-9 * Matrix9d::Identity();
    Vector9d b = Vector9d::Zero();
    double squares = 0, count = 0;
    for (size_t i = 0; i < pairs.size(); ++i) {
      Design J;
      J << transferJacobian(H, pairs.previous(i)), slopeOf(i);
      const Eigen::Vector2d residual = pairs.current(i) - transfer(H, pairs.previous(i));
      const double left = (residual - J.col(8) * solution(8)).squaredNorm();
      const double root = 1 / (1 + left / (scale * scale));
      A += root * root * J.transpose() * J;
      b += root * root * J.transpose() * residual;
      squares += root * root * left;
      count += 2 * root * root;
    }
    solution = A.ldlt().solve(b);
    H = fromVector(toVector(H) + solution.head<8>());
    const double floor = kFloor_px / scaling.unit_px;
    variance = std::max(squares / std::max(count - 9, 1.0), floor * floor);
  }
  if (!solution.allFinite() || !H.allFinite()) return {};
  const Eigen::Matrix<double, 8, 1> cross = A.topRightCorner<8, 1>();
  const double information = (A(8, 8) - cross.dot(A.topLeftCorner<8, 8>().ldlt().solve(cross))) / variance;
  if (!(information > 0)) return {};
  return {information, information * solution(8)};
}

}  // namespace

LineDelay estimateLineDelay(const Recording& recording, const JointState& state) {
  std::map<std::pair<size_t, size_t>, Eigen::Matrix3d> ground;
  for (const GroundHomography& g : recording.ground) ground[{g.a, g.b}] = g.H;
  std::vector<Evidence> all;
  Evidence sum;
  for (const IndexedMatch& match : recording.matches) {
    const auto H = ground.find({match.a, match.b});
    if (H == ground.end()) continue;
    all.push_back(evidenceOf(*match.points, H->second, *recording.camera,
                             rowMotionAt(state, *recording.imu, match.a),
                             rowMotionAt(state, *recording.imu, match.b)));
    sum.information += all.back().information;
    sum.weighted += all.back().weighted;
  }
  if (!(sum.information > 0)) return {0, std::numeric_limits<double>::infinity()};
  const double delay = sum.weighted / sum.information;
  double scatter = 0;
  for (const Evidence& e : all) scatter += std::pow(e.weighted - e.information * delay, 2);
  constexpr double kMatchesOfAFrame = 2;  // whose errors are correlated
  const double by_points = kCorrelationInflation / sum.information;
  const double by_matches = kMatchesOfAFrame * scatter / (sum.information * sum.information);
  return {kUnit_s * delay, kUnit_s * std::sqrt(std::max(by_points, by_matches))};
}

std::vector<GroundMatch> withoutLineDelay(const CalibrationInput& input, const Recording& recording,
                                          const JointState& state, double delay_s) {
  std::vector<GroundMatch> moved = input.ground;
  const RowMover mover(*recording.camera, delay_s);
  for (const IndexedMatch& match : recording.matches) {
    const auto given = std::find_if(input.ground.begin(), input.ground.end(),
                                    [&](const GroundMatch& g) { return &g.points == match.points; });
    if (given == input.ground.end()) continue;
    PointTracks& points = moved[static_cast<size_t>(given - input.ground.begin())].points;
    const auto move = [&](std::vector<cv::Point2f>& of, size_t frame) {
      const RowMotion motion = rowMotionAt(state, *recording.imu, frame);
      for (cv::Point2f& point : of) {
        const Eigen::Vector2d place = mover.moved(point, motion);
        point = {static_cast<float>(place.x()), static_cast<float>(place.y())};
      }
    };
    move(points.previous, match.a);
    move(points.current, match.b);
  }
  return moved;
}

}  // namespace redbee::calibration
