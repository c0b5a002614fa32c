#include "processes/autopilot/node.hpp"
#include "processes/run_process.hpp"

int main(int argc, char** argv) {
  return redbee::runProcess<redbee::AutopilotNode>(argc, argv, redbee::kAutopilot);
}
