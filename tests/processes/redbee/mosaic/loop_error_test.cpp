// The endless flight comes back to where it was after each period: how far the mosaic then is from itself.
#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include "processes/redbee/mosaic/make_mosaic.hpp"
#include "processes/redbee/mosaic/track_drawing.hpp"
#include "redbee/files/atomic_file.hpp"
#include "redbee/files/input_error.hpp"
#include "redbee/files/log.hpp"
#include "tests/support/endless_flight.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/sensor_messages.hpp"
#include "tests/support/target_flight.hpp"

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

/// As an autopilot knows it that is never wrong; G is east, north, up from the place of take-off.
pose_t poseAt(const simulation::Scenario& s, int64_t utime, double t_s) {
  const simulation::TrajectoryState state = s.trajectory.at(t_s);
  pose_t m{};
  m.utime = utime;
  const Eigen::Quaterniond q(state.R_GI);
  m.quat[0] = q.w();
  for (int i = 0; i < 3; ++i) m.quat[i + 1] = q.vec()[i];
  for (const int i : {0, 4, 8}) {
    m.attitude_covariance[i] = 1e-5;
    m.position_covariance[i] = 1e-2;
  }
  m.has_global = m.has_home_altitude = 1;
  const Geodetic place = TargetFlight::placeOf(state.p_GI.head<2>());
  m.latitude = place.latitude_deg;
  m.longitude = place.longitude_deg;
  m.home_altitude = state.p_GI.z();
  m.altitude = TargetFlight::kHomeAltitude + state.p_GI.z();
  return m;
}

void writeFlight(const EndlessFlight& flight, const std::filesystem::path& file, bool has_poses = false) {
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
  for (int k = 0; has_poses && k < kFlown; ++k) {
    const double t_s = static_cast<double>(k) / kFps;
    const pose_t pose = poseAt(s, s.start.count() + std::llround(t_s * 1e6), t_s);
    messages.push_back({pose.utime, "POSE", encodeMessage(pose)});
  }
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
  const GroundFrames frames = mapped(ground.chain().longestPiece(), camera().K());
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
  EXPECT_EQ(summary.why_no_place, "no POSE");
  EXPECT_FALSE(fs::exists(options.out / "mosaic.tif"));
  for (const char* file : {"mosaic.png", "tracks.png", "tracks.csv", "summary.json"})
    EXPECT_TRUE(fs::exists(options.out / file)) << file;
}

/// What GDAL says of a pixel's place: longitude and latitude.
std::optional<Eigen::Vector2d> placeByGdal(const fs::path& image, const Eigen::Vector2d& pixel) {
  const std::string command = fmt::format("echo {} {} | gdaltransform -t_srs EPSG:4326 {} 2>&1",
                                          pixel.x() + 0.5, pixel.y() + 0.5, image.string());
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  Eigen::Vector2d place;
  const int read = std::fscanf(pipe, "%lf %lf", &place.x(), &place.y());
  pclose(pipe);
  return read == 2 ? std::optional(place) : std::nullopt;
}

TEST(Mosaic, LiesWhereThePosesHaveIt) {
  if (std::system("gdaltransform --version >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "no gdaltransform: scripts/setup scripts/packages-map.txt";
  const ScratchFolder folder;
  const EndlessFlight flight;
  writeFlight(flight, folder / "loop.lcm", true);
  const Configuration configuration = endlessVehicle();
  writeText(folder / "vehicle.yaml", emitYaml(configuration));
  const MosaicSummary summary = makeMosaic({folder / "loop.lcm", folder / "vehicle.yaml", folder / "out"});
  EXPECT_EQ(summary.epsg, 32632) << summary.why_no_place;

  // A point of the ground that a frame in the middle shows: by the mosaic's grid, and in truth.
  const GroundObserver ground = observeGround(folder / "loop.lcm", configuration);
  const GroundFrames frames = mapped(ground.chain().longestPiece(), camera().K());
  const auto grid =
      gridFor(frames, {camera().ideal().width, camera().ideal().height}, MosaicOptions().most_px);
  ASSERT_TRUE(grid);
  const simulation::Scenario& s = flight.scenario();
  const int k = kFlown / 2;
  const auto frame = std::find_if(frames.frames.begin(), frames.frames.end(),
                                  [&](const MappedFrame& f) { return f.utime == flight.utime(k); });
  ASSERT_NE(frame, frames.frames.end());
  const simulation::CameraPose pose = simulation::cameraPose(
      s.trajectory.at(static_cast<double>(k) / kFps + s.extrinsics.timeshift_s), s.extrinsics);
  double worst_m = 0;
  for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(160, 300), {480, 300}, {160, 460}, {480, 460}}) {
    const Eigen::Vector3d ray = pose.R_CG.transpose() * camera().K_inverse() * pixel.homogeneous();
    const Eigen::Vector2d truth = (pose.p_GC - pose.p_GC.z() / ray.z() * ray).head<2>();
    const Geodetic expected = TargetFlight::placeOf(truth);
    const auto place = placeByGdal(folder / "out" / "mosaic.tif",
                                   grid->pixelOf((frame->to_map * pixel.homogeneous()).eval().hnormalized()));
    ASSERT_TRUE(place);
    double off_m = 0;
    GeographicLib::Geodesic::WGS84().Inverse(place->y(), place->x(), expected.latitude_deg,
                                             expected.longitude_deg, off_m);
    worst_m = std::max(worst_m, off_m);
  }
  std::printf("mosaic.tif is off by %.3f m at worst, residual %.3f m\n", worst_m, summary.residual_m);
  EXPECT_LT(worst_m, 0.5);  // what its chain of homographies drifts by, see the loop
}

TEST(Mosaic, IsRefusedBeforeTheWorkWhereItCannotBeWritten) {
  const ScratchFolder folder;
  writeText(folder / "out", "a file");
  writeText(folder / "vehicle.yaml", emitYaml(endlessVehicle()));
  // The log is not there either, which would be said later.
  try {
    makeMosaic({folder / "none.lcm", folder / "vehicle.yaml", folder / "out"});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find((folder / "out").string()), std::string::npos) << error.what();
  }
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
