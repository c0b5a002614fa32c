#include "processes/motion_segmentation/homography_path.hpp"

#include <Eigen/LU>
#include <deque>
#include <map>

#include "processes/conversions.hpp"

namespace redbee {

std::vector<HomographyLink> linksOf(const MessageSynchronizer<fused_homography_t>& messages) {
  std::vector<HomographyLink> anchors;
  std::vector<HomographyLink> steps;
  messages.forEach([&](CameraTime time, const fused_homography_t& m) {
    if (m.source == fused_homography_t::NONE) return;
    anchors.push_back({CameraTime(fromUtime(m.utime_anchor)), time, matrix3(m.anchor.H)});
    steps.push_back({previousTimeOf(m), time, matrix3(m.step.H)});
  });
  anchors.insert(anchors.end(), steps.begin(), steps.end());
  return anchors;
}

std::vector<HomographyLink> linksOf(const MessageSynchronizer<visual_homography_t>& messages) {
  std::vector<HomographyLink> steps;
  messages.forEach([&](CameraTime time, const visual_homography_t& m) {
    if (m.status == visual_homography_t::GOOD)
      steps.push_back({previousTimeOf(m), time, matrix3(m.ground.H)});
  });
  return steps;
}

std::optional<Eigen::Matrix3d> homographyAlong(const std::vector<HomographyLink>& links, CameraTime from,
                                               CameraTime to) {
  std::map<CameraTime, Eigen::Matrix3d> reached{{from, Eigen::Matrix3d::Identity()}};
  std::deque<CameraTime> next{from};
  const auto reach = [&](CameraTime time, const Eigen::Matrix3d& H) {
    if (reached.emplace(time, H).second) next.push_back(time);
  };
  while (!next.empty() && reached.count(to) == 0) {
    const CameraTime at = next.front();
    next.pop_front();
    const Eigen::Matrix3d H = reached.at(at);
    for (const HomographyLink& link : links) {
      if (link.from == at) reach(link.to, link.H * H);
      if (link.to == at) reach(link.from, link.H.inverse() * H);
    }
  }
  const auto found = reached.find(to);
  if (found == reached.end()) return std::nullopt;
  const Eigen::Matrix3d& H = found->second;
  if (!H.allFinite() || H(2, 2) == 0) return std::nullopt;
  return normaliseHomography(H);
}

}  // namespace redbee
