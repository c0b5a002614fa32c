#include "redbee/calibration/recording.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <map>

#include "redbee/calibration/target_pose.hpp"
#include "redbee/geometry/so3.hpp"

namespace redbee::calibration {
namespace {

constexpr double kMaxImuGap_s = 0.1;
/// Possible change of the time shift, and half the window of the angular rate at an exposure.
constexpr double kMargin_s = 0.05;
constexpr size_t kMinFrames = 48;
constexpr size_t kMinMeasurements = 30;

std::vector<CameraTime> sortedUnique(std::vector<CameraTime> times) {
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

/// Longest run of frames that the IMU covers without a gap, as [begin, end).
std::pair<size_t, size_t> coveredRun(const std::vector<double>& t, const ImuHistory& imu, double shift_s) {
  std::pair<size_t, size_t> best{0, 0};
  size_t begin = 0;
  for (size_t k = 0; k < t.size(); ++k) {
    const double from = (k > begin ? t[k - 1] : t[k]) + shift_s - kMargin_s;
    const bool covered = imu.covers(from, t[k] + shift_s + kMargin_s, kMaxImuGap_s);
    if (!covered) {
      // The frame may start a new run.
      const bool alone = imu.covers(t[k] + shift_s - kMargin_s, t[k] + shift_s + kMargin_s, kMaxImuGap_s);
      begin = alone ? k : k + 1;
      continue;
    }
    if (k + 1 - begin > best.second - best.first) best = {begin, k + 1};
  }
  return best;
}

std::vector<HeightObservation> heightsOf(const std::vector<AltitudeSample>& altimeter, ImuTime origin) {
  std::vector<HeightObservation> heights;
  for (const AltitudeSample& sample : altimeter) {
    if (!(sample.sigma_m > 0) || !(sample.height_m > 0)) continue;
    heights.push_back({seconds(sample.time - origin), sample.height_m, sample.sigma_m});
  }
  return heights;
}

/// The plane with most points; the joint solution finds the ground again (ground_fit.hpp).
std::optional<GroundHomography> firstHomography(const IndexedMatch& match, const CameraIntrinsics& ideal,
                                                const RansacParameters& ransac) {
  const auto estimate = estimateHomography(*match.points, ideal.width, ideal.height, ransac);
  if (!estimate) return std::nullopt;
  GroundHomography ground{match.a,           match.b,         estimate->H, estimate->covariance.inverse(),
                          estimate->inliers, estimate->rms_px};
  ground.information = 0.5 * (ground.information + ground.information.transpose()).eval();
  if (!ground.information.allFinite()) return std::nullopt;
  return ground;
}

void addGround(Recording& recording, const CalibrationInput& input,
               const std::map<CameraTime, size_t>& index) {
  for (const GroundMatch& match : input.ground) {
    const auto a = index.find(match.time_a);
    const auto b = index.find(match.time_b);
    if (a == index.end() || b == index.end() || a->second >= b->second) continue;
    recording.matches.push_back({a->second, b->second, &match.points});
    auto ground = firstHomography(recording.matches.back(), recording.camera->ideal(), input.ransac);
    if (ground) recording.ground.push_back(*ground);
  }
}

void addTarget(Recording& recording, const CalibrationInput& input,
               const std::map<CameraTime, size_t>& index) {
  for (const TargetView& view : input.target) {
    const auto frame = index.find(view.time);
    if (frame == index.end()) continue;
    auto pose = estimateTargetPose(*recording.camera, view);
    if (!pose) continue;
    pose->frame = frame->second;
    recording.target.push_back(*pose);
  }
}

void requireEnough(const Recording& recording, const CalibrationInput& input, size_t measured) {
  const std::string kind = input.target.empty() ? "ground homographies" : "views of the target";
  if (measured >= kMinMeasurements) return;
  throw CalibrationError("only " + std::to_string(measured) + " " + kind + " in " +
                         std::to_string(recording.t_cam_s.size()) + " frames, " +
                         std::to_string(kMinMeasurements) +
                         " are needed: too little texture, or no flat ground in view");
}

/// The longest run of frames that the IMU covers.
struct CoveredFrames {
  std::vector<CameraTime> frames;
  std::vector<double> t_s;  ///< since the first frame of the input
  ImuTime imu_origin;       ///< the first frame's time; the time shift is an unknown of the problem
  std::shared_ptr<const ImuHistory> imu;
};

CoveredFrames coveredFrames(const CalibrationInput& input) {
  const std::vector<CameraTime> frames = sortedUnique(input.frames);
  if (frames.empty()) throw CalibrationError("there are no frames");
  CoveredFrames covered;
  covered.imu_origin = ImuTime(frames.front().time_since_epoch());
  covered.imu = std::make_shared<ImuHistory>(input.imu, covered.imu_origin);
  if (covered.imu->size() < 2) throw CalibrationError("there are no IMU samples");

  std::vector<double> t;
  t.reserve(frames.size());
  for (const CameraTime frame : frames) t.push_back(seconds(frame - frames.front()));
  const auto [begin, end] = coveredRun(t, *covered.imu, input.nominal.timeshift_s);
  if (end - begin < kMinFrames) {
    throw CalibrationError("the IMU covers only " + std::to_string(end - begin) + " of " +
                           std::to_string(t.size()) + " frames without a gap; " + std::to_string(kMinFrames) +
                           " are needed");
  }
  covered.frames = {frames.begin() + static_cast<ptrdiff_t>(begin),
                    frames.begin() + static_cast<ptrdiff_t>(end)};
  covered.t_s = {t.begin() + static_cast<ptrdiff_t>(begin), t.begin() + static_cast<ptrdiff_t>(end)};
  return covered;
}

}  // namespace

void requireCoverage(const CalibrationInput& input) { coveredFrames(input); }

Recording prepareRecording(const CalibrationInput& input) {
  CoveredFrames covered = coveredFrames(input);
  Recording recording;
  recording.camera = std::make_shared<Camera>(input.camera);
  recording.imu = std::move(covered.imu);
  recording.t_cam_s = std::move(covered.t_s);
  std::map<CameraTime, size_t> index;
  for (size_t k = 0; k < covered.frames.size(); ++k) index[covered.frames[k]] = k;

  if (input.target.empty()) {
    addGround(recording, input, index);
    recording.heights = heightsOf(input.altimeter, covered.imu_origin);
    requireEnough(recording, input, recording.ground.size());
  } else {
    addTarget(recording, input, index);
    requireEnough(recording, input, recording.target.size());
  }
  return recording;
}

Recording partOf(const Recording& whole, size_t begin, size_t end) {
  Recording part;
  part.imu = whole.imu;
  part.camera = whole.camera;
  part.heights = whole.heights;
  part.t_cam_s.assign(whole.t_cam_s.begin() + static_cast<ptrdiff_t>(begin),
                      whole.t_cam_s.begin() + static_cast<ptrdiff_t>(end));
  const auto addInside = [begin = begin, end = end](const auto& from, auto& to) {
    for (auto element : from) {
      if (element.a < begin || element.b >= end) continue;
      element.a -= begin;
      element.b -= begin;
      to.push_back(element);
    }
  };
  addInside(whole.matches, part.matches);
  addInside(whole.ground, part.ground);
  for (TargetPose pose : whole.target) {
    if (pose.frame < begin || pose.frame >= end) continue;
    pose.frame -= begin;
    part.target.push_back(pose);
  }
  return part;
}

std::vector<RotationObservation> rotationsOf(const Recording& recording) {
  std::vector<RotationObservation> rotations;
  for (const GroundHomography& ground : recording.ground) {
    rotations.push_back({recording.t_cam_s[ground.a], recording.t_cam_s[ground.b],
                         rotationsFromHomography(recording.camera->K(), ground.H)});
  }
  for (size_t i = 0; i + 1 < recording.target.size(); ++i) {
    const TargetPose& a = recording.target[i];
    const TargetPose& b = recording.target[i + 1];
    const Eigen::Vector3d turn = logSO3((a.q_CT * b.q_CT.conjugate()).toRotationMatrix());
    rotations.push_back({recording.t_cam_s[a.frame], recording.t_cam_s[b.frame], {turn, {turn}}});
  }
  return rotations;
}

}  // namespace redbee::calibration
