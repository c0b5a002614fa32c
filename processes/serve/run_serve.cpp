#include "processes/serve/run_serve.hpp"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <opencv2/core/utility.hpp>
#include <string>
#include <vector>

#include "processes/common_options.hpp"
#include "processes/exit_code.hpp"
#include "processes/serve/http_server.hpp"
#include "processes/serve/node.hpp"
#include "redbee/bus/build_version.hpp"
#include "redbee/configuration/process_table.hpp"

namespace redbee {
namespace {

constexpr const char* kDefaultListen = "127.0.0.1:8080";

struct ServeOptions {
  std::filesystem::path configuration;
  std::string url;
  std::string listen;
  std::filesystem::path token_file;
  bool allow_writes = false;
  std::vector<std::filesystem::path> folders;
};

void addOptions(CLI::App& app, ServeOptions& options) {
  addConfigurationOption(app, options.configuration);
  addLcmUrlOption(app, options.url);
  app.add_option("--listen", options.listen,
                 std::string(kListenForms) + " (serve.listen, else " + kDefaultListen + ")");
  app.add_option("--token-file", options.token_file, "what the browser must know (serve.token_file)");
  app.add_flag("--allow-writes", options.allow_writes,
               "the page may record and restart (serve.allow_writes)");
  app.add_option("--flights", options.folders, "folders with logs, results and reports to show")
      ->envname("REDBEE_RECORDINGS");
}

ServeParameters parametersOf(const Configuration& configuration, const ServeOptions& options) {
  ServeParameters parameters = configuration.serve;
  if (!options.listen.empty()) parameters.listen = options.listen;
  if (parameters.listen.empty()) parameters.listen = kDefaultListen;
  if (!options.token_file.empty()) parameters.token_file = options.token_file;
  parameters.allow_writes = parameters.allow_writes || options.allow_writes;
  return parameters;
}

std::string placeOf(const ListenAddress& address) {
  if (address.unix_socket.empty()) return "http://" + address.host + ":" + std::to_string(address.port) + "/";
  return "the Unix socket " + std::filesystem::absolute(address.unix_socket).string();
}

void serve(const ServeOptions& options) {
  const Configuration configuration = loadConfiguration(options.configuration);
  const ServeParameters parameters = parametersOf(configuration, options);
  const auto address = listenAddressOf(parameters.listen);
  if (!address) throw UserError("--listen " + parameters.listen + ": must be " + kListenForms);
  Live live;
  Archive archive(configuration, options.folders);
  Station station(Access(*address, readToken(parameters.token_file), parameters.allow_writes), archive, live,
                  supervisedStack());
  const auto bus = makeLcmBus(options.url);
  ServeNode node(*bus, configuration, live);
  const std::atomic<bool>& stop = stopOnSignals();
  const HttpServer server(*address, station, live);
  spdlog::info("redbee-serve: configuration {} ({}), {}: {}", options.configuration.string(),
               configurationHash(configuration), options.url, placeOf(*address));
  runNode(*bus, node, configuration.channels.health, stop);
}

}  // namespace

int runServe(int argc, char** argv) {
  endWhereMemoryIsShort();
  CLI::App app(std::string("REDBEE ") + releaseVersion() + ", the ground station in the browser",
               "redbee-serve");
  app.set_version_flag("--version", buildVersion());
  ServeOptions options;
  return exitCodeOf(app, [&] {
    addOptions(app, options);
    app.parse(argc, argv);
    cv::setNumThreads(1);
    serve(options);
  });
}

}  // namespace redbee
