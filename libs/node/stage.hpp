// Base class of the processing stages: subscriptions that end with the node, sequence numbers, order of
// frames, timeouts and health.
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/types.hpp>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "redbee/altimeter_t.hpp"
#include "redbee/gimbal_t.hpp"
#include "redbee/image_t.hpp"
#include "redbee/ins_t.hpp"
#include "redbee/lens_t.hpp"
#include "redbee/node/frame_queue.hpp"
#include "redbee/node/frame_time.hpp"
#include "redbee/node/message_check.hpp"
#include "redbee/node/message_synchronizer.hpp"
#include "redbee/node/node.hpp"
#include "redbee/node/publisher.hpp"
#include "redbee/node/publisher_choice.hpp"
#include "redbee/node/work_timer.hpp"
#include "redbee/pose_t.hpp"

namespace redbee {

template <typename Type, typename... Others>
inline constexpr bool kIsOneOf = (std::is_same_v<Type, Others> || ...);

/// Queue length of a subscription: some seconds of each message type, as long as a stage may hang before it
/// is started again (watch.hang_timeout_s). Frames come at up to 60 Hz; what a driver reads of a vehicle at
/// up to 1 kHz (autopilot.imu_rate_hz and attitude_rate_hz), in bursts where its link stutters.
constexpr int kFrameQueue = 64;
constexpr int kVehicleQueue = 4000;
template <typename Message>
inline constexpr int kQueueLength =
    kIsOneOf<Message, ins_t, altimeter_t, gimbal_t, lens_t, pose_t> ? kVehicleQueue : kFrameQueue;

/// A stage subscribes in its constructor with on(), and processes each frame inside workOn().
class Stage : public Node {
 public:
  HealthMonitor& health() final { return health_; }
  void finish() final;

 protected:
  /// `process`: its name in PROCESS_HEALTH.
  Stage(Bus& bus, const std::string& process, const std::string& configuration_hash);

  /// `handler` is called for each message that decodes and is plausible (message_check.hpp), and may return
  /// whether it was of use. Any other message is counted as damaged; a missing sequence number, if
  /// the type has them, as lost. Of several publishers, where the type names them, one is listened to.
  template <typename Message, typename Handler>
  void on(const std::string& channel, Handler handler);

  /// Whether an image is of the camera's size; one that is not is ignored, before anything is decoded, and
  /// the health says so.
  bool isOfCamera(const image_t& image, cv::Size camera, const std::string& channel);
  /// Queues a frame, which a message of `channel` is about, unless it has come before. Calls restart() first
  /// if the camera's clock was set back.
  template <typename Content>
  void queueFrame(FrameQueue<Content>& frames, const std::string& channel, CameraTime time, Content content);
  /// Discards the state, and queued messages of frames after `newest`; called when the camera's clock was set
  /// back, `newest` being the newest frame since.
  virtual void restart(CameraTime newest) = 0;
  /// The latest message time that the node has seen.
  virtual CameraTime now() const = 0;

  /// Whether the message for the frame at `time` is pending; never after the last message. Counts timeouts.
  template <typename Message>
  bool isPending(MessageSynchronizer<Message>& messages, CameraTime time);
  /// Whether a frame may be processed: no earlier one may still arrive. Precondition: not empty.
  template <typename Content>
  bool isInOrder(const FrameQueue<Content>& frames) const {
    return finishing_ || frames.isInOrder(now());
  }
  /// For stages that queue the frames of other messages: takes the next frame once it is in order and
  /// `isReady(time)`, and does `work(time)`, inside workOn(). Whether there was one.
  template <typename Ready, typename Work>
  bool processFront(FrameQueue<WorkTimer>& frames, const Ready& isReady, const Work& work);
  /// No more messages will arrive: process() handles what is left.
  bool isFinishing() const { return finishing_; }

  /// Calls `work` for one frame and records its latency and processor time. `arrival`: started when the frame
  /// was received.
  template <typename Work>
  void workOn(CameraTime time, const WorkTimer& arrival, const Work& work);
  /// Inside workOn(): the frame's result is computed; what follows is encoding and publishing.
  void noteResultReady() { timers_.cpu.resultReady(); }
  /// Inside workOn(): publishes a message about the frame.
  template <typename Message>
  void publish(const std::string& channel, Message message) {
    publisher_.publish(channel, std::move(message));
  }
  Publisher& publisher() { return publisher_; }

