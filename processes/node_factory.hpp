// Constructs the nodes of the process table.
#pragma once

#include <memory>

#include "redbee/bus/bus.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/node/node.hpp"

namespace redbee {

/// The node of one of kStages. Throws std::invalid_argument for other processes.
std::unique_ptr<Node> makeNode(const ProcessDescription& process, Bus& bus,
                               const Configuration& configuration);

}  // namespace redbee
