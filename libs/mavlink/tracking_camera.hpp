// A MAVLink camera that tracks what the stack detects (mavlink.io/en/services/camera.html, "Camera
// Tracking"): commands in, status messages out. Knows no device and no clock.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "redbee/mavlink/camera_messages.hpp"
#include "redbee/mavlink/encoder.hpp"
#include "redbee/mavlink/messages.hpp"
#include "redbee/mavlink/parameters.hpp"
#include "redbee/mavlink/parser.hpp"
#include "redbee/mavlink/sequence_loss.hpp"
#include "redbee/mavlink/tracking_messages.hpp"
#include "redbee/mavlink/trust.hpp"

namespace redbee::mavlink {

/// Of the image, 0..1 from its left and upper edge.
struct RelativeBox {
  double left = 0, top = 0, right = 0, bottom = 0;
  double width() const { return right - left; }
  double area() const { return width() * (bottom - top); }
};

/// NaN where unknown.
struct ObjectPlace {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double altitude_m = 0;  ///< above mean sea level
  double sigma_m = 0;     ///< horizontal
  double north_m_s = 0;
  double east_m_s = 0;
  double velocity_sigma_m_s = 0;
  double distance_m = 0;  ///< from the camera
};

struct TrackedObject {
  int id = 0;
  bool is_seen = false;  ///< false: predicted
  std::optional<RelativeBox> box;
  std::optional<ObjectPlace> place;
};

class TrackingCamera {
 public:
  static constexpr int64_t kHeartbeatPeriod_ns = 1'000'000'000;
  static constexpr int64_t kStale_ns = 1'000'000'000;  ///< after which objects are no longer believed
  static constexpr int64_t kLost_ns = 3'000'000'000;   ///< after which who was picked is given up
  static constexpr size_t kMostIndicated = 8;          ///< movers in one round of status messages

  /// Size of the image [px]. `key`: frames are signed, and only signed ones are listened to. `now`: of the
  /// signatures.
  TrackingCamera(const GroundLinkParameters& parameters, int width, int height,
                 const std::optional<SigningKey>& key, SigningTime now);

  /// What the link has received. `is_datagram`: it holds whole frames.
  void receive(const uint8_t* data, size_t size, int64_t host_ns, bool is_datagram);
  /// All objects of the newest frame, at this time of our clock [ns].
  void show(std::vector<TrackedObject> objects, int64_t host_ns);
  /// What is due: heartbeat, answers, status messages. Of who was picked; where nobody is, of each mover in
  /// view, as a moving target indicator. To be called often.
  std::vector<Bytes> dueFrames(int64_t host_ns);
  /// The device was opened again: what was half received is lost.
  void reconnect();

  std::optional<int> picked() const { return picked_; }
  const ParserCounters& parserCounters() const { return parser_.counters(); }
  int64_t lost() const { return loss_.lost(); }
  const Trust& trust() const { return trust_; }

 private:
  void handle(const Frame& frame, int64_t host_ns);
  uint8_t execute(const CommandLong& command, int64_t host_ns);
  uint8_t pickPoint(const CommandLong& command, int64_t host_ns);
  uint8_t pickRectangle(const CommandLong& command, int64_t host_ns);
  uint8_t setInterval(uint32_t message, double interval_us);
  uint8_t sendRequested(uint32_t message, int64_t host_ns);
  void pick(int id, uint8_t mode, int64_t host_ns);
  bool isStale(int64_t host_ns) const { return host_ns - shown_ns_ > kStale_ns; }
  /// Objects with their status, in the order of importance.
  struct Indicated {
    const TrackedObject* object = nullptr;  ///< nullptr: nothing to show
    uint8_t status = 0;
  };
  std::vector<Indicated> indicated(int64_t host_ns) const;
  void sendImageStatus(const Indicated& each);
  void sendGeoStatus(const Indicated& each);
  CameraInformation information(int64_t host_ns) const;
  template <typename Message>
  void send(const Message& message) {
    outgoing_.push_back(encoder_.encode(message));
  }

  /// A status message that is sent by itself.
  struct Stream {
    int64_t period_ns = 0;  ///< 0: only where it is asked for
    int64_t next_ns = 0;
    bool isDue(int64_t host_ns);
  };

  GroundLinkParameters parameters_;
  int width_;
  int height_;
  Parser parser_;
  Encoder encoder_;
  Trust trust_;
  SequenceLoss loss_;
  std::vector<TrackedObject> objects_;
  int64_t shown_ns_;
  std::optional<int> picked_;
  int64_t picked_seen_ns_ = 0;  ///< when who was picked was last among the objects
  uint8_t mode_ = CameraTrackingImageStatus::kNoMode;
  bool has_mti_ = true;
  int64_t next_heartbeat_ns_ = 0;
  Stream image_, geo_;
  std::vector<Bytes> outgoing_;
};

}  // namespace redbee::mavlink
