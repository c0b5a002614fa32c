// When the sender of a network camera's images says that it took them.
#pragma once

#include <gst/gst.h>

#include <cstdint>
#include <optional>
#include <string>

namespace redbee {

/// Of one pipeline's images. GStreamer attaches the time that the sender states (RTCP's sender reports,
/// NTP-64 in RTP's header, RFC 7273) where an element of the pipeline has add-reference-timestamp-meta=true:
/// the time of day by NTP or Unix, or TAI by PTP, nanoseconds. It is ours where something keeps both
/// computers' time of day equal; a time that cannot be right by ours is not used.
class SenderClock {
 public:
  /// Looks whether an element of the pipeline is to attach times.
  explicit SenderClock(GstBin* pipeline);

  /// On our clock (libs/node/host_clock.hpp); std::nullopt where the image states none, or one that cannot
  /// be.
  std::optional<int64_t> hostTimeOf(GstBuffer* image, int64_t arrived_ns);
  /// Empty where times are as asked for, by the last image.
  const std::string& fault() const { return fault_; }

 private:
  bool is_asked_for_;
  std::string fault_;
};

}  // namespace redbee
