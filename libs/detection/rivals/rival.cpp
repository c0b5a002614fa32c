#include "redbee/detection/rivals/rival.hpp"

#include <opencv2/core/eigen.hpp>
#include <utility>
#include <vector>

#include "redbee/detection/rivals/graded_score.hpp"

namespace redbee {
namespace {

ObjectParameters decidedByScore(ObjectParameters objects) {
  decideAt((kDecisionScore - 0.5) / 255, objects);
  return objects;
}

}  // namespace

Rival::Rival(const ObjectParameters& objects) : objects_(decidedByScore(objects)), tracker_(objects_) {}

bool Rival::fits(const FrameInput& input) const {
  return !input.grey.empty() && (!needs().colour || input.colour.size() == input.grey.size());
}

RivalScore Rival::restart(const FrameInput& input) {
  reset();
  RivalScore scored = scoreFrame(input);
  scored.status = DetectorStatus::kNoHomography;
  return scored;
}

RivalScore Rival::score(const FrameInput& input) {
  RivalScore scored;
  if (!fits(input)) {
    reset();
    scored.status = DetectorStatus::kBadImage;
  } else {
    const bool first = !last_time_;
    const bool follows = !first && input.time > *last_time_ && input.time - *last_time_ <= kMaxFrameGap &&
                         input.grey.size() == size_;
    size_ = input.grey.size();
    if (first || follows) scored = scoreFrame(input);
    if ((!first && !follows) || scored.status == DetectorStatus::kNoHomography) scored = restart(input);
    last_time_ = input.time;
  }
  if (scored.status != DetectorStatus::kGood) {
    scored.score = cv::Mat1b::zeros(size_);
    scored.background = cv::Matx33d::eye();
  }
  return scored;
}

DetectorOutput Rival::step(const FrameInput& input) {
  const Duration elapsed = last_time_ ? input.time - *last_time_ : Duration(0);
  const RivalScore scored = score(input);
  const cv::Size size = input.fullSize().empty() ? size_ : input.fullSize();
  const bool good = scored.status == DetectorStatus::kGood;
  DetectorOutput output;
  output.time = input.time;
  output.status = scored.status;
  output.unknown = cv::Mat1b(size, good ? 0 : 255);
  output.probability = good ? scored.score : cv::Mat1b(cv::Mat1b::zeros(size));
  output.mask = cv::Mat1b::zeros(size);
  if (!good) {
    tracker_.propagate(elapsed, std::nullopt);
    output.detections = tracker_.skip(size);
    return output;
  }
  Eigen::Matrix3d background;
  cv::cv2eigen(scored.background, background);
  tracker_.propagate(elapsed, background);
  ForegroundComponents found = findComponents(output.probability, output.unknown, objects_);
  output.mask = found.mask();
  output.detections = tracker_.update(found).detections;
  return output;
}

}  // namespace redbee
