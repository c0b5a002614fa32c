// `redbee serve` is a process of the stack, redbee-serve, which alone needs cpp-httplib.
#include "processes/redbee/commands/program_beside.hpp"

namespace redbee {
namespace {

const Command kServeCommand(CommandGroup::kVehicle, "serve",
                            "the ground station in the browser: live, and of flights on disk",
                            processBeside("redbee-serve"));

}  // namespace
}  // namespace redbee
