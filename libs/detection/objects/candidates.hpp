// Components from the difference of appearance, at several levels of it, judged by boosted trees. P_FG needs
// evidence of motion at each pixel; a candidate needs some somewhere, and is judged as a whole by what
// surrounds it, which also finds what moves slowly or along the parallax. libs/README.md, "Candidates".
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "redbee/detection/foreground_maps.hpp"
#include "redbee/detection/objects/boosted_trees.hpp"
#include "redbee/detection/objects/components.hpp"
#include "redbee/detection/objects/region_features.hpp"
#include "redbee/detection/parameters.hpp"

namespace redbee {

struct Candidate {
  cv::Rect box;      ///< of the maps [px]
  cv::Mat1b pixels;  ///< 255 where it is, in its box
  RegionFeatures features{};
  double log_odds = 0;  ///< that it is an object, rather than a static surface or a part of something else
};

/// What the trees were trained on: object-trees.txt in config/.
const BoostedTrees& objectTrees();

/// Regions of the appearance difference with some evidence of motion, the surest first; those that cover
/// others appear beside them. `unknown`: not 0 where there is no statement, of the image's size.
std::vector<Candidate> findCandidates(const ForegroundMaps& maps, const cv::Mat1b& unknown,
                                      const std::optional<GroundPlane>& ground, const BoostedTrees& trees);

/// The candidates as components, without those that a surer one covers or is covered by; Component::peak is
/// their probability. What findComponents() finds stays where no candidate is, in place of candidates that
/// are not sure, and where it is larger than the trees know.
/// `probability`: P_FG * 255.
ForegroundComponents componentsOf(const std::vector<Candidate>& candidates, const cv::Mat1b& probability,
                                  const cv::Mat1b& unknown, const ObjectParameters& parameters,
                                  const ForegroundMaps& maps);

}  // namespace redbee
