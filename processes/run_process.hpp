// main() of the programs of the process table: options, configuration, bus, main loop, exit code.
#pragma once

#include <functional>
#include <memory>

#include "redbee/configuration/configuration.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/node/node.hpp"

namespace redbee {

using NodeFactory = std::function<std::unique_ptr<Node>(Bus&, const Configuration&)>;

/// Returns 0 after SIGINT or SIGTERM, 2 on bad use or a bad configuration (one line on stderr), 1 if LCM
/// cannot be opened.
int runProcess(int argc, char** argv, const ProcessDescription& process, const NodeFactory& factory);

template <typename NodeType>
int runProcess(int argc, char** argv, const ProcessDescription& process) {
  return runProcess(argc, argv, process,
                    [](Bus& bus, const Configuration& configuration) -> std::unique_ptr<Node> {
                      return std::make_unique<NodeType>(bus, configuration);
                    });
}

}  // namespace redbee
