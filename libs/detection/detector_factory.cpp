#include <map>
#include <stdexcept>

#include "redbee/detection/detector.hpp"
#include "redbee/detection/parallax/parallax_detector.hpp"
#include "redbee/detection/rivals/aurora.hpp"
#include "redbee/detection/rivals/datmo.hpp"
#include "redbee/detection/rivals/difference.hpp"
#include "redbee/detection/rivals/flow_residual.hpp"
#include "redbee/detection/rivals/homography_mog2.hpp"
#include "redbee/detection/rivals/mcd.hpp"
#include "redbee/detection/rivals/meier.hpp"
#include "redbee/detection/rivals/trajectory_rival.hpp"
#include "redbee/detection/two_planes/two_plane_detector.hpp"

namespace redbee {
namespace {

using Factory = std::unique_ptr<Detector> (*)(const DetectionParameters&);

template <typename Kind>
std::unique_ptr<Detector> make(const DetectionParameters& parameters) {
  return std::make_unique<Kind>(parameters);
}

template <typename Kind>
std::unique_ptr<Detector> makeRival(const DetectionParameters& parameters) {
  return std::make_unique<Kind>(parameters.objects);
}

template <typename Kind, auto parameters>
std::unique_ptr<Detector> makeTuned(const DetectionParameters& common) {
  return std::make_unique<Kind>(common.objects, parameters());
}

/// A shorter memory.
AuroraParameters auroraOnDavis() {
  AuroraParameters parameters;
  parameters.density.longest = 6;
  return parameters;
}
DifferenceParameters differenceOnDavis() { return {1, 35}; }
FlowResidualParameters flowResidualOnDavis() { return {1, 35, 11.5F}; }

/// Every detector, by its name in `detection.method`.
const std::map<std::string, Factory>& factories() {
  static const std::map<std::string, Factory> all{
      {"aurora", makeRival<Aurora>},
      {"aurora-davis", makeTuned<Aurora, auroraOnDavis>},
      {"datmo", makeRival<Datmo>},
      {"difference", makeRival<Difference>},
      {"difference-davis", makeTuned<Difference, differenceOnDavis>},
      {"flow-residual", makeRival<FlowResidual>},
      {"flow-residual-davis", makeTuned<FlowResidual, flowResidualOnDavis>},
      {"homography-mog2", makeRival<HomographyMog2>},
      {"lrr", makeRival<Lrr>},
      {"mcd", makeRival<Mcd>},
      {"meier", makeRival<Meier>},
      {"parallax", make<ParallaxDetector>},
      {"rv", makeRival<RandomizedVoting>},
      {"ssc", makeRival<Ssc>},
      {"two_planes", make<TwoPlaneDetector>},
  };
  return all;
}

}  // namespace

const char* toString(DetectorStatus status) {
  switch (status) {
    case DetectorStatus::kGood:
      return "good";
    case DetectorStatus::kLearning:
      return "learning";
    case DetectorStatus::kNoHomography:
      return "no homography";
    case DetectorStatus::kBadImage:
      return "bad image";
  }
  return "?";
}

std::unique_ptr<Detector> makeDetector(const DetectionParameters& parameters) {
  const auto found = factories().find(parameters.method);
  if (found == factories().end()) throw std::invalid_argument("no detector " + parameters.method);
  return found->second(parameters);
}

std::vector<std::string> detectorNames() {
  std::vector<std::string> names;
  for (const auto& [name, factory] : factories()) names.push_back(name);
  return names;
}

}  // namespace redbee
