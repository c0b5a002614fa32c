#include "processes/redbee/commands/export_targets.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "processes/common_options.hpp"
#include "processes/redbee/export/target_map.hpp"
#include "processes/warnings.hpp"
#include "redbee/configuration/configuration_files.hpp"
#include "redbee/files/atomic_file.hpp"
#include "redbee/files/input_file.hpp"

namespace redbee {
namespace {

struct TargetExport {
  std::filesystem::path log;
  std::filesystem::path configuration;
  std::filesystem::path out;
};

void addTargetExport(CLI::App& command, const std::string& name, const std::string& what,
                     std::string (*text)(const RecordedFlight&, const TargetExport&)) {
  auto options = std::make_shared<TargetExport>();
  auto* subcommand = command.add_subcommand(name, what);
  addLogOption(*subcommand, options->log)->required();
  subcommand->add_option("--config", options->configuration,
                         "configuration of the vehicle: TARGETS are computed anew from DETECTIONS and POSE");
  addOutOption(*subcommand, options->out, "file to write");
  subcommand->callback([options, text] {
    requireNoInput(options->out, {options->log});
    if (!options->configuration.empty()) requireNoInput(options->out, options->configuration, {});
    checkWritable(options->out);
    const RecordedFlight flight = readTargets(
        options->log, options->configuration.empty() ? std::nullopt : std::optional(options->configuration));
    writeAtomically(options->out, text(flight, *options));
    printWarning(flight.damage_report);
    printDamaged(flight.damaged);
    std::printf("%s: %zu targets of %lld frames, %zu places of the vehicle\n", options->out.c_str(),
                flight.targets.size(), static_cast<long long>(flight.frames), flight.vehicle.size());
  });
}

}  // namespace

void addTargetExports(CLI::App& command) {
  addTargetExport(command, "geojson", "GeoJSON: paths of vehicle and targets, and where those were last",
                  [](const RecordedFlight& flight, const TargetExport&) { return asGeoJson(flight); });
  addTargetExport(command, "kml", "KML: the same, for a globe",
                  [](const RecordedFlight& flight, const TargetExport& options) {
                    return asKml(flight, options.log.stem().string());
                  });
}

}  // namespace redbee
