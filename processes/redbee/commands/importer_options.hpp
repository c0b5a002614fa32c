// The options of an importer's subcommand.
#pragma once

#include "redbee/importers/importer.hpp"

namespace CLI {
class App;
}

namespace redbee {

/// Adds source, --out and what the importer takes, and a callback that imports and prints the flight.
void setUpImporter(CLI::App& command, const Importer& importer);

/// The options alone, those that `takes` names and --camchain.
void addImporterOptions(CLI::App& command, ImportOptions& options, const ImporterTakes& takes);

}  // namespace redbee