  static constexpr const char* kSecondSource = "a second source is ignored";  ///< for noteIgnored()

 private:
  /// Whether the message is plausible; one that is not is counted and reported.
  template <typename Message>
  bool isUsable(const std::string& channel, const Message& message) {
    const char* fault = faultOf(message);
    if (fault != nullptr) refuse(channel, fault);
    return fault == nullptr;
  }
  void refuse(const std::string& channel, const char* fault);
  /// The publishers that `message` comes from are told apart, and those not listened to are reported.
  template <typename Message>
  std::vector<Message> chosen(PublisherChoice<Message>& choice, const std::string& channel,
                              const Message& message);
  template <typename Message, typename Handler>
  void deliver(const std::string& channel, const Handler& handler, const Message& message);

  Bus& bus_;
  HealthMonitor health_;
  Publisher publisher_;
  FrameTimers timers_;
  bool finishing_ = false;
  std::set<std::string> refused_;  ///< channels and faults that were logged
  std::vector<Subscription> subscriptions_;
};

template <typename Message, typename Handler>
void Stage::on(const std::string& channel, Handler handler) {
  const auto damaged = [this] { health_.noteDamaged(); };
  if constexpr (HasPublisher<Message>::value) {
    const auto choice = std::make_shared<PublisherChoice<Message>>();
    subscriptions_.push_back(bus_.subscribe<Message>(
        channel, kQueueLength<Message>,
        [this, channel, choice, handler = std::move(handler)](const Message& message) {
          if (!isUsable(channel, message)) return;
          for (const Message& each : chosen(*choice, channel, message)) deliver(channel, handler, each);
        },
        damaged));
  } else {
    subscriptions_.push_back(bus_.subscribe<Message>(
        channel, kQueueLength<Message>,
        [this, channel, handler = std::move(handler)](const Message& message) {
          if (isUsable(channel, message)) deliver(channel, handler, message);
        },
        damaged));
  }
}

template <typename Message>
std::vector<Message> Stage::chosen(PublisherChoice<Message>& choice, const std::string& channel,
                                   const Message& message) {
  std::vector<Message> messages = choice.admit(message, now());
  if (choice.takeIgnored() > 0) health_.noteIgnored(channel, kSecondSource);
  if (choice.takeChange()) health_.restartSequence(channel);
  return messages;
}

template <typename Message, typename Handler>
void Stage::deliver(const std::string& channel, const Handler& handler, const Message& message) {
  if constexpr (HasSequence<Message>::value) health_.noteSequence(channel, message.sequence);
  if constexpr (std::is_same_v<std::invoke_result_t<const Handler&, const Message&>, bool>) {
    if (!handler(message)) health_.noteDamaged();
  } else {
    handler(message);
  }
}

template <typename Content>
void Stage::queueFrame(FrameQueue<Content>& frames, const std::string& channel, CameraTime time,
                       Content content) {
  const FrameArrival arrival = frames.put(time, std::move(content));
  const auto discarded = frames.takeDiscarded();
  health_.noteSkipped(discarded.late);
  if (discarded.of_another_time > 0) health_.noteIgnored(channel, kSecondSource);
  if (arrival == FrameArrival::kRepeated || arrival == FrameArrival::kHeld) return;
  if (arrival == FrameArrival::kRestarted) {
    restart(time);
    health_.setState(HealthState::kDegraded, "the camera's clock was set back: restarted");
  }
  health_.noteInput(time.time_since_epoch());
}

template <typename Message>
bool Stage::isPending(MessageSynchronizer<Message>& messages, CameraTime time) {
  if (finishing_) return false;
  const int64_t before = messages.timedOut();
  const auto status = messages.status(time, now());
  health_.noteLate(messages.timedOut() - before);
  return status == MessageSynchronizer<Message>::Status::kPending;
}

template <typename Ready, typename Work>
bool Stage::processFront(FrameQueue<WorkTimer>& frames, const Ready& isReady, const Work& work) {
  if (frames.empty() || !isInOrder(frames) || !isReady(frames.frontTime())) return false;
  const CameraTime frame = frames.frontTime();
  const WorkTimer arrival = frames.pop();
  workOn(frame, arrival, [&] { work(frame); });
  return true;
}

template <typename Work>
void Stage::workOn(CameraTime time, const WorkTimer& arrival, const Work& work) {
  timers_ = {};
  publisher_.beginFrame(time);
  work();
  noteDone(health_, time, arrival, timers_);
}

}  // namespace redbee
