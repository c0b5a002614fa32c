#include "processes/motion_segmentation/node.hpp"
#include "processes/run_process.hpp"

int main(int argc, char** argv) {
  return redbee::runProcess<redbee::MotionSegmentationNode>(argc, argv, redbee::kMotionSegmentation);
}
