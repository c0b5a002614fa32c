#include "processes/redbee/vehicle/doctor.hpp"

#include <gtest/gtest.h>

namespace redbee {
namespace {

constexpr const char* kInProcess = "memq://";

TEST(Doctor, EveryFailedCheckHasAFix) {
  DoctorOptions options;
  options.url = kInProcess;
  options.listen_s = 0.05;
  std::vector<Finding> findings = findSensors(options);
  findings.push_back(findReceiveBuffer("udpm://239.255.76.67:7667?ttl=0&recv_buf_size=2000000000"));
  for (const Finding& finding : findings) {
    EXPECT_FALSE(finding.good) << finding.what;
    EXPECT_FALSE(finding.fix.empty()) << finding.what;
    EXPECT_EQ(finding.what.find('\n'), std::string::npos);
  }
}

TEST(Doctor, ASilentCameraIsNamed) {
  DoctorOptions options;
  options.url = kInProcess;
  options.camera_channel = "NOSE_CAMERA";
  options.listen_s = 0.05;
  const auto findings = findSensors(options);
  ASSERT_EQ(findings.size(), 2u);
  EXPECT_NE(findings[0].what.find("NOSE_CAMERA"), std::string::npos);
}

TEST(Doctor, AnUrlThatLcmCannotOpenIsAFindingNotACrash) { EXPECT_FALSE(findMulticast("nonsense://").good); }

}  // namespace
}  // namespace redbee
