#include "processes/redbee/commands/command.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace redbee {
namespace {

struct ToolOutput {
  int exit_code = 0;
  std::string out;
  std::string error;
};

ToolOutput run(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "redbee");
  std::vector<char*> argv;
  argv.reserve(arguments.size());
  for (std::string& argument : arguments) argv.push_back(argument.data());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  ToolOutput output;
  output.exit_code = runTool(static_cast<int>(argv.size()), argv.data());
  output.out = testing::internal::GetCapturedStdout();
  output.error = testing::internal::GetCapturedStderr();
  return output;
}

class EnvironmentVariable {
 public:
  EnvironmentVariable(const char* name, const char* value) : name_(name) { setenv(name, value, 1); }
  ~EnvironmentVariable() { unsetenv(name_); }
  EnvironmentVariable(const EnvironmentVariable&) = delete;
  EnvironmentVariable& operator=(const EnvironmentVariable&) = delete;

 private:
  const char* name_;
};

TEST(CommandLine, HelpListsEveryCommand) {
  const ToolOutput help = run({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* name :
       {"calibrate", "collect", "compare", "configuration", "detect", "doctor", "evaluate", "import", "log",
        "overlay", "record", "reference-extrinsics", "report", "simulate", "top", "try", "watch"}) {
    EXPECT_NE(help.out.find(std::string("\n  ") + name + " "), std::string::npos) << name;
    if (std::string(name) == "calibrate") continue;  // replaces the process
    const ToolOutput own = run({name, "--help"});
    EXPECT_EQ(own.exit_code, 0) << name;
    EXPECT_NE(own.out.find("--help"), std::string::npos) << name;
  }
}

/// Output and exit code of the installed form of the tool, for commands that are programs of their own.
ToolOutput runProgram(const std::string& arguments) {
  ToolOutput output;
  FILE* pipe = popen((REDBEE_BINARY_DIR "/bin/redbee " + arguments + " 2>&1").c_str(), "r");
  std::array<char, 256> part{};
  while (std::fgets(part.data(), part.size(), pipe) != nullptr) output.out += part.data();
  output.exit_code = WEXITSTATUS(pclose(pipe));
  return output;
}

TEST(CommandLine, AProgramOfItsOwnTakesTheCommandsArguments) {
  const ToolOutput help = runProgram("calibrate --help");
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_NE(help.out.find("--log"), std::string::npos) << help.out;
  const ToolOutput bad = runProgram("calibrate --config vehicle.yaml --out folder --no-such-option");
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_NE(bad.out.find("--no-such-option"), std::string::npos) << bad.out;
  EXPECT_EQ(bad.out.find('\n'), bad.out.size() - 1) << bad.out;
}

TEST(CommandLine, BadUseExitsWith2AndOneLine) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{}, {"nonsense"}, {"detect"}, {"detect", "--no-such-option"}}) {
    const ToolOutput output = run(arguments);
    EXPECT_EQ(output.exit_code, 2);
    EXPECT_EQ(output.error.find('\n'), output.error.size() - 1) << output.error;
    EXPECT_EQ(output.out, "");
  }
}

/// `redbee log info flight.lcm.*`, of a flight in many parts.
TEST(CommandLine, ManyArgumentsTooManyAreNotAllRepeated) {
  std::vector<std::string> arguments{"log", "info"};
  for (int part = 0; part < 120; ++part) arguments.push_back("flight.lcm." + std::to_string(part));
  const ToolOutput output = run(arguments);
  EXPECT_EQ(output.exit_code, 2);
  EXPECT_NE(output.error.find("were not expected: flight.lcm."), std::string::npos) << output.error;
  EXPECT_NE(output.error.find("... (see redbee --help)"), std::string::npos) << output.error;
  EXPECT_LT(output.error.size(), 300u);
}

