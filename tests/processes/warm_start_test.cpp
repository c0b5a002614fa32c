// An inertial process that is killed in flight goes on from what the flight had learned. Only it and the
// fusion run here: vision is the truth with noise, so that a long flight costs little.
#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <functional>
#include <iostream>
#include <limits>
#include <sstream>

#include "processes/conversions.hpp"
#include "processes/homography_fusion/node.hpp"
#include "processes/imu_integration/node.hpp"
#include "redbee/altimeter_t.hpp"
#include "redbee/image_t.hpp"
#include "tests/inertial/simulated_flight.hpp"
#include "tests/processes/mortal_stack.hpp"

namespace redbee::test {
namespace {

using testing::kFrameRate;
using testing::kStart;

constexpr int kFrames = 324;
constexpr int kKilledAt = 240;  ///< ten seconds of flight have taught the height
constexpr int kDownFrames = 8;  ///< a third of a second: what supervisor needs
constexpr int kBackAt = kKilledAt + kDownFrames;
constexpr double kTrueHeight = 8;

/// What the spdlog of this thread says meanwhile.
class Listener {
 public:
  Listener() {
    auto sink = std::make_shared<spdlog::sinks::ostream_sink_st>(stream_);
    spdlog::set_default_logger(std::make_shared<spdlog::logger>("listener", sink));
  }
  ~Listener() { spdlog::set_default_logger(before_); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  std::string heard() const { return stream_.str(); }

 private:
  std::ostringstream stream_;
  std::shared_ptr<spdlog::logger> before_ = spdlog::default_logger();
};

/// A drone whose configured height is 40 % off, and says no more than that.
struct Sky {
  explicit Sky(unsigned seed, bool with_altimeter = false)
      : trajectory(simulation::Trajectory::ordinary(seed, kTrueHeight)),
        extrinsics(testing::testExtrinsics(kTrueHeight)) {
    simulation::ImuSimulatorParameters parameters;
    parameters.noise = testing::consumerNoise();
    parameters.gyro_bias = {0.004, -0.006, 0.003};
    parameters.accel_bias = {0.06, 0.05, -0.06};
    parameters.seed = seed;
    const double end = kFrames / kFrameRate + 0.5;
    imu = simulation::simulateImu(trajectory, -0.5, end, kStart, parameters);
    if (with_altimeter) {
      altitudes = simulation::simulateAltimeter(trajectory, extrinsics, 0, end, kStart, 50, 0.05, seed);
    }
    configuration.camera = testing::testCamera().intrinsics();
    configuration.has_altimeter = with_altimeter;
    configuration.inertial.extrinsics = extrinsics;
    configuration.inertial.noise = testing::consumerNoise();
    configuration.inertial.extrinsics.start_height_m = 0.6 * heightAt(0);
    configuration.inertial.extrinsics.start_height_sigma_m = 0.4 * heightAt(0);
  }
  PlaneMotion motion(int k) const {
    const auto at = [&](int frame) { return testing::trajectoryTime(testing::frameTime(frame), extrinsics); };
    return simulation::exactMotion(trajectory, extrinsics, at(k - 1), at(k));
  }
  double heightAt(int k) const { return motion(k + 1).h_a; }
  Eigen::Matrix3d homography(int k) const { return planeHomography(testing::testCamera().K(), motion(k)); }

  simulation::Trajectory trajectory;
  InertialExtrinsics extrinsics;
  std::vector<ImuSample> imu;
  std::vector<AltitudeSample> altitudes;
  Configuration configuration;
};

using Said = std::map<int, inertial_homography_t>;  ///< by frame

/// What a test may do to a flight.
struct Plot {
  int back_at = kBackAt;  ///< below 0: the process is not killed
  bool deaf = false;      ///< what was kept does not reach the process that comes back
  std::function<void(filter_snapshot_t&)> forge;  ///< of the last state that was said, before it is offered
  std::function<void(int, visual_homography_t&)> deceive;
};

struct Heard {
  Said homographies;
  std::vector<filter_snapshot_t> states;
  int offers = 0;
  std::string log;
};

class Trial {
 public:
  Trial(const Sky& sky, const Plot& plot) : sky_(sky), plot_(plot) {
    bus_->subscribe<inertial_homography_t>(
        "INERTIAL_HOMOGRAPHY", 64, [&](const inertial_homography_t& m) { said_[frame_] = m; }, nullptr);
    bus_->subscribe<filter_snapshot_t>(
        "FILTER_SNAPSHOT", 64, [&](const filter_snapshot_t& m) { states_.push_back(m); }, nullptr);
    bus_->subscribe<filter_snapshot_t>(
        "WARM_START", 64, [&](const filter_snapshot_t&) { ++offers_; }, nullptr);
  }

