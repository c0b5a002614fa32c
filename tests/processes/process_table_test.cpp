// The process table agrees with what it describes: programs, nodes, configuration keys.
#include "redbee/configuration/process_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <vector>

#include "processes/node_factory.hpp"
#include "processes/redbee/vehicle/supervisor_configuration.hpp"
#include "redbee/configuration/drivers.hpp"

namespace redbee {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(ProcessTable, HasEveryProgramAndNoOther) {
  std::set<std::string> folders;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(REDBEE_SOURCE_DIR) / "processes")) {
    if (std::filesystem::exists(entry.path() / "main.cpp")) folders.insert(entry.path().filename());
  }
  std::set<std::string> expected{"redbee"};
  const auto expectFolder = [&](const ProcessDescription* process) {
    std::string folder(process->name);
    std::replace(folder.begin(), folder.end(), '-', '_');
    expected.insert(folder);
  };
  std::for_each(kStages.begin(), kStages.end(), expectFolder);
  std::for_each(kDrivers.begin(), kDrivers.end(), expectFolder);
  EXPECT_EQ(folders, expected);
}

TEST(ProcessTable, EveryStageHasANodeOfItsName) {
  Configuration configuration;
  configuration.camera = {640, 480, 500, 500, 319.5, 239.5, {}};
  for (const ProcessDescription* stage : kStages) {
    const auto bus = makeLcmBus("memq://");
    EXPECT_EQ(makeNode(*stage, *bus, configuration)->health().process(), programName(*stage));
  }
  const auto bus = makeLcmBus("memq://");
  EXPECT_THROW(makeNode(kWatch, *bus, configuration), std::invalid_argument);
}

TEST(ProcessTable, NamesOnlyKeysOfTheConfiguration) {
  const auto keys = configurationKeys();
  const auto expectKey = [&](const std::string& section, std::string_view key) {
    EXPECT_THAT(keys, testing::Contains(section + "." + std::string(key)));
  };
  for (const ProcessDescription* stage : kStages) {
    if (!stage->timeout.empty()) expectKey("waits", stage->timeout);
    for (const KeyList& list : {stage->publishes, stage->waits_for, stage->waits_for_previous}) {
      for (const std::string_view key : list) expectKey("channels", key);
    }
  }
  for (const ProcessDescription* driver : kDrivers) {
    for (const std::string_view key : driver->publishes) expectKey("channels", key);
  }
}

TEST(ProcessTable, DriversFlyOnlyWhereTheyAreConfigured) {
  Configuration configuration;
  EXPECT_TRUE(configuredDrivers(configuration).empty());
  EXPECT_THAT(supervisorConfiguration(configuredDrivers(configuration)),
              Not(HasSubstr("[program:autopilot]")));
  configuration.autopilot.link = "udp:127.0.0.1:14540";
  EXPECT_THAT(supervisorConfiguration(configuredDrivers(configuration)),
              HasSubstr("\"$REDBEE_BIN/redbee-autopilot\" --config \"$REDBEE_CONFIG\""));
  EXPECT_THAT(supervisorConfiguration(configuredDrivers(configuration)), Not(HasSubstr("[program:serve]")));
  configuration.serve.listen = "unix:serve.sock";
  EXPECT_THAT(supervisorConfiguration(configuredDrivers(configuration)),
              HasSubstr("nice -n 10 \"$REDBEE_BIN/redbee-serve\" --config \"$REDBEE_CONFIG\""));
}

TEST(ProcessTable, SupervisorRunsAllOfIt) {
  const std::string text = supervisorConfiguration();
  for (const ProcessDescription* stage : kStages) {
    EXPECT_THAT(text, HasSubstr("[program:" + std::string(stage->name) + "]\n"));
    EXPECT_THAT(text, HasSubstr("\"$REDBEE_BIN/" + programName(*stage) + "\" --config \"$REDBEE_CONFIG\""));
  }
  EXPECT_THAT(text, HasSubstr("\"$REDBEE_BIN/redbee\" watch --config"));
  EXPECT_THAT(text, HasSubstr("nice -n 5 \"$REDBEE_BIN/redbee\" record --out"));
  EXPECT_THAT(text, HasSubstr("autostart=%(ENV_REDBEE_RECORD)s"));
}

}  // namespace
}  // namespace redbee
