// From a row of the process table to its node.
#pragma once

#include <memory>

#include "redbee/bus/bus.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/configuration/process_table.hpp"
#include "redbee/node/node.hpp"

namespace redbee {

/// The node of one of kStages, on `bus`. Throws std::invalid_argument for a process that has none.
std::unique_ptr<Node> makeNode(const ProcessDescription& process, Bus& bus,
                               const Configuration& configuration);

}  // namespace redbee
