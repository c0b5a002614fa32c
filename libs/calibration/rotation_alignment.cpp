#include "redbee/calibration/rotation_alignment.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "redbee/geometry/so3.hpp"

namespace redbee::calibration {
namespace {

constexpr size_t kMinObservations = 20;
constexpr double kCoarseStep_s = 0.002;
constexpr double kFineStep_s = 0.0005;
constexpr double kFineReach_s = 0.012;

/// Observations with all their quantities that do not depend on the shift.
class Aligner {
 public:
  Aligner(std::vector<RotationObservation> observations, const ImuHistory& imu)
      : observations_(std::move(observations)), imu_(imu) {
    for (const RotationObservation& o : observations_) chosen_.push_back(o.rotation.rough / duration(o));
  }

  size_t size() const { return observations_.size(); }
  const std::vector<RotationObservation>& observations() const { return observations_; }

  std::vector<RatePair> pairsAt(double shift_s) const {
    std::vector<RatePair> pairs(size());
    for (size_t i = 0; i < size(); ++i) pairs[i] = {chosen_[i], imuRate(i, shift_s)};
    return pairs;
  }

  /// Of the possible rotations, selects the one nearest to the gyro's.
  void choose(const HandEye& solution, double shift_s) {
    for (size_t i = 0; i < size(); ++i) {
      const Eigen::Vector3d predicted = solution.R_CI * (imuRate(i, shift_s) - solution.gyro_bias);
      const auto& exact = observations_[i].rotation.exact;
      const double dt = duration(observations_[i]);
      const auto nearest = std::min_element(exact.begin(), exact.end(), [&](const auto& a, const auto& b) {
        return (a / dt - predicted).squaredNorm() < (b / dt - predicted).squaredNorm();
      });
      chosen_[i] = *nearest / dt;
    }
  }
  void chooseRough() {
    for (size_t i = 0; i < size(); ++i) {
      chosen_[i] = observations_[i].rotation.rough / duration(observations_[i]);
    }
  }

 private:
  static double duration(const RotationObservation& o) { return o.t_b_s - o.t_a_s; }
  Eigen::Vector3d imuRate(size_t i, double shift_s) const {
    return imu_.meanRate(observations_[i].t_a_s + shift_s, observations_[i].t_b_s + shift_s);
  }

  std::vector<RotationObservation> observations_;
  const ImuHistory& imu_;
  std::vector<Eigen::Vector3d> chosen_;  ///< rad/s in C
};

/// Shift of the curve's smallest value, refined by the parabola through it and its neighbours.
double smallest(const TimeShiftCurve& curve) {
  const auto least = std::min_element(curve.value.begin(), curve.value.end());
  const auto i = static_cast<size_t>(least - curve.value.begin());
  if (i == 0 || i + 1 == curve.value.size()) return curve.shift_s[i];
  const double before = curve.value[i - 1], here = curve.value[i], after = curve.value[i + 1];
  const double bend = before - 2 * here + after;
  const double step = curve.shift_s[i + 1] - curve.shift_s[i];
  return curve.shift_s[i] + (bend > 0 ? 0.5 * step * (before - after) / bend : 0.0);
}

template <typename Value>
TimeShiftCurve sweep(double centre_s, double reach_s, double step_s, const Value& value) {
  TimeShiftCurve curve;
  const int steps = static_cast<int>(std::lround(reach_s / step_s));
  for (int i = -steps; i <= steps; ++i) {
    curve.shift_s.push_back(centre_s + i * step_s);
    curve.value.push_back(value(curve.shift_s.back()));
  }
  return curve;
}

double correlationOfMagnitudes(const std::vector<RatePair>& pairs) {
  const auto n = static_cast<double>(pairs.size());
  double mean_c = 0, mean_i = 0;
  for (const RatePair& pair : pairs) {
    mean_c += pair.camera.norm() / n;
    mean_i += pair.imu.norm() / n;
  }
  double cc = 0, ii = 0, ci = 0;
  for (const RatePair& pair : pairs) {
    const double c = pair.camera.norm() - mean_c;
    const double i = pair.imu.norm() - mean_i;
    cc += c * c;
    ii += i * i;
    ci += c * i;
  }
  return cc > 0 && ii > 0 ? ci / std::sqrt(cc * ii) : 0.0;
}

double rateVariation(const std::vector<RatePair>& pairs) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const RatePair& pair : pairs) mean += pair.imu / static_cast<double>(pairs.size());
  double sum = 0;
  for (const RatePair& pair : pairs) sum += (pair.imu - mean).squaredNorm();
  return std::sqrt(sum / static_cast<double>(pairs.size()));
}

