// One process of the stack is away: never started, killed, or hanging. What is left of the flight.
#include <gtest/gtest.h>

#include "tests/support/killable_stack.hpp"
#include "tests/support/trusted_frames.hpp"

namespace redbee::test {
namespace {

constexpr int kGoneAt = 40;

enum class Absence { kNeverStarted, kKilled, kHanging };

TrustedFrames flyWithout(const ProcessDescription& stage, Absence absence) {
  const StackFlight& flight = undisturbedFlight();
  const auto bus = makeLcmBus("memq://");
  StackOutput output;
  const std::vector<Subscription> subscriptions = output.subscribe(*bus);
  KillableStack stack(*bus, flight.configuration);
  if (absence == Absence::kNeverStarted) stack.kill(stage);
  int frame = -1;
  for (const SensorMessage& sent : flight.messages) {
    if (sent.channel == "CAMERA" && ++frame == kGoneAt) {
      if (absence == Absence::kKilled) stack.kill(stage);
      if (absence == Absence::kHanging) stack.hang(stage);
    }
    bus->publish(sent.channel, sent.data);
    stack.settle();
  }
  stack.finish();
  return trustedFrames(output, flight, {}, absence == Absence::kNeverStarted ? kLearningFrames : kGoneAt);
}

void expectMostAreTrusted(const ProcessDescription& stage, double fraction) {
  const struct {
    const char* name;
    Absence absence;
  } kinds[] = {{"never started", Absence::kNeverStarted},
               {"killed", Absence::kKilled},
               {"hanging", Absence::kHanging}};
  for (const auto& kind : kinds) {
    const TrustedFrames frames = flyWithout(stage, kind.absence);
    frames.print((std::string(stage.name) + " " + kind.name).c_str());
    EXPECT_GE(frames.trusted, fraction * frames.expected) << stage.name << " " << kind.name;
    EXPECT_EQ(frames.wild, 0) << stage.name << " " << kind.name;
  }
}

TEST(Absence, WithoutTheInertialProcessVisionIsLeft) { expectMostAreTrusted(kImuIntegration, 0.95); }
TEST(Absence, WithoutTheFusionVisionIsLeft) { expectMostAreTrusted(kHomographyFusion, 0.95); }
TEST(Absence, WithoutVisionNoMaskIsWild) { expectMostAreTrusted(kVisualHomography, 0); }

}  // namespace
}  // namespace redbee::test
