// What the four executables share: options, configuration, bus, loop, exit code.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "redbee/configuration/configuration.hpp"
#include "redbee/node/node.hpp"

namespace redbee {

using NodeFactory = std::function<std::unique_ptr<Node>(Bus&, const Configuration&)>;

/// 0 after SIGINT or SIGTERM, 2 on bad use or a bad configuration (one line on stderr), 1 where LCM cannot be
/// opened.
int runProcess(int argc, char** argv, const std::string& name, const NodeFactory& factory);

template <typename NodeType>
int runProcess(int argc, char** argv, const std::string& name) {
  return runProcess(argc, argv, name,
                    [](Bus& bus, const Configuration& configuration) -> std::unique_ptr<Node> {
                      return std::make_unique<NodeType>(bus, configuration);
                    });
}

}  // namespace redbee
