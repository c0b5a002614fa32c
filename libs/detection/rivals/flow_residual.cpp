#include "redbee/detection/rivals/flow_residual.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "redbee/detection/rivals/graded_score.hpp"

namespace redbee {

cv::Mat1f flowAgainst(const cv::Mat2f& flow, const cv::Matx33d& H) {
  const cv::Matx33d back = H.inv();
  const cv::Rect2d image(0, 0, flow.cols - 1, flow.rows - 1);
  cv::Mat1f remains = cv::Mat1f::zeros(flow.size());
  for (int y = 0; y < flow.rows; ++y) {
    const auto* measured = flow[y];
    auto* to = remains[y];
    for (int x = 0; x < flow.cols; ++x) {
      const cv::Vec3d p = back * cv::Vec3d(x, y, 1);
      const cv::Point2d expected(p[0] / p[2], p[1] / p[2]);
      if (p[2] <= 0 || !image.contains(expected)) continue;
      to[x] =
          static_cast<float>(std::hypot(x + measured[x][0] - expected.x, y + measured[x][1] - expected.y));
    }
  }
  return remains;
}

FlowResidual::FlowResidual(const ObjectParameters& objects, const FlowResidualParameters& parameters)
    : Rival(objects),
      parameters_(parameters),
      flow_(cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM)),
      history_(parameters.back_frames) {}

void FlowResidual::reset() {
  registrar_.reset();
  history_.clear();
}

RivalScore FlowResidual::scoreFrame(const FrameInput& input) {
  RivalScore scored;
  const bool first = !registrar_.hasPrevious();
  const auto registration = registrar_.advance(input.grey);
  if (registration) {
    scored.status = DetectorStatus::kGood;
    scored.background = *registration;
    history_.propagate(*registration);
    cv::Mat2f flow;
    flow_->calc(input.grey, history_.oldest(), flow);
    cv::Mat1f remains = flowAgainst(flow, history_.oldestToNewest());
    cv::blur(remains, remains, {parameters_.average_px, parameters_.average_px});
    scored.score = gradedScore(remains, parameters_.threshold_px);
  } else if (!first) {
    scored.status = DetectorStatus::kNoHomography;
  }
  history_.push(input.grey.clone());
  return scored;
}

}  // namespace redbee
