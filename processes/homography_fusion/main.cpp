#include "processes/homography_fusion/node.hpp"
#include "processes/run_process.hpp"

int main(int argc, char** argv) {
  return redbee::runProcess<redbee::HomographyFusionNode>(argc, argv, redbee::kHomographyFusion);
}
