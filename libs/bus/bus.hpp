// The message bus behind a small interface, so that a node runs over UDP multicast, in one process on
// memq://, or on a test double.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "redbee/bus/codec.hpp"
#include "redbee/bus/message_length.hpp"
#include "redbee/bus/subscription.hpp"

namespace redbee {

/// Messages: queue length of a program that only listens.
inline constexpr int kListenerQueue = 256;

class Bus {
 public:
  using Handler = std::function<void(const uint8_t* data, int size)>;

  virtual ~Bus() = default;
  virtual void publish(const std::string& channel, const std::vector<uint8_t>& data) = 0;
  /// `channel` is a name, not a pattern. `capacity`: queue length; when the queue is full, new messages are
  /// dropped. The handler is called until the subscription ends.
  virtual Subscription subscribe(const std::string& channel, int capacity, Handler handler) = 0;
  /// The same for messages of at most kShortMessage bytes: longer ones may be lost.
  virtual Subscription subscribeShort(const std::string& channel, int capacity, Handler handler) {
    return subscribe(channel, capacity, std::move(handler));
  }
  /// Waits up to `timeout` for a message, then dispatches all queued ones. Returns the number of messages
  /// dispatched; 0 after the timeout or a signal. Exceptions thrown by handlers are caught.
  virtual int handle(std::chrono::milliseconds timeout) = 0;
  /// Number of exceptions thrown by handlers so far; each was logged and its message lost.
  virtual int64_t handlerFailures() const { return 0; }

  template <typename Message>
  void publish(const std::string& channel, const Message& message) {
    publish(channel, encodeMessage(message));
  }

  /// Calls `handler` for each message that decodes, and `damaged` (if any) for each that does not.
  template <typename Message>
  Subscription subscribe(const std::string& channel, int capacity,
                         std::function<void(const Message&)> handler, std::function<void()> damaged = {}) {
    Handler decoding = [handler = std::move(handler), damaged = std::move(damaged)](const uint8_t* data,
                                                                                    int size) {
      Message message;
      if (decodeMessage(data, size, message)) {
        handler(message);
      } else if (damaged) {
        damaged();
      }
    };
    if constexpr (kIsShort<Message>) return subscribeShort(channel, capacity, std::move(decoding));
    return subscribe(channel, capacity, std::move(decoding));
  }
};

/// Throws std::runtime_error if the environment has REDBEE_NETWORK_POLICY=none and `url` is not memq://;
/// warns if the receive buffer is too small for images.
void checkLcmUrl(const std::string& url);

/// A bus on an LCM URL (udpm://..., memq://). Throws std::runtime_error if LCM cannot open it or
/// checkLcmUrl() refuses it.
std::unique_ptr<Bus> makeLcmBus(const std::string& url);

}  // namespace redbee
