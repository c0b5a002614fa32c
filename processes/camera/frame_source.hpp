// Where images come from.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "redbee/image_t.hpp"

namespace redbee {

/// May be opened again after it failed or ended.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// Returns what is wrong, in one line; empty where images may come now.
  virtual std::string open() = 0;
  virtual bool isOpen() const = 0;
  virtual void close() = 0;
  /// Waits up to `timeout` for an image; its utime is that of its capture on our clock
  /// (libs/node/host_clock.hpp). Where the source has failed or ended, it is closed, and fault() says why.
  virtual std::optional<image_t> next(std::chrono::milliseconds timeout) = 0;
  virtual std::string fault() const = 0;
  /// What is wrong with the last image's time, in one line without figures that change; empty: nothing.
  virtual std::string timeFault() const { return ""; }
  /// Of the last image [s], where the driver tells it.
  virtual std::optional<double> exposure_s() const { return std::nullopt; }
};

}  // namespace redbee
