// Base class of the processing stages: subscriptions that end with the node, sequence numbers, order of
// frames, timeouts and health.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "redbee/altimeter_t.hpp"
#include "redbee/ins_t.hpp"
#include "redbee/node/frame_order.hpp"
#include "redbee/node/frame_time.hpp"
#include "redbee/node/message_synchronizer.hpp"
#include "redbee/node/node.hpp"
#include "redbee/node/publisher.hpp"
#include "redbee/node/work_timer.hpp"

namespace redbee {

/// Queue length of a subscription: some seconds of each message type.
template <typename Message>
inline constexpr int kQueueLength = 64;
template <>
inline constexpr int kQueueLength<ins_t> = 4000;
template <>
inline constexpr int kQueueLength<altimeter_t> = 4000;

/// A stage subscribes in its constructor with on(), and processes each frame inside workOn().
class Stage : public Node {
 public:
  HealthMonitor& health() final { return health_; }
  void finish() final;

 protected:
  /// `process`: its name in PROCESS_HEALTH.
  Stage(Bus& bus, const std::string& process, const std::string& configuration_hash);

  /// `handler` is called for each message that decodes, and may return whether the message is plausible. A
  /// message that does not decode or is not plausible is counted as damaged; a missing sequence number, if
  /// the type has them, as lost.
  template <typename Message, typename Handler>
  void on(const std::string& channel, Handler handler);

  /// Whether to process a frame with this time; late and duplicate frames are skipped. Calls restart() first
  /// if the camera's clock was set back.
  bool acceptFrame(CameraTime time);
  FrameOrder& frameOrder() { return order_; }
  /// Discards queued messages and state; called when the camera's clock was set back.
  virtual void restart() = 0;

  /// Whether the message for the frame at `time` is pending; never after the last message. Counts timeouts.
  /// `newest`: the latest message time that the node has seen on any channel.
  template <typename Message>
  bool isPending(MessageSynchronizer<Message>& messages, CameraTime time, CameraTime newest);
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

 private:
  Bus& bus_;
  HealthMonitor health_;
  Publisher publisher_;
  FrameOrder order_;
  FrameTimers timers_;
  bool finishing_ = false;
  std::vector<Subscription> subscriptions_;
};

template <typename Message, typename Handler>
void Stage::on(const std::string& channel, Handler handler) {
  subscriptions_.push_back(bus_.subscribe<Message>(
      channel, kQueueLength<Message>,
      [this, channel, handler = std::move(handler)](const Message& message) {
        if constexpr (HasSequence<Message>::value) health_.noteSequence(channel, message.sequence);
        if constexpr (std::is_same_v<std::invoke_result_t<const Handler&, const Message&>, bool>) {
          if (!handler(message)) health_.noteDamaged();
        } else {
          handler(message);
        }
      },
      [this] { health_.noteDamaged(); }));
}

template <typename Message>
bool Stage::isPending(MessageSynchronizer<Message>& messages, CameraTime time, CameraTime newest) {
  if (finishing_) return false;
  const int64_t before = messages.timedOut();
  const auto status = messages.status(time, newest);
  health_.noteLate(messages.timedOut() - before);
  return status == MessageSynchronizer<Message>::Status::kPending;
}

template <typename Work>
void Stage::workOn(CameraTime time, const WorkTimer& arrival, const Work& work) {
  timers_ = {};
  publisher_.beginFrame(time);
  work();
  noteDone(health_, time, arrival, timers_);
}

}  // namespace redbee