TEST(CommandLine, BadInputExitsWith2AndOneLine) {
  const ToolOutput no_file = run({"configuration", "--config", "/nowhere.yaml"});
  EXPECT_EQ(no_file.exit_code, 2);
  EXPECT_NE(no_file.error.find("/nowhere.yaml"), std::string::npos);
  EXPECT_EQ(no_file.error.find('\n'), no_file.error.size() - 1);
  const ToolOutput no_scenario = run({"simulate", "--scenario", "nowhere", "--out", "/nowhere.lcm"});
  EXPECT_EQ(no_scenario.exit_code, 2);
  EXPECT_NE(no_scenario.error.find("nowhere"), std::string::npos);
}

TEST(CommandLine, NumbersHaveBounds) {
  const std::vector<std::pair<std::string, std::string>> beyond = {
      {"--width", "-5"}, {"--width", "100000"}, {"--fps", "0"}, {"--fps", "-1"}, {"--gyro-unit", "furlong"}};
  for (const auto& [option, value] : beyond) {
    const ToolOutput output =
        run({"import", "video", "/nowhere.mp4", "--out", "/nowhere.lcm", option, value});
    EXPECT_EQ(output.exit_code, 2) << option << " " << value;
    EXPECT_NE(output.error.find(option), std::string::npos) << output.error;
    EXPECT_EQ(output.error.find('\n'), output.error.size() - 1) << output.error;
  }
}

/// "nan" is neither below a lower bound nor above an upper one.
TEST(CommandLine, NoNumberIsNotANumberOrEndless) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> options = {
      {{"import", "video", "/nowhere.mp4", "--out", "/nowhere.lcm"}, "--fps"},
      {{"simulate", "--out", "/nowhere.lcm"}, "--seconds"},
      {{"simulate", "--out", "/nowhere.lcm"}, "--readout-ms"},
      {{"detect", "--log", "/nowhere.lcm", "--config", "/nowhere.yaml", "--out", "/nowhere"}, "--rate"},
      {{"doctor", "--live", "--config", "/nowhere.yaml"}, "--seconds"},
      {{"top", "--once"}, "--listen"},
      {{"record", "--out", "/nowhere"}, "--split"},
      {{"record", "--out", "/nowhere"}, "--min-free"},
      {{"reference-extrinsics", "--flight", "/nowhere", "--config", "/nowhere.yaml", "--out", "/nowhere"},
       "--rotation-deg"},
      {{"reference-extrinsics", "--flight", "/nowhere", "--config", "/nowhere.yaml", "--out", "/nowhere"},
       "--timeshift-ms"},
      {{"reference-extrinsics", "--flight", "/nowhere", "--config", "/nowhere.yaml", "--out", "/nowhere"},
       "--height-fraction"}};
  for (const auto& [command, option] : options) {
    for (const char* value : {"nan", "inf", "1e300", "-1", "1x"}) {
      std::vector<std::string> arguments = command;
      arguments.insert(arguments.end(), {option, value});
      const ToolOutput output = run(arguments);
      EXPECT_EQ(output.exit_code, 2) << option << " " << value;
      EXPECT_NE(output.error.find(option + ": '" + value + "' is no number from"), std::string::npos)
          << output.error;
      EXPECT_EQ(output.error.find('\n'), output.error.size() - 1) << output.error;
    }
  }
}

TEST(CommandLine, ResultsAndDetectionsAreOneOption) {
  for (const char* name : {"evaluate", "overlay", "report"}) {
    const std::string help = run({name, "--help"}).out;
    EXPECT_NE(help.find("--results,--detections"), std::string::npos) << help;
  }
}

TEST(CommandLine, TheEnvironmentSetsTheLcmUrl) {
  const EnvironmentVariable url("LCM_DEFAULT_URL", "udpm://239.1.2.3:4567?ttl=0");
  for (const char* name : {"collect", "doctor", "record", "top", "watch"}) {
    const std::string help = run({name, "--help"}).out;
    EXPECT_NE(help.find("LCM_DEFAULT_URL"), std::string::npos) << help;
  }
}

}  // namespace
}  // namespace redbee
