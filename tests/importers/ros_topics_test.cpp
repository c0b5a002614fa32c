// Which topics are taken, and what is said where that is not clear.
#include "redbee/importers/ros/ros_topics.hpp"

#include <gtest/gtest.h>

#include "tests/support/log_events.hpp"

namespace redbee::test {
namespace {

RosTopic topic(const std::string& name, const std::string& type) {
  return {name, type, RosEncoding::kCdr, 3};
}

TEST(RosTopics, NamesFromAFileDoNotReachATerminalRaw) {
  const std::vector<RosTopic> topics{topic("/a\x1b]0;title\x07\n", "x/\x9b"), topic("/\u00fc\u009b", "y")};
  const std::string line = errorMessageOf([&] { chooseRosTopics(topics, {}, "f.bag"); });
  EXPECT_NE(line.find("/a\\x1b]0;title\\x07\\x0a (3 x/\\x9b), /\u00fc\\xc2\\x9b (3 y)"), std::string::npos)
      << line;
}

TEST(RosTopics, TheFirstTenAreListed) {
  std::vector<RosTopic> topics;
  for (int i = 0; i < 14; ++i) topics.push_back(topic("/t" + std::to_string(i), "t"));
  const std::string line = errorMessageOf([&] { chooseRosTopics(topics, {}, "f.bag"); });
  EXPECT_NE(line.find("/t9 (3 t) and 4 more"), std::string::npos) << line;
  EXPECT_EQ(line.find("/t10"), std::string::npos) << line;
}

}  // namespace
}  // namespace redbee::test
