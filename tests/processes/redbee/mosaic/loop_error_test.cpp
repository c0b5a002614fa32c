// The endless flight comes back to where it was after each period: how far the mosaic then is from itself.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>

#include "processes/redbee/mosaic/make_mosaic.hpp"
#include "processes/redbee/mosaic/track_drawing.hpp"
#include "redbee/files/atomic_file.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/log.hpp"
#include "tests/support/endless_flight.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/sensor_messages.hpp"

namespace redbee::test {
namespace {

constexpr int kSettled = 24;  ///< frames, until vision has corrected the velocity
constexpr int kFlown = kLoopFrames + kSettled + 12;

Configuration endlessVehicle() {
  const simulation::Scenario scenario = endlessScenario();
  Configuration configuration;
  configuration.camera = scenario.intrinsics;
  configuration.inertial.extrinsics = scenario.extrinsics;
  configuration.inertial.noise = scenario.imu.noise;
  return configuration;
}

void writeFlight(const EndlessFlight& flight, const std::filesystem::path& file) {
  const simulation::Scenario& s = flight.scenario();
  const double end_s = static_cast<double>(kFlown) / kFps + 0.5;
  std::vector<SensorMessage> messages;
  for (const ImuSample& sample : simulation::simulateImu(s.trajectory, 0, end_s, ImuTime(s.start), s.imu))
    messages.push_back(encoded(message(sample)));
  for (const AltitudeSample& sample :
       simulation::simulateAltimeter(s.trajectory, s.extrinsics, 0, end_s, ImuTime(s.start),
                                     s.altimeter.rate_hz, s.altimeter.sigma_m, s.altimeter.seed))
    messages.push_back(encoded(message(sample)));
  for (int k = 0; k < kFlown; ++k)
    messages.push_back(encoded(rawGreyMessage(flight.utime(k), flight.image(k))));
  std::stable_sort(messages.begin(), messages.end(),
                   [](const SensorMessage& a, const SensorMessage& b) { return a.utime < b.utime; });
  LogWriter log(file);
  for (const SensorMessage& m : messages) log.write(m.utime, m.channel, m.data);
  log.close();
}

TEST(Mosaic, ComesBackToItselfAfterALoop) {
  const ScratchFolder folder;
  const EndlessFlight flight;
  writeFlight(flight, folder / "loop.lcm");
  const Configuration configuration = endlessVehicle();
  const GroundObserver ground = observeGround(folder / "loop.lcm", configuration);
  EXPECT_EQ(ground.chain().pieces(), 1U);
  const GroundFrames frames = mapped(ground.chain().longestPiece(), camera().K_inverse());
  ASSERT_TRUE(frames.is_metric);
  std::map<int64_t, Eigen::Matrix3d> to_map;
  for (const MappedFrame& frame : frames.frames) to_map[frame.utime] = frame.to_map;

  // The same place, seen before and after the loop, at four points below the image's middle.
  double worst_m = 0;
  double sum_m = 0;
  int count = 0;
  for (int k = kSettled; k + kLoopFrames < kFlown; ++k) {
    ASSERT_TRUE(to_map.count(flight.utime(k)) == 1 && to_map.count(flight.utime(k + kLoopFrames)) == 1);
    for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(160, 300), {480, 300}, {160, 460}, {480, 460}}) {
      const auto place = [&](int frame) -> Eigen::Vector2d {
        return (to_map[flight.utime(frame)] * pixel.homogeneous()).eval().hnormalized();
      };
      const double off_m = (place(k + kLoopFrames) - place(k)).norm();
      worst_m = std::max(worst_m, off_m);
      sum_m += off_m;
      ++count;
    }
  }
  std::printf("loop of %d s: the mosaic is off by %.3f m on average, %.3f m at worst\n", kPeriod_s,
              sum_m / count, worst_m);
  EXPECT_LT(worst_m, 0.5);
}

TEST(Mosaic, LeavesImageTracksAndSummaryAndReportsDamage) {
  const ScratchFolder folder;
  const EndlessFlight flight;
  writeFlight(flight, folder / "loop.lcm");
  writeText(folder / "vehicle.yaml", emitYaml(endlessVehicle()));
  MosaicOptions options;
  options.log = folder / "loop.lcm";
  options.configuration = folder / "vehicle.yaml";
  options.out = folder / "out";
  options.every = 8;
  fs::resize_file(options.log, fs::file_size(options.log) - 1);
  testing::internal::CaptureStderr();
  const MosaicSummary summary = makeMosaic(options);
  const std::string errors = testing::internal::GetCapturedStderr();
  EXPECT_NE(errors.find("warning: " + options.log.string() + ": byte "), std::string::npos) << errors;
  EXPECT_TRUE(summary.is_metric);
  EXPECT_GT(summary.tracks, 3U);
  for (const char* file : {"mosaic.png", "tracks.png", "tracks.csv", "summary.json"})
    EXPECT_TRUE(fs::exists(options.out / file)) << file;
}

TEST(Mosaic, RefusesAFlightWithoutImages) {
  const ScratchFolder folder;
  LogWriter log(folder / "empty.lcm");
  log.write("ALTIMETER", message(AltitudeSample{}));
  log.close();
  writeText(folder / "vehicle.yaml", emitYaml(endlessVehicle()));
  EXPECT_THROW(makeMosaic({folder / "empty.lcm", folder / "vehicle.yaml", folder / "out", 3000, 2}),
               InputError);
}

}  // namespace
}  // namespace redbee::test
