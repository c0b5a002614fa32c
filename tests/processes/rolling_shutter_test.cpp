// A simulated flight with brisk turns, seen by a global and by a rolling shutter.
#include "redbee/geometry/rolling_shutter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <map>
#include <opencv2/imgcodecs.hpp>

#include "processes/conversions.hpp"
#include "redbee/evaluation/pixel_measures.hpp"
#include "redbee/node/message_check.hpp"
#include "tests/support/silent_bus.hpp"
#include "tests/support/stack_run.hpp"

namespace redbee::test {
namespace {

constexpr int kFrames = 96;
constexpr int kSettled = 24;
constexpr double kReadout_s = 0.025;
constexpr int kBands = 3;

simulation::Scenario shutter(double readout_s) {
  return withRollingShutter(simulation::briskWalkers(2), readout_s);
}

struct Result {
  double error_at_half_recall;
  double band_px[kBands];  ///< rms error of the ground, in the top, the middle, the bottom of the image
};

/// Where the ground point that frame k-1 shows at a raw pixel is in frame k: each camera at the time of its
/// row.
std::optional<Eigen::Vector2d> truePlace(const simulation::FlightSimulator& flight, int k,
                                         const Eigen::Vector2d& from) {
  const Camera& camera = flight.camera();
  const auto poseOfRow = [&](int frame, double row) {
    return flight.poseAt(flight.exposureTime(frame) + rowTime(camera.intrinsics(), row));
  };
  const simulation::CameraPose a = poseOfRow(k - 1, from.y());
  const Eigen::Vector3d ray = a.R_CG.transpose() * camera.K_inverse() * from.homogeneous();
  if (ray.z() > -0.1) return std::nullopt;
  const Eigen::Vector3d X = a.p_GC - ray * (a.p_GC.z() / ray.z());
  Eigen::Vector2d to = from;
  for (int i = 0; i < 6; ++i) {
    const simulation::CameraPose b = poseOfRow(k, to.y());
    to = (camera.K() * b.R_CG * (X - b.p_GC)).hnormalized();
  }
  const bool is_inside = (to.array() >= 0).all() && to.x() <= 639 && to.y() <= 479;
  return is_inside ? std::optional(to) : std::nullopt;
}

Eigen::Vector2d toIdeal(const Camera& camera, const Eigen::Vector2d& raw, const row_motion_t& motion) {
  const auto known = rowMotionOf(motion);
  return known ? idealPixel(camera, raw, *known).value() : raw;
}

Result run(double readout_s, bool is_corrected) {
  const simulation::Scenario scenario = shutter(readout_s);
  const simulation::FlightSimulator simulator(scenario);
  StackFlight flight = stackFlight(scenario, kFrames);
  if (!is_corrected) flight.configuration.camera.line_delay_s = 0;
  const StackOutput output = StackRun(flight).run();
  PixelMeasures measures;
  double squares[kBands] = {}, count[kBands] = {};
  for (int k = kSettled; k < kFrames; ++k) {
    const auto index = static_cast<size_t>(k);
    const int64_t utime = flight.frame_utimes[index];
    const foreground_t& foreground = output.foreground.at(utime);
    measures.add(cv::imdecode(foreground.probability, cv::IMREAD_GRAYSCALE), flight.masks[index]);
    const fused_homography_t& fused = output.fused.at(utime);
    const row_motion_t& before = output.fused.at(flight.frame_utimes[index - 1]).row_motion;
    for (int v = 8; v < 480; v += 16) {
      for (int u = 8; u < 640; u += 16) {
        const auto truth = truePlace(simulator, k, {u, v});
        if (!truth) continue;
        const Eigen::Vector2d moved =
            transfer(matrix3(fused.step.H), toIdeal(simulator.camera(), {u, v}, before));
        const double error = (moved - toIdeal(simulator.camera(), *truth, fused.row_motion)).norm();
        squares[v * kBands / 480] += error * error;
        count[v * kBands / 480] += 1;
      }
    }
  }
  Result result{measures.errorAtHalfRecall(), {}};
  std::cout << "read-out " << readout_s << (is_corrected ? "" : ", uncorrected") << ": Error@50% "
            << result.error_at_half_recall << ", ground's error top to bottom";
  for (int band = 0; band < kBands; ++band) {
    result.band_px[band] = std::sqrt(squares[band] / count[band]);
    std::cout << ' ' << result.band_px[band];
  }
  std::cout << " px\n";
  return result;
}

TEST(RollingShutterFlight, MoversAndGroundAreFoundAsWithAGlobalShutter) {
  const Result global = run(0, true), rolling = run(kReadout_s, true), uncorrected = run(kReadout_s, false);
  EXPECT_NEAR(rolling.error_at_half_recall, global.error_at_half_recall, 0.03);
  for (const int edge : {0, kBands - 1}) {
    EXPECT_LT(rolling.band_px[edge], 1.5 * std::max(rolling.band_px[1], global.band_px[edge]));
    EXPECT_LT(rolling.band_px[edge], uncorrected.band_px[edge] / 2) << "there was something to correct";
  }
}

/// Error@50% of a second in which vision gives no homography, as over water or in blur: the IMU's carries it.
double errorWithoutVision(double readout_s, bool is_corrected) {
  constexpr int kFrom = 36, kScored = 40, kTo = 66;
  StackFlight flight = stackFlight(shutter(readout_s), kTo + 4);
  if (!is_corrected) flight.configuration.camera.line_delay_s = 0;
  const auto memq = makeLcmBus("memq://");
  SilentBus<visual_homography_t> bus(*memq, "VISUAL_HOMOGRAPHY", flight.frame_utimes[kFrom],
                                     flight.frame_utimes[kTo]);
  const StackOutput output = StackRun(flight, bus).run();
  PixelMeasures measures;
  for (int k = kScored; k < kTo; ++k) {
    const auto index = static_cast<size_t>(k);
    const int64_t utime = flight.frame_utimes[index];
    if (is_corrected) {
      EXPECT_EQ(output.fused.at(utime).source, fused_homography_t::INERTIAL) << k;
    }
    measures.add(cv::imdecode(output.foreground.at(utime).probability, cv::IMREAD_GRAYSCALE),
                 flight.masks[index]);
  }
  std::cout << "without vision, read-out " << readout_s << (is_corrected ? "" : ", uncorrected")
            << ": Error@50% " << measures.errorAtHalfRecall() << '\n';
  return measures.errorAtHalfRecall();
}

/// An image's own homography takes up most of what a rolling shutter does to it, the IMU's nothing.
TEST(RollingShutterFlight, MoversAreFoundAsWithAGlobalShutterWhereTheImuAloneCarriesTheHomography) {
  const double global = errorWithoutVision(0, true);
  EXPECT_NEAR(errorWithoutVision(kReadout_s, true), global, 0.03);
  EXPECT_GT(errorWithoutVision(kReadout_s, false), global + 0.03) << "there was something to correct";
}

/// A recorder fills a gap with the frame before, encoded once more.
TEST(RollingShutterFlight, ARepeatedImageIsStillRecognised) {
  constexpr int kRepeated = 20;
  StackFlight flight = stackFlight(shutter(kReadout_s), kRepeated + 4);
  const SensorMessage* before = nullptr;
  for (SensorMessage& sent : flight.messages) {
    if (sent.channel != "CAMERA") continue;
    if (sent.utime == flight.frame_utimes[kRepeated]) {
      image_t image, earlier;
      ASSERT_TRUE(decodePlausible(sent.data, image) && decodePlausible(before->data, earlier));
      image.data = earlier.data;
      sent = encoded(image);
    }
    before = &sent;
  }
  const StackOutput output = StackRun(flight).run();
  EXPECT_EQ(output.visual.at(flight.frame_utimes[kRepeated]).status, visual_homography_t::REPEATED);
  EXPECT_EQ(output.visual.at(flight.frame_utimes[kRepeated + 1]).status, visual_homography_t::GOOD);
}

}  // namespace
}  // namespace redbee::test
