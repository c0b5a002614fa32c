#include "redbee/detection/two_planes/background_model.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "redbee/geometry/homography.hpp"
#include "redbee/imaging/warping.hpp"

namespace redbee {
namespace {

// Beyond this change of area the canvas is replaced, so that its resolution stays close to the image's.
constexpr double kMaxAreaRatio = 1.2;

int marginPixels(const cv::Size& image, double fraction) {
  return static_cast<int>(std::lround(image.width * fraction));
}

Eigen::Matrix3d translation(double x, double y) {
  Eigen::Matrix3d T = Eigen::Matrix3d::Identity();
  T(0, 2) = x;
  T(1, 2) = y;
  return T;
}

double polygonArea(const std::array<Eigen::Vector2d, 4>& corners) {
  double twice = 0;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& a = corners[i];
    const Eigen::Vector2d& b = corners[(i + 1) % corners.size()];
    twice += a.x() * b.y() - b.x() * a.y();
  }
  return 0.5 * std::abs(twice);
}

}  // namespace

BackgroundModel::BackgroundModel(cv::Size image, const TwoPlaneParameters& parameters, int learning_frames)
    : image_(image),
      canvas_(image.width + 2 * marginPixels(image, parameters.canvas_margin),
              image.height + 2 * marginPixels(image, parameters.canvas_margin)),
      learning_frames_(learning_frames),
      to_canvas_(translation(marginPixels(image, parameters.canvas_margin),
                             marginPixels(image, parameters.canvas_margin))),
      view_(to_canvas_.inverse()),
      mixture_(canvas_, parameters.mixture_history, parameters.mixture_threshold) {}

void BackgroundModel::propagate(const Eigen::Matrix3d& H) {
  view_ = normaliseHomography(H * view_);
  if (viewFitsCanvas()) return;
  mixture_.move(to_canvas_ * view_);
  view_ = to_canvas_.inverse();
}

ForegroundMaps BackgroundModel::learn(const cv::Mat1b& grey) {
  const Eigen::Matrix3d current_to_canvas = view_.inverse();
  const auto warp = [&](const cv::Mat1b& from, cv::Size size, const Eigen::Matrix3d& H, int interpolation) {
    cv::Mat1b to;
    cv::warpPerspective(from, to, toMatx(H), size, interpolation);
    return to;
  };
  const cv::Mat1b valid = warp(cv::Mat1b(image_, 255), canvas_, current_to_canvas, cv::INTER_NEAREST);
  const cv::Mat1b known_canvas = ~mixture_.unknown(learning_frames_);
  const cv::Mat1b foreground_canvas =
      mixture_.update(warp(grey, canvas_, current_to_canvas, cv::INTER_LINEAR), valid);
  ForegroundMaps maps;
  const cv::Mat1b known = warp(known_canvas, image_, view_, cv::INTER_NEAREST);
  maps.foreground = warp(foreground_canvas, image_, view_, cv::INTER_NEAREST) & known;
  maps.unknown = ~known;
  return maps;
}

bool BackgroundModel::viewFitsCanvas() const {
  const double w = image_.width - 1;
  const double h = image_.height - 1;
  const Eigen::Matrix3d to_canvas = view_.inverse();
  std::array<Eigen::Vector2d, 4> corners = {{transfer(to_canvas, {0, 0}), transfer(to_canvas, {w, 0}),
                                             transfer(to_canvas, {w, h}), transfer(to_canvas, {0, h})}};
  for (const Eigen::Vector2d& corner : corners) {
    if (!(corner.x() >= 0 && corner.y() >= 0 && corner.x() <= canvas_.width - 1 &&
          corner.y() <= canvas_.height - 1)) {
      return false;
    }
  }
  const double ratio = polygonArea(corners) / (w * h);
  return ratio < kMaxAreaRatio && ratio > 1 / kMaxAreaRatio;
}

}  // namespace redbee
