#include "processes/visual_homography/node.hpp"
#include "processes/run_process.hpp"

int main(int argc, char** argv) {
  return redbee::runProcess<redbee::VisualHomographyNode>(argc, argv, "redbee-visual-homography");
}
