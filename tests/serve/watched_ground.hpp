// A camera that looks straight down and flies sideways over a known texture, a frame 50 ms: one pixel of the
// image is one of the mosaic.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "processes/conversions.hpp"
#include "processes/serve/live_mosaic.hpp"
#include "redbee/bus/image.hpp"
#include "redbee/foreground_t.hpp"
#include "redbee/image_codec/png.hpp"
#include "tests/support/camera.hpp"

namespace redbee::test {

inline constexpr int kStep_px = 4;  ///< of the ground to the left, from frame to frame
inline constexpr double kHeight_m = 10;
inline constexpr int kMover = 60;  ///< px, side of a white square that is masked
inline constexpr int kMargin = 7;  ///< px, of the mask and of a JPEG's blocks

inline int64_t utimeOf(int k) { return 1'000'000'000 + k * 50'000; }

// What json may throw where it is moved ends the test. NOLINTNEXTLINE(bugprone-exception-escape)
struct Bundle {
  nlohmann::json head;
  cv::Mat3b image;
};

class WatchedGround : public testing::Test {
 protected:
  WatchedGround() : texture_(kHeight, 4000) {
    configuration_.camera = intrinsics();
    cv::RNG rng(5);
    rng.fill(texture_, cv::RNG::UNIFORM, 0, 255);
    cv::GaussianBlur(texture_, texture_, {0, 0}, 6);
    cv::normalize(texture_, texture_, 20, 200, cv::NORM_MINMAX);
  }

  static cv::Rect moverIn(int k) { return {40 + 3 * k % 480, 200, kMover, kMover}; }

  /// The step to frame k.
  void step(int k, bool has_plane = true, int source = fused_homography_t::FUSED) {
    fused_homography_t m{};
    m.utime = utimeOf(k);
    m.utime_previous = utimeOf(k - 1);
    m.source = static_cast<int8_t>(source);
    Eigen::Matrix3d H = Eigen::Matrix3d::Identity();
    H(0, 2) = -kStep_px - jump_px_;
    fill(m.step.H, H);
    m.has_motion = has_plane ? 1 : 0;
    m.motion.normal[2] = 1;
    m.motion.distance = height_m_;
    mosaic().onFused(m);
  }

  /// The step to frame k, of so many pixels more.
  void leap(int k, double px) {
    jump_px_ = px;
    step(k);
    jump_px_ = 0;
  }

  FrameView frame(int k) const {
    cv::Mat1b grey = texture_(cv::Rect(kStep_px * k, 0, kWidth, kHeight)).clone();
    cv::Mat1b mask = cv::Mat1b::zeros(grey.size());
    grey(moverIn(k)) = 255;
    mask(moverIn(k)) = 255;
    FrameView view;
    view.utime = utimeOf(k);
    view.image = std::make_shared<const image_t>(rawGreyMessage(view.utime, grey));
    view.mask = encodeBilevelPng(mask);
    view.detections.emplace();
    view.detections->utime = view.utime;
    view.detections->status = foreground_t::GOOD;
    view.detections->n = 1;
    const cv::Rect box = moverIn(k);
    view.detections->detections.push_back({3, box.x, box.y, box.width, box.height, 0, 1, 1});
    return view;
  }

  void fly(int from, int to, bool has_plane = true) {
    for (int k = from; k < to; ++k) {
      step(k, has_plane);
      mosaic().onFrame(frame(k), now_);
      now_ += std::chrono::milliseconds(50);
    }
  }

  LiveMosaic& mosaic() {
    if (!mosaic_) mosaic_ = std::make_unique<LiveMosaic>(configuration_);
    return *mosaic_;
  }
  /// Null head: nothing new.
  Bundle ask(int64_t after = -1) {
    const auto bytes = mosaic().newest(after, now_);
    if (!bytes) return {};
    const auto* data = reinterpret_cast<const uint8_t*>(bytes->data());
    const size_t length = size_t{data[0]} << 24 | data[1] << 16 | data[2] << 8 | data[3];
    Bundle bundle;
    bundle.head = nlohmann::json::parse(bytes->substr(4, length));
    const std::vector<uint8_t> jpeg(data + 4 + length, data + bytes->size());
    EXPECT_EQ(bundle.head["image_bytes"], jpeg.size());
    bundle.image = cv::imdecode(jpeg, cv::IMREAD_COLOR);
    EXPECT_EQ(bundle.image.cols, bundle.head["width"]);
    EXPECT_EQ(bundle.image.rows, bundle.head["height"]);
    return bundle;
  }

  static std::vector<cv::Point> pointsOf(const nlohmann::json& track) {
    std::vector<cv::Point> points;
    for (const auto& point : track["points"]) points.emplace_back(point[0], point[1]);
    return points;
  }
  /// px, of a line.
  static double distanceTo(const std::vector<cv::Point>& line, const cv::Point& point) {
    double least = INFINITY;
    for (size_t i = 1; i < line.size(); ++i) {
      const cv::Point2d a = line[i - 1], b = line[i], p = point;
      const double along = (p - a).dot(b - a) / std::max(1.0, (b - a).dot(b - a));
      least = std::min(least, cv::norm(p - a - std::clamp(along, 0.0, 1.0) * (b - a)));
    }
    return least;
  }
  /// Where the right lower corner of what frame k shows is in the mosaic, with pixels so many times as large,
  /// and how well it fits.
  std::pair<double, cv::Rect> find(int k, double times, const cv::Mat3b& image) const {
    cv::Mat1b grey;
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    cv::Mat1b patch;
    cv::resize(texture_(cv::Rect(kStep_px * k + 400, 300, 200, 150)), patch, {}, times, times,
               cv::INTER_AREA);
    cv::Mat1f score;
    cv::matchTemplate(grey, patch, score, cv::TM_CCOEFF_NORMED);
    double best = 0;
    cv::Point at;
    cv::minMaxLoc(score, nullptr, &best, nullptr, &at);
    return {best, {at, patch.size()}};
  }
  static bool says(const Bundle& bundle, const std::string& words) {
    return bundle.head["notes"].dump().find(words) != std::string::npos;
  }

  cv::Mat1b texture_;
  Configuration configuration_;
  double height_m_ = kHeight_m;  ///< as the plane has it
  double jump_px_ = 0;           ///< of the homography of the next steps, by mistake
  std::unique_ptr<LiveMosaic> mosaic_;
  LiveMosaic::Time now_ = LiveMosaic::Time() + std::chrono::hours(1);
};

}  // namespace redbee::test
