// Components of the foreground, judged as wholes by boosted trees: those of P_FG, and regions of the
// difference of appearance at several levels. P_FG needs evidence of motion at each pixel; such a region
// needs some somewhere, so that what moves slowly or along the parallax is found, too. libs/README.md,
// "Candidates".
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "redbee/detection/foreground_maps.hpp"
#include "redbee/detection/objects/boosted_trees.hpp"
#include "redbee/detection/objects/components.hpp"
#include "redbee/detection/objects/region_features.hpp"

namespace redbee {

struct Candidate {
  cv::Rect box;      ///< of the maps [px]
  cv::Mat1b pixels;  ///< 255 where it is, in its box
  RegionFeatures features{};
  double log_odds = 0;  ///< that it is an object, rather than a static surface or a part of something else
  std::optional<size_t> component{};  ///< of P_FG: which one; none: a region of the appearance difference
};

/// What the trees were trained on: object-trees.txt in config/.
const BoostedTrees& objectTrees();

/// Regions of the appearance difference with some evidence of motion, and components of P_FG, the surest
/// first; those that cover others appear beside them. `unknown`: not 0 where there is no statement, of the
/// image's size. `of_foreground`: findComponents().
std::vector<Candidate> findCandidates(const ForegroundMaps& maps, const cv::Mat1b& unknown,
                                      const ForegroundComponents& of_foreground,
                                      const std::optional<GroundPlane>& ground, const BoostedTrees& trees);

/// The candidates as components, without those that a surer one covers or is covered by; Component::peak is
/// their probability. Those of P_FG stay as they are where no candidate is, in place of candidates that are
/// not sure, and where they are larger than the trees know, but for those that the trees reject.
/// `of_foreground`: as there.
/// `probability`: P_FG * 255.
ForegroundComponents componentsOf(const std::vector<Candidate>& candidates,
                                  const ForegroundComponents& of_foreground, const cv::Mat1b& probability,
                                  const cv::Mat1b& unknown, const ForegroundMaps& maps);

}  // namespace redbee
