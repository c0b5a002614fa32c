#include "processes/redbee/vehicle/doctor.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "processes/redbee/vehicle/sender_rule.hpp"
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

/// What `nft -j list ruleset` of nftables 1.0.6 prints of a chain on `hook` with one rule.
std::string ruleset(const std::string& hook, const std::string& expressions) {
  return R"({"nftables": [{"metainfo": {"version": "1.0.6", "json_schema_version": 1}},
    {"table": {"family": "inet", "name": "redbee", "handle": 1}},
    {"chain": {"family": "inet", "table": "redbee", "name": "output", "handle": 1, "type": "filter", "hook": ")" +
         hook + R"(", "prio": 0, "policy": "accept"}},
    {"rule": {"family": "inet", "table": "redbee", "chain": "output", "handle": 2, "expr": [)" +
         expressions + "]}}]}";
}

TEST(Doctor, FindsTheRuleThatKeepsOthersFromSending) {
  const std::string port =
      R"({"match": {"op": "==", "left": {"payload": {"protocol": "udp", "field": "dport"}}, "right": 7667}},)";
  const std::string user = R"({"match": {"op": "!=", "left": {"meta": {"key": "skuid"}}, "right": 0}},)";
  const std::string drop = R"({"drop": null})";
  EXPECT_EQ(onlySender(ruleset("output", port + user + drop), 7667), "0");
  EXPECT_FALSE(onlySender(ruleset("output", port + user + drop), 7668)) << "another port";
  EXPECT_FALSE(onlySender(ruleset("input", port + user + drop), 7667)) << "there no user is known";
  EXPECT_FALSE(onlySender(ruleset("output", port + user + R"({"accept": null})"), 7667));
  EXPECT_FALSE(onlySender(ruleset("output", port + drop), 7667));
  EXPECT_FALSE(onlySender(ruleset("output", R"({"limit": {"rate": 1}},)" + port + user + drop), 7667))
      << "a rule that does not always hold";
  for (const char* other : {"", "{", "[]", R"({"nftables": []})"}) EXPECT_FALSE(onlySender(other, 7667));
  EXPECT_EQ(portOf("udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304"), 7667);
  EXPECT_FALSE(portOf("memq://"));

  StackNetwork network{42, true, NetworkOwner::kHost};
  network.only_sender = "redbee";
  const Finding finding = findNetwork(network, true);
  EXPECT_TRUE(finding.good);
  EXPECT_NE(finding.what.find("every user but redbee"), std::string::npos) << finding.what;
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
