// `redbee calibrate` is a program of its own, redbee-calibrate: what flies, and the demo, build and load
// without Ceres.
#include "processes/redbee/calibrate/calibrate.hpp"
#include "processes/redbee/commands/program_beside.hpp"

namespace redbee {
namespace {

const Command kCalibrateCommand(CommandGroup::kFlights, kCalibrateName, kCalibrateDescription,
                                programBeside("redbee-calibrate"));

}  // namespace
}  // namespace redbee
