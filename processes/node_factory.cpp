#include "processes/node_factory.hpp"

#include <stdexcept>

#include "processes/homography_fusion/node.hpp"
#include "processes/imu_integration/node.hpp"
#include "processes/motion_segmentation/node.hpp"
#include "processes/visual_homography/node.hpp"

namespace redbee {
namespace {

template <typename NodeType>
std::unique_ptr<Node> make(Bus& bus, const Configuration& configuration) {
  return std::make_unique<NodeType>(bus, configuration);
}

struct Factory {
  const ProcessDescription* process;
  std::unique_ptr<Node> (*make)(Bus&, const Configuration&);
};

constexpr std::array kFactories{
    Factory{&kImuIntegration, make<ImuIntegrationNode>},
    Factory{&kVisualHomography, make<VisualHomographyNode>},
    Factory{&kHomographyFusion, make<HomographyFusionNode>},
    Factory{&kMotionSegmentation, make<MotionSegmentationNode>},
};
static_assert(kFactories.size() == kStages.size(), "every stage of the process table needs its node here");

}  // namespace

std::unique_ptr<Node> makeNode(const ProcessDescription& process, Bus& bus,
                               const Configuration& configuration) {
  for (const Factory& factory : kFactories) {
    if (factory.process == &process) return factory.make(bus, configuration);
  }
  throw std::invalid_argument(programName(process) + " has no node");
}

}  // namespace redbee
