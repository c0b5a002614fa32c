// Images from a GStreamer pipeline that ends in an appsink.
#pragma once

#include <gst/app/gstappsink.h>
#include <gst/gst.h>

#include <memory>
#include <optional>
#include <string>

#include "processes/camera/frame_source.hpp"
#include "processes/camera/gstreamer/sender_clock.hpp"
#include "redbee/mavlink/clock_estimator.hpp"

namespace redbee {

struct UnrefObject {
  void operator()(void* object) const { gst_object_unref(object); }
};
template <typename Object>
using GstPointer = std::unique_ptr<Object, UnrefObject>;

/// Grey, RGB or BGR, or JPEG as it comes. An image's time is its running time plus the pipeline's base time,
/// on the clock that the pipeline chose; that clock's offset and drift to ours are estimated from readings of
/// both (ClockEstimator: a reading of theirs between two of ours is an exchange without a way). An image
/// without a time is stamped when it arrives. Of a v4l2src the exposure time is read. Where the sender of
/// images over a network states when it took them (SenderClock), that is their time.
class GstreamerSource : public FrameSource {
 public:
  /// Throws UserError unless the pipeline can be made of the elements that are there and has one appsink.
  explicit GstreamerSource(std::string pipeline);
  ~GstreamerSource() override;
  GstreamerSource(const GstreamerSource&) = delete;
  GstreamerSource& operator=(const GstreamerSource&) = delete;

  std::string open() override;
  bool isOpen() const override { return pipeline_ != nullptr; }
  void close() override;
  std::optional<image_t> next(std::chrono::milliseconds timeout) override;
  std::string fault() const override { return fault_; }
  std::string timeFault() const override { return sender_clock_ ? sender_clock_->fault() : ""; }
  std::optional<double> exposure_s() const override { return exposure_s_; }

 private:
  std::string build();
  /// Whether the pipeline has failed or ended.
  bool hasStopped();
  void readClocks();
  void readExposure();
  int64_t hostTimeOf(GstSample* sample, int64_t arrived_ns);

  std::string description_;
  GstPointer<GstElement> pipeline_;
  GstPointer<GstElement> sink_;
  GstPointer<GstElement> v4l2_source_;  ///< where there is one
  std::optional<double> exposure_s_;
  int64_t images_ = 0;
  mavlink::ClockEstimator clock_;
  std::optional<SenderClock> sender_clock_;  ///< of the pipeline
  std::string fault_;
};

}  // namespace redbee