  Heard fly() {
    const Listener log;
    fusion_ = std::make_unique<HomographyFusionNode>(*bus_, sky_.configuration);
    start(sky_.configuration);
    for (; frame_ < kFrames; ++frame_) {
      if (frame_ == kKilledAt && plot_.back_at > 0) kill();
      if (frame_ == plot_.back_at) comeBack();
      publishFrame();
    }
    return {said_, states_, offers_, log.heard()};
  }

 private:
  void start(const Configuration& configuration) {
    connection_ = std::make_unique<Connection>(*bus_);
    imu_ = std::make_unique<ImuIntegrationNode>(*connection_, configuration);
  }
  void kill() {
    connection_->cut = true;
    dead_ = {std::move(connection_), std::move(imu_)};  // the bus still points into it
  }
  void comeBack() {
    Configuration configuration = sky_.configuration;
    if (plot_.deaf) configuration.channels.warm_start = "NOWHERE";
    start(configuration);
    if (!plot_.forge) return;
    filter_snapshot_t forged = states_.back();
    plot_.forge(forged);
    bus_->publish("FILTER_SNAPSHOT", forged);
  }

  void publishFrame() {
    const int64_t utime = testing::frameTime(frame_);
    for (; imu_at_ < sky_.imu.size() && sky_.imu[imu_at_].utime <= utime + 15'000; ++imu_at_) {
      ins_t message{};
      message.utime = sky_.imu[imu_at_].utime;
      Eigen::Map<Eigen::Vector3d>(message.gyro) = sky_.imu[imu_at_].gyro;
      Eigen::Map<Eigen::Vector3d>(message.accel) = sky_.imu[imu_at_].accel;
      bus_->publish("IMU", message);
    }
    for (; altitude_at_ < sky_.altitudes.size() && sky_.altitudes[altitude_at_].utime <= utime;
         ++altitude_at_) {
      const AltitudeSample& a = sky_.altitudes[altitude_at_];
      bus_->publish("ALTIMETER", altimeter_t{a.utime, a.height_m, a.sigma_m});
    }
    image_t image{};
    image.utime = utime;
    bus_->publish("CAMERA", image);
    settle();
    bus_->publish("VISUAL_HOMOGRAPHY", vision());
    settle();
  }

  void settle() {
    do {
      if (imu_) imu_->process();
      fusion_->process();
    } while (bus_->handle(std::chrono::milliseconds(0)) > 0);
  }

  visual_homography_t vision() {
    constexpr double kNoise_px = 0.3;
    visual_homography_t message{};
    message.utime = testing::frameTime(frame_);
    message.utime_previous = testing::frameTime(std::max(0, frame_ - 1));
    message.sequence = frame_;
    message.status = frame_ > 0 ? 0 : 1;
    message.width = testing::kWidth;
    message.height = testing::kHeight;
    const HomographyObservation seen = testing::noisyHomography(
        frame_ > 0 ? sky_.homography(frame_) : Eigen::Matrix3d::Identity().eval(), kNoise_px, random_);
    fill(message.H, seen.H);
    fill(message.covariance, seen.covariance);
    message.inliers = 48;
    if (plot_.deceive) plot_.deceive(frame_, message);
    return message;
  }