/// All 24 rotations that map axes onto axes: a camera is mounted near one of them, or half-way between two.
std::vector<Eigen::Matrix3d> rightAngledRotations() {
  std::vector<Eigen::Matrix3d> rotations;
  for (int x = 0; x < 3; ++x) {
    for (int y = 0; y < 3; ++y) {
      if (x == y) continue;
      for (const double sx : {-1.0, 1.0}) {
        for (const double sy : {-1.0, 1.0}) {
          Eigen::Matrix3d R;
          R.row(0) = sx * Eigen::RowVector3d::Unit(x);
          R.row(1) = sy * Eigen::RowVector3d::Unit(y);
          R.row(2) = R.row(0).cross(R.row(1));
          rotations.push_back(R);
        }
      }
    }
  }
  return rotations;
}

/// Alternates between closed form and selection of candidates until neither changes (a few rounds suffice).
HandEye iterate(Aligner& aligner, HandEye solution, double shift_s, double scale) {
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    aligner.choose(solution, shift_s);
    solution = solveHandEye(aligner.pairsAt(shift_s), scale);
  }
  return solution;
}

HandEye bestFromAllStarts(Aligner& aligner, double shift_s) {
  aligner.chooseRough();
  const HandEye rough = solveHandEye(aligner.pairsAt(shift_s));
  HandEye best = iterate(aligner, rough, shift_s, 0);
  // Costs of different starts are comparable only under one robust scale.
  const double scale = std::max(3.0 * best.residual, 1e-4);
  best = iterate(aligner, best, shift_s, scale);
  for (const Eigen::Matrix3d& R : rightAngledRotations()) {
    HandEye start;
    start.R_CI = R;
    const HandEye found = iterate(aligner, start, shift_s, scale);
    if (found.cost < best.cost) best = found;
  }
  aligner.choose(best, shift_s);
  return solveHandEye(aligner.pairsAt(shift_s));
}

std::vector<RotationObservation> usable(const std::vector<RotationObservation>& observations,
                                        const ImuHistory& imu, const RotationAlignmentOptions& options) {
  std::vector<RotationObservation> chosen;
  if (imu.size() < 2) return chosen;
  const double margin = options.max_shift_s + 2 * kFineReach_s;
  for (const RotationObservation& o : observations) {
    const bool inside = o.t_a_s - margin >= imu.begin_s() && o.t_b_s + margin <= imu.end_s();
    const double duration = o.t_b_s - o.t_a_s;
    if (inside && duration > 0 && duration <= options.max_interval_s) chosen.push_back(o);
  }
  return chosen;
}

}  // namespace

RotationAlignment alignRotations(const std::vector<RotationObservation>& observations, const ImuHistory& imu,
                                 const RotationAlignmentOptions& options) {
  RotationAlignment alignment;
  Aligner aligner(usable(observations, imu, options), imu);
  if (aligner.size() < kMinObservations) return alignment;
  alignment.possible = true;

  alignment.correlation_curve = sweep(0, options.max_shift_s, kCoarseStep_s, [&](double shift) {
    return correlationOfMagnitudes(aligner.pairsAt(shift));
  });
  TimeShiftCurve negative = alignment.correlation_curve;
  for (double& value : negative.value) value = -value;
  double shift = smallest(negative);
  alignment.correlation = -*std::min_element(negative.value.begin(), negative.value.end());

  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    alignment.hand_eye =
        round == 0 ? bestFromAllStarts(aligner, shift) : iterate(aligner, alignment.hand_eye, shift, 0);
    alignment.residual_curve = sweep(shift, kFineReach_s, kFineStep_s, [&](double s) {
      return solveHandEye(aligner.pairsAt(s), 3.0 * alignment.hand_eye.residual).cost;
    });
    shift = std::clamp(smallest(alignment.residual_curve), -options.max_shift_s, options.max_shift_s);
  }
  for (double& value : alignment.residual_curve.value) value = std::sqrt(value / 3.0);
  alignment.timeshift_s = shift;
  alignment.hand_eye = iterate(aligner, alignment.hand_eye, shift, 0);
  alignment.rates = aligner.pairsAt(shift);
  alignment.rate_variation = rateVariation(alignment.rates);
  for (const RotationObservation& o : aligner.observations()) {
    alignment.t_s.push_back(0.5 * (o.t_a_s + o.t_b_s));
  }
  return alignment;
}

}  // namespace redbee::calibration
