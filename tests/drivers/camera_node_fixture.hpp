// A simulated source and redbee-camera's node on it.
#pragma once

#include <gtest/gtest.h>

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "processes/camera/node.hpp"
#include "redbee/bus/image.hpp"
#include "tests/support/camera.hpp"

namespace redbee::test {

struct Camera {
  int64_t now_ns = 1'000'000'000;
  std::string open_fault;
  std::string fault;  ///< with which it ends, once its images are taken
  bool is_open = false;
  int opened = 0;
  std::deque<image_t> images;
  std::optional<double> exposure_s;
  std::string time_fault;
};

class SimulatedSource : public FrameSource {
 public:
  explicit SimulatedSource(Camera& camera) : camera_(camera) {}
  std::string open() override {
    ++camera_.opened;
    camera_.is_open = camera_.open_fault.empty();
    return camera_.open_fault;
  }
  bool isOpen() const override { return camera_.is_open; }
  void close() override { camera_.is_open = false; }
  std::optional<image_t> next(std::chrono::milliseconds) override {
    if (camera_.images.empty()) {
      if (!camera_.fault.empty()) camera_.is_open = false;
      return std::nullopt;
    }
    image_t image = camera_.images.front();
    camera_.images.pop_front();
    return image;
  }
  std::string fault() const override { return camera_.fault; }
  std::string timeFault() const override { return camera_.time_fault; }
  std::optional<double> exposure_s() const override { return camera_.exposure_s; }

 private:
  Camera& camera_;
};

class CameraNodeTest : public testing::Test {
 protected:
  void start(int jpeg_quality = 0) {
    CaptureParameters capture;
    capture.jpeg_quality = jpeg_quality;
    start(capture);
  }
  void start(const CaptureParameters& capture) {
    Configuration configuration;
    configuration.camera = intrinsics();
    configuration.camera.width = 64;
    configuration.camera.height = 48;
    configuration.camera.line_delay_s = line_delay_s_;
    configuration.capture = capture;
    node_ = std::make_unique<CameraNode>(*bus_, configuration, std::make_unique<SimulatedSource>(camera_),
                                         [this] { return camera_.now_ns; });
    subscription_ =
        bus_->subscribe<image_t>("CAMERA", 100, [this](const image_t& m) { published_.push_back(m); });
  }
  void run(int passes) {
    for (int i = 0; i < passes; ++i) node_->processNext();
    bus_->handle(std::chrono::milliseconds(0));
  }
  void passAfter(std::chrono::nanoseconds time) {
    camera_.now_ns += time.count();
    node_->processNext();
  }
  static cv::Mat1b testImage(int k) {
    cv::Mat1b image(48, 64);
    for (int y = 0; y < image.rows; ++y) {
      for (int x = 0; x < image.cols; ++x) image(y, x) = static_cast<uint8_t>(2 * x + y + k);
    }
    return image;
  }
  process_health_t health() { return node_->health().nextMessage(); }

  std::unique_ptr<Bus> bus_ = makeLcmBus("memq://");
  Camera camera_;
  double line_delay_s_ = 0;
  std::unique_ptr<CameraNode> node_;
  Subscription subscription_;
  std::vector<image_t> published_;
};

}  // namespace redbee::test
