#include "processes/ground_link/node.hpp"
#include "processes/run_process.hpp"

int main(int argc, char** argv) {
  return redbee::runProcess<redbee::GroundLinkNode>(argc, argv, redbee::kGroundLink);
}
