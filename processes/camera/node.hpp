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
#include "redbee/node/back_off.hpp"
#include "redbee/node/node.hpp"

namespace redbee {

/// Publishes each image when it arrives. A source that fails, ends or falls silent is opened again (BackOff).
class CameraNode : public Node {
 public:
  using Clock = std::function<int64_t()>;  ///< ns, increasing

  CameraNode(Bus& bus, const Configuration& configuration, std::unique_ptr<FrameSource> source, Clock clock);

  /// One pass: waits up to 20 ms for an image. Always true: the next pass is due at once.
  bool processNext() override;
  void finish() override {}
  HealthMonitor& health() override { return health_; }

 private:
  bool openSource();
  void postpone(const std::string& fault);
  void publish(image_t image);
  double exposureTime() const;  ///< s; 0: unknown
  bool isUsable(const image_t& image);

  Bus& bus_;
  Configuration configuration_;
  HealthMonitor health_;
  std::unique_ptr<FrameSource> source_;
  Clock clock_;
  ImageWatch watch_;
  std::string source_fault_;
  int64_t silent_since_ns_ = 0;  ///< the last image, or when the source was opened
  BackOff back_off_;
  std::optional<int64_t> last_us_;
};

}  // namespace redbee
