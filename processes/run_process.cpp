#include "processes/run_process.hpp"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <opencv2/core/utility.hpp>

#include "processes/common_options.hpp"
#include "processes/exit_code.hpp"
#include "redbee/bus/build_version.hpp"

namespace redbee {

int runProcess(int argc, char** argv, const ProcessDescription& process, const NodeFactory& factory) {
  endWhereMemoryIsShort();
  keepFreedMemory();
  const std::string name = programName(process);
  CLI::App app(std::string("REDBEE ") + releaseVersion() + ", " + name, name);
  std::filesystem::path configuration_file;
  std::string url;
  std::string state_folder;
  app.set_version_flag("--version", buildVersion());
  addConfigurationOption(app, configuration_file);
  addLcmUrlOption(app, url);
  app.add_option("--state-dir", state_folder, "folder for the state that survives a restart of this process");
  return exitCodeOf(app, [&] {
    app.parse(argc, argv);
    // One thread per process: the other processes need the other cores.
    cv::setNumThreads(1);
    const Configuration configuration = loadConfiguration(configuration_file);
    const auto bus = makeLcmBus(url);
    const auto node = factory(*bus, configuration);
    if (!state_folder.empty()) node->keepStateIn(state_folder);
    spdlog::info("{}: configuration {} ({}), {}", name, configuration_file.string(),
                 configurationHash(configuration), url);
    runNode(*bus, *node, configuration.channels.health, stopOnSignals());
  });
}

}  // namespace redbee
