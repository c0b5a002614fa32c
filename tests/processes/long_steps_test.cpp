// Frames far apart, for long without vision: what the inertial process and the fusion then say of the motion
// is either of use or marked as of none, and never a message that its readers refuse as damaged.
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <random>

#include "processes/conversions.hpp"
#include "processes/homography_fusion/node.hpp"
#include "processes/imu_integration/node.hpp"
#include "redbee/node/message_check.hpp"
#include "tests/support/consumer_imu.hpp"
#include "tests/support/noisy_homography.hpp"
#include "tests/support/sensor_messages.hpp"
#include "tests/support/simulated_flight.hpp"

namespace redbee::test {
namespace {

using Step = std::function<double(std::mt19937&)>;  ///< s, to the next frame

/// How vision takes part.
enum class Vision { kNever, kEverySecondFrame };

struct Outcome {
  int inertial = 0;   ///< messages with a homography
  int uncertain = 0;  ///< that say why they have none
  int fused = 0;
  std::vector<std::string> refused;  ///< the faults of messages
};

class LongSteps {
 public:
  LongSteps(double height_m, unsigned seed)
      : flight_(simulation::Trajectory::ordinary(seed, height_m), mountedCamera(height_m), kStart),
        samples_(flight_.imu(ConsumerImu(seed), kEnd_s + 0.5)),
        random_(seed) {
    configuration_.camera = intrinsics();
    subscriptions_.push_back(bus_->subscribe<inertial_homography_t>(
        "INERTIAL_HOMOGRAPHY", 64, [&](const inertial_homography_t& m) {
          note(m);
          outcome_.inertial += m.valid;
          outcome_.uncertain += m.status == inertial_homography_t::UNCERTAIN ? 1 : 0;
        }));
    subscriptions_.push_back(
        bus_->subscribe<fused_homography_t>("FUSED_HOMOGRAPHY", 64, [&](const fused_homography_t& m) {
          note(m);
          outcome_.fused += m.source != fused_homography_t::NONE ? 1 : 0;
        }));
  }

  Outcome fly(const Step& step, Vision vision) {
    inertial_ = std::make_unique<ImuIntegrationNode>(*bus_, configuration_);
    fusion_ = std::make_unique<HomographyFusionNode>(*bus_, configuration_);
    CameraTime before = kStart;
    int k = 0;
    for (CameraTime time = kStart; time < kStart + fromSeconds(kEnd_s); ++k) {
      send(before, time, vision == Vision::kEverySecondFrame && k % 2 == 1);
      before = time;
      time += fromSeconds(step(random_));
    }
    return outcome_;
  }

 private:
  static constexpr double kEnd_s = 30;

  template <typename Message>
  void note(const Message& message) {
    if (const char* fault = faultOf(message)) outcome_.refused.emplace_back(fault);
  }

  void send(CameraTime before, CameraTime time, bool is_seen) {
    for (; next_ < samples_.size() && samples_[next_].time <= toImu(time, std::chrono::milliseconds(15));
         ++next_) {
      bus_->publish("IMU", message(samples_[next_]));
    }
    image_t image{};
    image.utime = toUtime(time);
    image.width = kWidth;
    image.height = kHeight;
    bus_->publish("CAMERA", image);
    settle();
    bus_->publish("VISUAL_HOMOGRAPHY", vision(before, time, is_seen));
    settle();
  }

  visual_homography_t vision(CameraTime before, CameraTime time, bool is_seen) {
    visual_homography_t m{};
    m.utime = toUtime(time);
    m.utime_previous = toUtime(before);
    m.sequence = sequence_++;
    m.status = is_seen ? visual_homography_t::GOOD : visual_homography_t::NO_TEXTURE;
    m.width = kWidth;
    m.height = kHeight;
    m.inliers = is_seen ? 48 : 0;
    const HomographyObservation seen = noisyHomography(flight_.homography(before, time), 0.3, random_);
    if (is_seen) fill(m.ground, seen.H, seen.covariance);
    return m;
  }

  void settle() {
    do {
      inertial_->process();
      fusion_->process();
    } while (bus_->handle(std::chrono::milliseconds(0)) > 0);
  }

  SimulatedFlight flight_;
  std::vector<ImuSample> samples_;
  std::mt19937 random_;
  Configuration configuration_;
  std::unique_ptr<Bus> bus_ = makeLcmBus("memq://");
  std::unique_ptr<ImuIntegrationNode> inertial_;
  std::unique_ptr<HomographyFusionNode> fusion_;
  std::vector<Subscription> subscriptions_;
  Outcome outcome_;
  size_t next_ = 0;
  int32_t sequence_ = 0;
};

double uniform(std::mt19937& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

const Step kAllLong = [](std::mt19937&) { return 0.9; };
const Step kLongOfAllLengths = [](std::mt19937& random) { return uniform(random, 0.3, 0.9); };
/// A quick camera that pauses: the state is uncertain, and its next step is short.
const Step kPauses = [](std::mt19937& random) {
  return uniform(random, 0, 1) < 0.1 ? uniform(random, 0.1, 1.9) : 0.005;
};

void expectNoneRefused(const Step& step, Vision vision) {
  Outcome all;
  for (const double height_m : {2.0, 8.0, 120.0}) {
    for (const unsigned seed : {1U, 2U}) {
      const Outcome outcome = LongSteps(height_m, seed).fly(step, vision);
      for (const std::string& fault : outcome.refused)
        ADD_FAILURE() << "refused for " << fault << ", " << height_m << " m up";
      all.inertial += outcome.inertial;
      all.uncertain += outcome.uncertain;
      all.fused += outcome.fused;
    }
  }
  std::printf("%d inertial homographies, %d times too uncertain, %d fused\n", all.inertial, all.uncertain,
              all.fused);
  EXPECT_GT(all.inertial, 0);
}

TEST(LongSteps, LeaveNoMessageThatIsRefused) {
  expectNoneRefused(kAllLong, Vision::kNever);
  expectNoneRefused(kLongOfAllLengths, Vision::kNever);
  expectNoneRefused(kAllLong, Vision::kEverySecondFrame);
}

TEST(LongSteps, LeaveNoneWhereTheNextOnesAreShort) {
  expectNoneRefused(kPauses, Vision::kNever);
  expectNoneRefused(kPauses, Vision::kEverySecondFrame);
}

}  // namespace
}  // namespace redbee::test