  const Sky& sky_;
  const Plot& plot_;
  std::unique_ptr<Bus> bus_ = makeLcmBus("memq://");
  std::unique_ptr<HomographyFusionNode> fusion_;
  std::unique_ptr<Connection> connection_;
  std::unique_ptr<ImuIntegrationNode> imu_;
  Process dead_;
  std::mt19937 random_{7};
  int frame_ = 0;
  size_t imu_at_ = 0;
  size_t altitude_at_ = 0;
  Said said_;
  std::vector<filter_snapshot_t> states_;
  int offers_ = 0;
};

Heard fly(const Sky& sky, const Plot& plot = {}) { return Trial(sky, plot).fly(); }

struct Errors {
  double first_px = 0;   ///< of the first homography after the process is back
  double second_px = 0;  ///< mean over the second after that
  double height = 0;     ///< mean over the same, share of the true height
};

double error_px(const Sky& sky, const Said& said, int k) {
  return meanTransferError(matrix3(said.at(k).H), sky.homography(k), testing::kWidth, testing::kHeight);
}

Errors errorsFrom(const Sky& sky, const Said& said, int first) {
  Errors errors;
  errors.first_px = error_px(sky, said, first);
  for (int k = first + 1; k <= first + 24; ++k) {
    errors.second_px += error_px(sky, said, k) / 24;
    errors.height += std::abs(said.at(k).camera_height / sky.heightAt(k) - 1) / 24;
  }
  return errors;
}

void tell(const char* what, const Errors& e) {
  std::printf("%-16s first %.2f px, second after %.3f px, height %.1f %%\n", what, e.first_px, e.second_px,
              100 * e.height);
}

Errors operator+(const Errors& a, const Errors& b) {
  return {a.first_px + b.first_px, a.second_px + b.second_px, a.height + b.height};
}
Errors operator/(const Errors& a, double n) { return {a.first_px / n, a.second_px / n, a.height / n}; }

TEST(WarmStart, ARestartedProcessKnowsWhatTheFlightHasLearned) {
  Errors before;
  Errors without;
  Errors with;
  constexpr int kFlights = 6;
  for (unsigned seed = 1; seed <= kFlights; ++seed) {
    const Sky sky(seed);
    Plot deaf;
    deaf.deaf = true;
    const Heard kept = fly(sky);
    EXPECT_NE(kept.log.find("goes on from the kept state"), std::string::npos) << kept.log;
    before = before + errorsFrom(sky, kept.homographies, kKilledAt - 25);
    with = with + errorsFrom(sky, kept.homographies, kBackAt + 1);
    without = without + errorsFrom(sky, fly(sky, deaf).homographies, kBackAt + 1);
  }
  before = before / kFlights;
  with = with / kFlights;
  without = without / kFlights;
  tell("before", before);
  tell("not kept", without);
  tell("kept", with);
  EXPECT_GT(without.height, 0.2) << "there was nothing to win";
  EXPECT_LT(with.height, 0.1);
  EXPECT_LT(with.first_px, 0.6 * without.first_px);
  EXPECT_LT(with.second_px, 0.6 * without.second_px);
}

struct Forgery {
  const char* name;
  std::function<void(filter_snapshot_t&)> forge;
  const char* said;
};

class ForgedState : public ::testing::TestWithParam<Forgery> {};

TEST_P(ForgedState, ChangesNothingAndIsSaid) {
  static const Sky sky(1);
  static const Heard without = [] {
    Plot deaf;
    deaf.deaf = true;
    return fly(sky, deaf);
  }();
  Plot plot;
  plot.forge = GetParam().forge;
  const Heard heard = fly(sky, plot);
  EXPECT_NE(heard.log.find(GetParam().said), std::string::npos) << heard.log;
  for (int k = kBackAt; k < kFrames; ++k) {
    EXPECT_EQ(encodeMessage(heard.homographies.at(k)), encodeMessage(without.homographies.at(k))) << k;
  }
}

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

INSTANTIATE_TEST_SUITE_P(
    Each, ForgedState,
    ::testing::Values(
        Forgery{"Stale", [](auto& m) { m.utime -= 5'000'000; }, "too old"},
        Forgery{"FromTheFuture", [](auto& m) { m.utime += 5'000'000; }, "from the future"},
        Forgery{"OfAnAbsurdTime", [](auto& m) { m.utime = std::numeric_limits<int64_t>::min(); },
                "implausible"},
        Forgery{"OfAnotherConfiguration", [](auto& m) { m.configuration[0] ^= 1; }, "another configuration"},
        Forgery{"HeightNaN", [](auto& m) { m.height = kNaN; }, "implausible"},
        Forgery{"HeightOfASatellite", [](auto& m) { m.height = 4e5; }, "implausible"},
        Forgery{"BelowTheGround", [](auto& m) { m.height = -3; }, "implausible"},
        Forgery{"HeightSigmaNaN", [](auto& m) { m.height_sigma = kNaN; }, "implausible"},
        Forgery{"HeightSigmaZero", [](auto& m) { m.height_sigma = 0; }, "implausible"},
        Forgery{"HeightUnknown", [](auto& m) { m.height_sigma = 2 * m.height; }, "implausible"},
        Forgery{"UpIsNoDirection", [](auto& m) { m.up[0] = 0.5; }, "implausible"},
        Forgery{"UpSigmaNaN", [](auto& m) { m.up_sigma[1] = kNaN; }, "implausible"},
        Forgery{"VelocityInfinite", [](auto& m) { m.velocity[1] = kInfinity; }, "implausible"},
        Forgery{"VelocitySigmaNegative", [](auto& m) { m.velocity_sigma[0] = -1; }, "implausible"},
        Forgery{"GyroBiasAbsurd", [](auto& m) { m.gyro_bias[2] = 3; }, "implausible"},
        Forgery{"AccelBiasNaN", [](auto& m) { m.accel_bias[2] = kNaN; }, "implausible"},
        Forgery{"AccelBiasSigmaAbsurd", [](auto& m) { m.accel_bias_sigma[0] = 1e30; }, "implausible"},
        Forgery{"MountingIsNoRotation", [](auto& m) { m.R_CI[4] += 0.5; }, "implausible"},
        Forgery{"MountingOfAnotherCamera", [](auto& m) { fill(m.R_CI, Eigen::Matrix3d::Identity().eval()); },
                "implausible"}),
    [](const auto& each) { return each.param.name; });

/// Else a process that dies as soon as it is started would overwrite what was known.
TEST(WarmStart, IsNotSaidBeforeAnythingWasLearned) {
  const Sky sky(1);
  Plot deaf;
  deaf.deaf = true;
  for (const filter_snapshot_t& state : fly(sky, deaf).states) {
    EXPECT_TRUE(state.utime < testing::frameTime(kKilledAt) ||
                state.utime > testing::frameTime(kBackAt + 12));
    EXPECT_GT(state.utime, testing::frameTime(12));
  }
}

TEST(WarmStart, ServesForSecondsAndNoLonger) {
  const Sky sky(1);
  Plot plot;
  plot.back_at = kKilledAt + 40;
  const Heard after_less_than_two = fly(sky, plot);
  EXPECT_NE(after_less_than_two.log.find("goes on from"), std::string::npos) << after_less_than_two.log;
  tell("1.7 s later", errorsFrom(sky, after_less_than_two.homographies, plot.back_at + 1));
  plot.back_at = kKilledAt + 56;
  const Heard after_more = fly(sky, plot);
  EXPECT_NE(after_more.log.find("too old"), std::string::npos) << after_more.log;
}

/// One machine flies, the other replays its recording: nothing is offered where nobody has died.
TEST(WarmStart, IsOfferedToNobodyWhereNobodyDies) {
  const Sky sky(1);
  Plot nobody;
  nobody.back_at = -1;
  const Heard heard = fly(sky, nobody);
  EXPECT_EQ(heard.log, "");
  EXPECT_GT(heard.states.size(), 300U);
  EXPECT_EQ(heard.offers, 0);
}

/// A filter that has gone wrong is contradicted by vision: its state must not outlive it.
TEST(WarmStart, WhatVisionContradictsIsNotSaid) {
  const Sky sky(1);
  constexpr int kWrongFrom = 180;
  Plot plot;
  plot.deceive = [](int k, visual_homography_t& m) {
    if (k < kWrongFrom) return;
    // A image that turns to and fro as the gyro says it does not.
    const Eigen::Vector3d roll(0, 0, k % 2 == 0 ? 0.5 : -0.5);
    const Eigen::Matrix3d K = testing::testCamera().K();
    fill(m.H, normaliseHomography(K * expSO3(roll) * K.inverse() * matrix3(m.H)));
  };
  const Heard heard = fly(sky, plot);
  int after = 0;
  for (const filter_snapshot_t& state : heard.states) {
    after += state.utime > testing::frameTime(kWrongFrom + 1) && state.utime < testing::frameTime(kKilledAt);
  }
  EXPECT_GT(heard.states.size(), 150U);
  EXPECT_EQ(after, 0);
  EXPECT_NE(heard.log.find("too old"), std::string::npos) << heard.log;
}

/// Plausible, and yet wrong by a factor of two: no test tells. It costs no more than a wrong configuration.
TEST(WarmStart, AWrongHeightThatCouldBeRightIsCorrected) {
  for (const bool altimeter : {false, true}) {
    const Sky sky(2, altimeter);
    Plot plot;
    plot.forge = [](filter_snapshot_t& m) { m.height *= 2; };
    const Heard heard = fly(sky, plot);
    const Errors errors = errorsFrom(sky, heard.homographies, kBackAt + 1);
    tell(altimeter ? "twice, altimeter" : "twice as high", errors);
    EXPECT_LT(errors.second_px, 0.5);
    if (altimeter) {
      EXPECT_NEAR(heard.homographies.at(kFrames - 1).camera_height, sky.heightAt(kFrames - 1), 0.3);
    }
  }
}

}  // namespace
}  // namespace redbee::test
