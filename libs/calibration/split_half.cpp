#include "redbee/calibration/split_half.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/so3.hpp"

namespace redbee::calibration {
namespace {

constexpr size_t kMinFrames = 48;

/// The entry that differs most, relative to its standard deviation.
SplitHalfEntry largest(const std::string& name, const std::string& unit, const Eigen::VectorXd& difference,
                       const Eigen::VectorXd& variance, double scale) {
  SplitHalfEntry entry{name, unit, 0, 0, static_cast<int>(difference.size())};
  for (Eigen::Index i = 0; i < difference.size(); ++i) {
    const double sigma = std::sqrt(std::max(variance(i), 1e-30));
    if (i > 0 && std::abs(difference(i)) / sigma <= entry.ratio()) continue;
    entry.difference = std::abs(difference(i));
    entry.sigma = sigma;
  }
  entry.difference *= scale;
  entry.sigma *= scale;
  return entry;
}

/// Parameters that are not observable in one half are left out.
void addTelling(std::vector<SplitHalfEntry>& entries, const SplitHalfEntry& entry, double largest_sigma) {
  if (entry.sigma < largest_sigma) entries.push_back(entry);
}

Eigen::VectorXd one(double value) { return Eigen::VectorXd::Constant(1, value); }

}  // namespace

std::vector<SplitHalfEntry> splitHalf(const Recording& recording, const CalibrationInput& input,
                                      const FlightSolution& whole) {
  const size_t n = recording.t_cam_s.size();
  const size_t middle = n / 2;
  if (middle < kMinFrames) return {};
  Mounting start;
  start.R_CI = whole.state.q_CI.toRotationMatrix();
  start.p_IC = whole.state.p_IC;
  start.timeshift_s = whole.state.timeshift_s;
  start.gyro_bias = whole.state.biases.front().gyro;
  // The homographies are those that the whole solution selected.
  Recording chosen = recording;
  chosen.ground = whole.input.ground;
  chosen.matches.clear();
  // The frame in the middle belongs to both, so that its height can be compared.
  const FlightSolution first =
      solveFlight(partOf(chosen, 0, middle + 1), input, start, whole.input.priors, input.start_height);
  const FlightSolution second =
      solveFlight(partOf(chosen, middle, n), input, start, whole.input.priors, std::nullopt);
  if (!first.usable || !second.usable) return {};

  const JointCovariance& a = first.analysis.covariance;
  const JointCovariance& b = second.analysis.covariance;
  const Eigen::Vector3d turn = logSO3((first.state.q_CI * second.state.q_CI.conjugate()).toRotationMatrix());
  std::vector<SplitHalfEntry> entries;
  addTelling(entries,
             largest("camera.R_CI", "deg", turn, a.rotation.diagonal() + b.rotation.diagonal(), 1 / kDegree),
             1.0);
  addTelling(entries,
             largest("camera.timeshift_s", "ms", one(first.state.timeshift_s - second.state.timeshift_s),
                     one(a.timeshift + b.timeshift), 1e3),
             5.0);
  if (!recording.hasTarget()) {
    const double difference =
        cameraHeight(first.state, first.state.frames.size() - 1) - cameraHeight(second.state, 0);
    addTelling(entries,
               largest("plane.height_m", "m", one(difference), one(a.last_height + b.first_height), 1),
               0.1 * cameraHeight(whole.state, middle));
  }
  // The bias itself may have changed between the halves.
  const double walk =
      input.noise.gyro_random_walk * std::sqrt(0.5 * (recording.t_cam_s.back() - recording.t_cam_s.front()));
  addTelling(entries,
             largest("gyro_bias", "deg/s", first.state.biases.front().gyro - second.state.biases.front().gyro,
                     a.gyro_bias.diagonal() + b.gyro_bias.diagonal() + Eigen::Vector3d::Constant(walk * walk),
                     1 / kDegree),
             0.25);
  return entries;
}

double disagreement(const std::vector<SplitHalfEntry>& entries) {
  // Mean of the largest of one, and of three, squared standard normal variables.
  constexpr double kExpectedOfOne = 1.0, kExpectedOfThree = 2.1;
  double sum = 0;
  for (const SplitHalfEntry& entry : entries) {
    sum += entry.ratio() * entry.ratio() / (entry.entries == 1 ? kExpectedOfOne : kExpectedOfThree);
  }
  return entries.empty() ? 1.0 : std::max(1.0, std::sqrt(sum / static_cast<double>(entries.size())));
}

}  // namespace redbee::calibration
