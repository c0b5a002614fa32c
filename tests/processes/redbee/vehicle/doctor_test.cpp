#include "processes/redbee/vehicle/doctor.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "processes/redbee/vehicle/stack_network.hpp"
#include "tests/support/scratch_folder.hpp"

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

TEST(Doctor, SaysWhoCanHearTheStack) {
  const std::vector<std::pair<StackNetwork, bool>> known{{{42, true, NetworkOwner::kStack}, true},
                                                         {{42, true, NetworkOwner::kHost}, false},
                                                         {{std::nullopt, true, NetworkOwner::kHost}, false},
                                                         {{42, false, NetworkOwner::kUnknown}, false}};
  for (const auto& [network, good] : known) {
    const Finding finding = findNetwork(network, true);
    EXPECT_EQ(finding.good, good) << finding.what;
    EXPECT_EQ(finding.fix.empty(), good) << finding.what;
  }
  EXPECT_FALSE(findNetwork({42, false, NetworkOwner::kStack}, false).good)
      << "what follows is about another network";
}

TEST(Doctor, AStackThatIsNotUpHasNoSupervisor) {
  const test::ScratchFolder folder;
  EXPECT_FALSE(stackNetwork(folder / "supervisord.pid").supervisor);
  test::writeText(folder / "supervisord.pid", "67108863\n");  // above any pid_max
  EXPECT_FALSE(stackNetwork(folder / "supervisord.pid").supervisor);
  test::writeText(folder / "supervisord.pid", std::to_string(getpid()) + "\n");
  const StackNetwork network = stackNetwork(folder / "supervisord.pid");
  EXPECT_EQ(network.supervisor, getpid());
  EXPECT_TRUE(network.is_ours);
}

TEST(Doctor, AnUrlThatLcmCannotOpenIsAFindingNotACrash) { EXPECT_FALSE(findMulticast("nonsense://").good); }

}  // namespace
}  // namespace redbee
