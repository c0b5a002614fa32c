// The subcommands of `redbee`, each added to the command line by a function of its own. A callback that fails
// throws; main() turns what it throws into the exit code.
#pragma once

namespace CLI {
class App;
}

namespace redbee {

void addImportCommand(CLI::App& app);
void addDetectCommand(CLI::App& app);
void addCollectCommand(CLI::App& app);
void addOverlayCommand(CLI::App& app);
void addReportCommand(CLI::App& app);
void addEvaluateCommand(CLI::App& app);
void addCompareCommand(CLI::App& app);
void addConfigurationCommand(CLI::App& app);
void addReferenceExtrinsicsCommand(CLI::App& app);
void addSimulateCommand(CLI::App& app);
void addDoctorCommand(CLI::App& app);
void addTopCommand(CLI::App& app);
void addWatchCommand(CLI::App& app);
void addRecordCommand(CLI::App& app);

/// 0 on success, 2 on bad use or bad input (one line on stderr), 1 on anything else.
int runTool(int argc, char** argv);

}  // namespace redbee
