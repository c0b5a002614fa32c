#include "processes/redbee/vehicle/supervisor_client.hpp"

#include <gtest/gtest.h>

namespace redbee {
namespace {

/// As supervisor 4.2.5 answers.
std::string structOf(const std::string& name, const std::string& state, const std::string& pid) {
  return "<value><struct>\n<member>\n<name>name</name>\n<value><string>" + name +
         "</string></value>\n</member>\n<member>\n<name>group</name>\n<value><string>" + name +
         "</string></value>\n</member>\n<member>\n<name>statename</name>\n<value><string>" + state +
         "</string></value>\n</member>\n<member>\n<name>pid</name>\n<value><int>" + pid +
         "</int></value>\n</member>\n</struct></value>\n";
}

std::string responseOf(const std::string& structs) {
  return "HTTP/1.0 200 OK\r\nContent-Type: text/xml\r\n\r\n<?xml "
         "version='1.0'?>\n<methodResponse>\n<params>\n"
         "<param>\n<value><array><data>\n" +
         structs + "</data></array></value>\n</param>\n</params>\n</methodResponse>\n";
}

TEST(SupervisorClient, ReadsNameStateAndNumber) {
  const auto processes =
      parseProcessInfo(responseOf(structOf("watch", "RUNNING", "12") + structOf("record", "STOPPED", "0") +
                                  structOf("visual-homography", "STOPPING", "14")));
  ASSERT_TRUE(processes.has_value());
  ASSERT_EQ(processes->size(), 2u) << "one has no process";
  EXPECT_EQ(processes->at(0).name, "watch");
  EXPECT_EQ(processes->at(0).pid, 12);
  EXPECT_TRUE(processes->at(0).is_up);
  EXPECT_EQ(processes->at(1).pid, 14);
  EXPECT_FALSE(processes->at(1).is_up);
}

TEST(SupervisorClient, AnIncompleteAnswerIsNone) {
  const std::string whole = responseOf(structOf("watch", "RUNNING", "12"));
  for (size_t size = 0; size + 20 < whole.size(); ++size)
    EXPECT_FALSE(parseProcessInfo(whole.substr(0, size)).has_value()) << size;
  EXPECT_FALSE(parseProcessInfo(responseOf(structOf("watch", "RUNNING", "12x"))).has_value());
  EXPECT_FALSE(parseProcessInfo(responseOf(structOf("", "RUNNING", "12"))).has_value());
  EXPECT_FALSE(parseProcessInfo("<methodResponse><fault></fault></methodResponse>").has_value());
}

TEST(SupervisorClient, NobodyThereIsNoAnswer) {
  EXPECT_FALSE(SupervisorClient("/nonexistent/supervisor.sock").processes().has_value());
  EXPECT_FALSE(SupervisorClient(std::string(500, 'x')).processes().has_value());
}

}  // namespace
}  // namespace redbee
