#include "processes/run_process.hpp"
#include "processes/visual_homography/node.hpp"

int main(int argc, char** argv) {
  return redbee::runProcess<redbee::VisualHomographyNode>(argc, argv, redbee::kVisualHomography);
}
