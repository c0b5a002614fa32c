#include "redbee/importers/gopro_orientation.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/so3.hpp"
#include "redbee/importers/gpmf.hpp"

namespace redbee {
namespace {

constexpr int kLagSteps = 100;  // each way
constexpr double kLagStepsPerSecond = 1000;
constexpr double kLeastTurning = 0.02;  // rad/s, rms: a camera that turns less shows no lag
constexpr double kUnexplained = 0.2;    // of the steps' rms that a lag may leave

struct TimedOrientation {
  double t_s;
  Eigen::Quaterniond q;  ///< in the IMU's axes: turns the outer coordinates into the stream's own
};

/// GoPro's right, down, forward are the IMU's -y, -z, x.
std::vector<TimedOrientation> orientations(const std::vector<DataPacket>& packets, const std::string& key) {
  std::vector<TimedOrientation> all;
  for (const DataPacket& packet : packets) {
    const auto found = gpmfQuaternions(packet.bytes, key);
    for (size_t i = 0; i < found.size(); ++i) {
      const auto& [w, right, down, forward] = found[i];
      const Eigen::Quaterniond q(w, forward, -right, -down);
      if (!(q.norm() > 0.5 && q.norm() < 2)) continue;  // damage; and a camera fills up with zeros
      const double t_s =
          packet.start_s + packet.duration_s * static_cast<double>(i) / static_cast<double>(found.size());
      all.push_back({t_s, q.normalized()});
    }
  }
  return all;
}

/// The angle that the gyro has turned through since its first sample, about its own axes: for small steps.
class TurnedAngle {
 public:
  explicit TurnedAngle(const std::vector<TimedVector>& gyro) : gyro_(gyro), angle_(gyro.size()) {
    angle_.front().setZero();
    for (size_t i = 1; i < gyro.size(); ++i) {
      const double dt = gyro[i].t_s - gyro[i - 1].t_s;
      angle_[i] = angle_[i - 1] + 0.5 * dt * (gyro[i].value + gyro[i - 1].value);
    }
  }
  Eigen::Vector3d at(double t_s) const {
    const auto after = std::lower_bound(gyro_.begin(), gyro_.end(), t_s,
                                        [](const TimedVector& each, double t) { return each.t_s < t; });
    if (after == gyro_.begin()) return angle_.front();
    if (after == gyro_.end()) return angle_.back();
    const auto i = static_cast<size_t>(after - gyro_.begin());
    const double fraction = (t_s - gyro_[i - 1].t_s) / (gyro_[i].t_s - gyro_[i - 1].t_s);
    return (1 - fraction) * angle_[i - 1] + fraction * angle_[i];
  }

 private:
  const std::vector<TimedVector>& gyro_;
  std::vector<Eigen::Vector3d> angle_;
};

}  // namespace

std::vector<MountSample> imageTurns(const std::vector<DataPacket>& packets) {
  std::vector<MountSample> turns;
  for (const TimedOrientation& image : orientations(packets, "IORI"))
    turns.push_back({ImuTime(fromSeconds(image.t_s)), image.q.conjugate()});
  return turns;
}

double largestTurn_deg(const std::vector<MountSample>& turns) {
  double largest = 0;
  for (const MountSample& turn : turns)
    largest = std::max(largest, turn.q_IM.angularDistance(turns.front().q_IM));
  return largest / kDegree;
}

std::optional<double> frameLag(const std::vector<DataPacket>& packets, const GoproStreams& streams) {
  const std::vector<TimedOrientation> camera = orientations(packets, "CORI");
  if (camera.size() < 10 || streams.gyro.empty()) return std::nullopt;
  const TurnedAngle angle(streams.gyro);
  double best_s = 0, least = 0, all = 0;
  bool is_first = true;
  for (int k = -kLagSteps; k <= kLagSteps; ++k) {
    const double lag_s = k / kLagStepsPerSecond;
    double squares = 0, total = 0;
    for (size_t i = 1; i < camera.size(); ++i) {
      // World to camera: the step in the camera's own axes.
      const Eigen::Vector3d step = logSO3((camera[i - 1].q * camera[i].q.conjugate()).toRotationMatrix());
      squares += (angle.at(camera[i].t_s + lag_s) - angle.at(camera[i - 1].t_s + lag_s) - step).squaredNorm();
      total += step.squaredNorm();
    }
    all = total;
    if (!is_first && squares >= least) continue;
    is_first = false;
    least = squares;
    best_s = lag_s;
  }
  const double duration_s = camera.back().t_s - camera.front().t_s;
  const double rate = std::sqrt(all * static_cast<double>(camera.size())) / duration_s;
  const bool fits =
      least < kUnexplained * kUnexplained * all && std::abs(best_s) < kLagSteps / kLagStepsPerSecond;
  return rate > kLeastTurning && fits ? std::optional(best_s) : std::nullopt;
}

}  // namespace redbee
