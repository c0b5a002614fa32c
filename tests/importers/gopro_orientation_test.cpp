// A recording whose camera turns by a known rate, and whose images are turned against it.
#include "redbee/importers/gopro_orientation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "redbee/geometry/angle.hpp"
#include "redbee/geometry/so3.hpp"
#include "tests/support/gpmf_bytes.hpp"

namespace redbee::test {
namespace {

constexpr int kGyro_hz = 400;
constexpr int kFrames_hz = 25;
constexpr double kLag_s = 0.013;
constexpr double kScale = 32767;

/// rad/s, in I.
Eigen::Vector3d rateAt(double t_s) {
  return {0.8 * std::sin(5 * t_s), 0.5 * std::cos(3 * t_s), -0.6 * std::sin(7 * t_s + 1)};
}

Eigen::Matrix3d R_GI(double t_s) {
  constexpr double kStep_s = 1e-3;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  for (double t = 0; t < t_s; t += kStep_s)
    R = R * expSO3(std::min(kStep_s, t_s - t) * rateAt(t + kStep_s / 2));
  return R;
}

/// Image in the camera: turned about I's x (a roll), y and z.
Eigen::Matrix3d R_XC(double t_s) { return expSO3({0.1 * std::sin(t_s), 0.05 * t_s, -0.03 * t_s}); }

/// As GoPro stores a rotation that is given in I's axes: w, right, down, forward.
std::vector<int> stored(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  const auto entry = [](double value) { return static_cast<int>(std::lround(kScale * value)); };
  return {entry(q.w()), entry(-q.y()), entry(-q.z()), entry(q.x())};
}

Bytes quaternions(const std::string& key, const std::vector<int>& values) {
  Bytes inside = record("SCAL", 's', 2, 1, shorts({static_cast<int>(kScale)}));
  append(inside, record(key, 's', 8, values.size() / 4, shorts(values)));
  return container("STRM", inside);
}

DataPacket second(int k, double lag_s) {
  std::vector<int> gyro, cori, iori;
  for (int i = 0; i < kGyro_hz; ++i) {
    const Eigen::Vector3d w = 10000 * rateAt(k + 1.0 * i / kGyro_hz);
    for (const double channel : {w.z(), w.y(), -w.x()})
      gyro.push_back(static_cast<int>(std::lround(channel)));
  }
  for (int i = 0; i < kFrames_hz; ++i) {
    const double t_s = k + 1.0 * i / kFrames_hz;
    for (const int value : stored(R_GI(t_s + lag_s).transpose())) cori.push_back(value);
    for (const int value : stored(R_XC(t_s))) iori.push_back(value);
  }
  Bytes inside = stream("ACCL", "m/s\xB2", 100, (k + 1) * 200, 200, {981, 0, 0});
  Bytes samples = record("TSMP", 'L', 4, 1, bigEndian(static_cast<uint64_t>((k + 1) * kGyro_hz), 4));
  append(samples, text("SIUN", "rad/s"));
  append(samples, record("SCAL", 's', 2, 1, shorts({10000})));
  append(samples, record("GYRO", 's', 6, kGyro_hz, shorts(gyro)));
  append(inside, container("STRM", samples));
  append(inside, quaternions("CORI", cori));
  append(inside, quaternions("IORI", iori));
  return {1.0 * k, 1.0, container("DEVC", inside)};
}

std::vector<DataPacket> recording(double lag_s) {
  return {second(0, lag_s), second(1, lag_s), second(2, lag_s)};
}

TEST(GoproOrientation, ImagesAreTurnedAsTheirTrackSays) {
  const std::vector<MountSample> turns = imageTurns(recording(0));
  ASSERT_EQ(turns.size(), 3u * kFrames_hz);
  for (size_t k = 0; k < turns.size(); ++k) {
    const double t_s = static_cast<double>(k) / kFrames_hz;
    EXPECT_EQ(toUtime(turns[k].time), toUtime(ImuTime(fromSeconds(t_s))));
    const Eigen::Matrix3d R_MI = turns[k].q_IM.conjugate().toRotationMatrix();
    EXPECT_LT(logSO3(R_MI * R_XC(t_s).transpose()).norm(), 0.01 * kDegree) << k;
  }
  EXPECT_GT(largestTurn_deg(turns), 5);
}

TEST(GoproOrientation, TheCamerasOwnTrackShowsWhenTheFrameWasExposed) {
  for (const double lag_s : {0.0, kLag_s}) {
    const std::vector<DataPacket> packets = recording(lag_s);
    const auto found = frameLag(packets, readGoproStreams(packets));
    ASSERT_TRUE(found);
    EXPECT_NEAR(*found, lag_s, 0.0015);
  }
}

TEST(GoproOrientation, ATrackThatDoesNotFitShowsNothing) {
  std::vector<DataPacket> swapped = recording(0);
  GoproStreams streams = readGoproStreams(swapped);
  for (TimedVector& gyro : streams.gyro)
    gyro.value = Eigen::Vector3d(gyro.value.y(), gyro.value.z(), gyro.value.x());
  EXPECT_FALSE(frameLag(swapped, streams));
  EXPECT_FALSE(frameLag(packets(3), readGoproStreams(packets(3)))) << "without a track";
}

}  // namespace
}  // namespace redbee::test
