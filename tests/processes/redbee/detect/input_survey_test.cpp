#include "processes/redbee/detect/input_survey.hpp"

#include <gmock/gmock.h>

#include "tests/support/camera.hpp"
#include "tests/support/sensor_messages.hpp"

namespace redbee::test {
namespace {

/// Of a log whose LENS states focal lengths from 500 px to `longest` times as much; 0: it has none.
std::vector<std::string> warningsAbout(double longest, bool is_enabled) {
  Configuration configuration;
  configuration.camera = intrinsics();
  configuration.has_imu = false;
  configuration.inertial.lens.enabled = is_enabled;
  InputSurvey survey(configuration);
  for (int k = 0; longest > 0 && k <= 10; ++k) {
    const ImuTime time(std::chrono::milliseconds(100 * k));
    const SensorMessage sent =
        encoded(message(LensSample{time, 1 + 0.1 * k * (longest - 1)}, 1000, 2 * kWidth));
    LogEvent event;
    event.channel = sent.channel;
    event.data = sent.data;
    survey.add(event);
  }
  return survey.warnings();
}

TEST(InputSurvey, SaysWhereLensAndConfigurationContradictEachOther) {
  using testing::ElementsAre;
  using testing::HasSubstr;
  using testing::IsEmpty;
  EXPECT_THAT(warningsAbout(2, true), IsEmpty());
  EXPECT_THAT(warningsAbout(0, false), IsEmpty());
  EXPECT_THAT(warningsAbout(1.01, false), IsEmpty());
  EXPECT_THAT(warningsAbout(2, false), ElementsAre(HasSubstr("from 500 to 1000 px")));
  EXPECT_THAT(warningsAbout(0, true), ElementsAre(HasSubstr("holds no message on LENS")));
}

}  // namespace
}  // namespace redbee::test
