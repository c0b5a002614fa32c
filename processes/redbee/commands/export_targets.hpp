// redbee export geojson, redbee export kml.
#pragma once

namespace CLI {
class App;
}

namespace redbee {

/// Adds both to `redbee export`.
void addTargetExports(CLI::App& command);

}  // namespace redbee
