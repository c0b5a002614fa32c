#include "processes/serve/run_serve.hpp"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <opencv2/core/utility.hpp>
#include <string>
#include <system_error>
#include <vector>

#include "processes/common_options.hpp"
#include "processes/exit_code.hpp"
#include "processes/serve/http_server.hpp"
#include "processes/serve/node.hpp"
#include "redbee/bus/build_version.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/files/user_error.hpp"

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
  std::filesystem::path tiles;
};

void addOptions(CLI::App& app, ServeOptions& options) {
  addConfigurationOption(app, options.configuration);
  addLcmUrlOption(app, options.url);
  app.add_option("--listen", options.listen,
                 std::string(kListenForms) + " (serve.listen, else " + kDefaultListen + ")");
  app.add_option("--token-file", options.token_file, "what the browser must know (serve.token_file)");
  app.add_flag("--allow-writes", options.allow_writes,
               "the page may record and restart (serve.allow_writes)");
  app.add_option("--flights", options.folders,
                 "folders with logs, results and reports to show (else that of REDBEE_RECORDINGS)");
  app.add_option("--tiles", options.tiles, "folder with the map's tiles: z/x/y.png, WebMercator")
      ->check(CLI::ExistingDirectory);
}

ServeParameters parametersOf(const Configuration& configuration, const ServeOptions& options) {
  ServeParameters parameters = configuration.serve;
  if (!options.listen.empty()) parameters.listen = options.listen;
  if (parameters.listen.empty()) parameters.listen = kDefaultListen;
  if (!options.token_file.empty()) parameters.token_file = options.token_file;
  parameters.allow_writes = parameters.allow_writes || options.allow_writes;
  return parameters;
}

/// A folder that is named must be there; that of recordings may be made later.
std::vector<std::filesystem::path> foldersOf(const ServeOptions& options) {
  for (const std::filesystem::path& folder : options.folders) {
    std::error_code error;
    const auto status = std::filesystem::status(folder, error);
    if (std::filesystem::is_directory(status)) continue;
    const bool is_there = std::filesystem::exists(status);
    throw UserError("--flights " + folder.string() + ": " +
                    (is_there ? "is no folder; give the one that it is in" : "there is no such folder"));
  }
  if (!options.folders.empty()) return options.folders;
  const char* recordings = std::getenv("REDBEE_RECORDINGS");
  if (recordings == nullptr || *recordings == '\0') return {};
  return {recordings};
}

std::string placeOf(const ListenAddress& address) {
  if (address.unix_socket.empty()) return "http://" + address.host + ":" + std::to_string(address.port) + "/";
  return "the Unix socket " + std::filesystem::absolute(address.unix_socket).string();
}

void serve(const ServeOptions& options) {
  const auto folders = foldersOf(options);
  const Configuration configuration = loadConfiguration(options.configuration);
  const ServeParameters parameters = parametersOf(configuration, options);
  const auto address = listenAddressOf(parameters.listen);
  if (!address) throw UserError("--listen " + parameters.listen + ": must be " + kListenForms);
  Live live;
  Archive archive(configuration, folders);
  LiveMosaic mosaic(configuration);
  Station station(Access(*address, readToken(parameters.token_file), parameters.allow_writes), archive, live,
                  supervisedStack());
  station.showMosaic(mosaic);
  station.showTiles(options.tiles);
  const auto bus = makeLcmBus(options.url);
  ServeNode node(*bus, configuration, live, mosaic);
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
