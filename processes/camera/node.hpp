// A camera in; CAMERA out.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "processes/camera/frame_source.hpp"
#include "processes/camera/image_watch.hpp"
#include "redbee/bus/bus.hpp"
#include "redbee/configuration/configuration.hpp"
#include "redbee/node/node.hpp"

namespace redbee {

/// Publishes each image when it arrives. A source that fails or ends is opened again, after a tenth of a
/// second, then twice as long each time, up to five seconds.
class CameraNode : public Node {
 public:
  using Clock = std::function<int64_t()>;  ///< ns, increasing

  CameraNode(Bus& bus, const Configuration& configuration, std::unique_ptr<FrameSource> source, Clock clock);

  /// One pass: waits up to 20 ms for an image. Always true: the next pass is due at once.
  bool processNext() override;
  void finish() override {}
  HealthMonitor& health() override { return health_; }

 private:
  static constexpr int64_t kFirstPause_ns = 100'000'000;
  static constexpr int64_t kLongestPause_ns = 5'000'000'000;

  bool openSource();
  void postpone(const std::string& fault);
  void publish(image_t image);
  bool isUsable(const image_t& image);

  Bus& bus_;
  Configuration configuration_;
  HealthMonitor health_;
  std::unique_ptr<FrameSource> source_;
  Clock clock_;
  ImageWatch watch_;
  std::string source_fault_;
  int64_t pause_ns_ = kFirstPause_ns;
  int64_t next_open_ns_ = 0;
  std::optional<int64_t> last_us_;
};

}  // namespace redbee
