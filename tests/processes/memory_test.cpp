// What the stack holds does not grow with the flight. Resident memory says less: it rises while the allocator
// fills its arenas, and is the business of tests/soak.
#include <gtest/gtest.h>

#include "tests/support/allocated_bytes.hpp"
#include "tests/support/fault_trial.hpp"

namespace redbee::test {
namespace {

/// The flight's images forth and back, again and again, by vision alone.
class Pendulum {
 public:
  Pendulum() : bus_(makeLcmBus("memq://")), stack_(*bus_, configuration()) {
    for (const SensorMessage& sent : undisturbedFlight().messages) {
      image_t image;
      if (sent.channel != "CAMERA") continue;
      if (!decodeMessage(sent.data.data(), static_cast<int>(sent.data.size()), image))
        throw std::logic_error("the simulated flight holds a message that does not decode");
      images_.push_back(image);
    }
    period_us_ = images_[1].utime - images_[0].utime;
    utime_ = images_[0].utime;
  }

  void swing() {
    const int last = static_cast<int>(images_.size()) - 1;
    for (int k = 0; k < last; ++k) send(k);
    for (int k = last; k > 0; --k) send(k);
  }

 private:
  static Configuration configuration() {
    Configuration configuration = undisturbedFlight().configuration;
    configuration.has_imu = configuration.has_altimeter = false;
    return configuration;
  }
  void send(int k) {
    image_t& image = images_[static_cast<size_t>(k)];
    image.utime = utime_ += period_us_;
    bus_->publish("CAMERA", image);
    stack_.settle();
  }

  std::unique_ptr<Bus> bus_;
  InProcessStack stack_;
  std::vector<image_t> images_;
  int64_t period_us_ = 0;
  int64_t utime_ = 0;
};

TEST(Memory, DoesNotGrowWithTheFlight) {
  Pendulum pendulum;
  pendulum.swing();
  pendulum.swing();
  const int64_t before = allocatedBytes();
  constexpr int kSwings = 4;
  for (int i = 0; i < kSwings; ++i) pendulum.swing();
  const auto frames = kSwings * 2 * (kFaultFrames - 1);
  const int64_t grown = allocatedBytes() - before;
  std::printf("%lld bytes after %d frames\n", static_cast<long long>(grown), frames);
  // A tenth of one image of vision's for each second.
  EXPECT_LT(grown, frames / 24 * kFaultWidth * kFaultHeight / 10);
}

}  // namespace
}  // namespace redbee::test
