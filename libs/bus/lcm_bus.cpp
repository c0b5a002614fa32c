#include <lcm/lcm.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <list>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "redbee/bus/bus.hpp"
#include "redbee/bus/datagram_filter.hpp"
#include "redbee/bus/receive_buffer.hpp"

namespace redbee {
namespace {

/// LCM's receivers refuse messages of 256 MiB or more; no image comes close to this limit.
constexpr size_t kMaxMessageBytes = size_t{64} << 20;
constexpr size_t kMaxChannelName = 63;
/// Limits one batch, so that a fast sender cannot keep a process from its work.
constexpr int kMaxBatch = 10000;

struct LcmDeleter {
  void operator()(lcm_t* lcm) const { lcm_destroy(lcm); }
};

struct Entry {
  std::string channel;
  Bus::Handler handler;
  int64_t* failures;
  bool is_short;
  lcm_subscription_t* subscription = nullptr;
  bool ended = false;
};

bool isUdp(const std::string& url) { return url.rfind("udpm://", 0) == 0; }
bool isInProcess(const std::string& url) { return url.rfind("memq://", 0) == 0; }

/// LCM interprets subscription names as regular expressions.
std::string escapePattern(const std::string& channel) {
  std::string escaped;
  for (const char c : channel) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

void checkChannel(const std::string& channel) {
  if (channel.empty() || channel.size() > kMaxChannelName) {
    throw std::invalid_argument("channel name \"" + channel + "\" is empty or longer than 63 bytes");
  }
}

/// Exceptions must not propagate into LCM's C code, where they would abort the process.
void dispatch(const lcm_recv_buf_t* received, const char*, void* user) noexcept {
  auto& entry = *static_cast<Entry*>(user);
  if (entry.ended) return;
  const auto fail = [&](const char* what) {
    ++*entry.failures;
    spdlog::error("{}: handler failed: {}", entry.channel, what);
  };
  try {
    entry.handler(static_cast<const uint8_t*>(received->data), static_cast<int>(received->data_size));
  } catch (const std::exception& error) {
    fail(error.what());
  } catch (...) {
    fail("unknown exception");
  }
}

class LcmBus : public Bus {
 public:
  explicit LcmBus(const std::string& url)
      : lcm_(lcm_create(url.c_str())), in_process_(isInProcess(url)), is_udp_(isUdp(url)) {
    if (!lcm_) throw std::runtime_error("LCM cannot open " + url + " (is there a multicast route?)");
  }

  void publish(const std::string& channel, const std::vector<uint8_t>& data) override {
    checkChannel(channel);
    if (data.size() > kMaxMessageBytes) {
      throw std::length_error(channel + ": message of " + std::to_string(data.size()) + " bytes is too long");
    }
    const bool sent =
        lcm_publish(lcm_.get(), channel.c_str(), data.data(), static_cast<unsigned>(data.size())) == 0;
    if (!sent && ++publish_failures_ == 1) spdlog::error("{}: LCM cannot send", channel);
  }

  Subscription subscribe(const std::string& channel, int capacity, Handler handler) override {
    return subscribe(channel, capacity, std::move(handler), false);
  }
  Subscription subscribeShort(const std::string& channel, int capacity, Handler handler) override {
    return subscribe(channel, capacity, std::move(handler), true);
  }

  int handle(std::chrono::milliseconds timeout) override {
    int handed_out = 0;
    auto wait = timeout;
    while ((in_process_ || handed_out < kMaxBatch) && handleOne(wait)) {
      ++handed_out;
      wait = std::chrono::milliseconds(0);
    }
    return handed_out;
  }

  int64_t handlerFailures() const override { return handler_failures_; }

 private:
  Subscription subscribe(const std::string& channel, int capacity, Handler handler, bool is_short) {
    checkChannel(channel);
    entries_.push_back({channel, std::move(handler), &handler_failures_, is_short});
    const auto entry = std::prev(entries_.end());
    const bool is_first = is_udp_ && !has_subscribed_;
    entry->subscription = is_first ? subscribeFirst(*entry) : subscribeTo(*entry);
    if (entry->subscription == nullptr) {
      entries_.erase(entry);
      throw std::runtime_error(channel + ": LCM cannot subscribe");
    }
    has_subscribed_ = true;
    narrow();
    lcm_subscription_set_queue_capacity(entry->subscription, capacity);
    return Subscription([this, entry, alive = std::weak_ptr<bool>(alive_)] {
      if (!alive.expired()) end(entry);
    });
  }

  lcm_subscription_t* subscribeTo(Entry& entry) {
    return lcm_subscribe(lcm_.get(), escapePattern(entry.channel).c_str(), &dispatch, &entry);
  }

  /// With the first subscription LCM opens the socket that it receives with, and does not say which. Where
  /// another was opened meanwhile, it is not known either.
  lcm_subscription_t* subscribeFirst(Entry& entry) {
    static std::mutex one_at_a_time;
    const std::lock_guard<std::mutex> lock(one_at_a_time);
    const std::set<int> before = udpSockets();
    lcm_subscription_t* subscription = subscribeTo(entry);
    std::set<int> opened;
    for (const int socket : udpSockets())
      if (before.count(socket) == 0) opened.insert(socket);
    if (opened.size() == 1) socket_ = *opened.begin();
    return subscription;
  }

  /// What nobody subscribed to is left to the kernel. LCM leaves it, too, but it takes and copies it first.
  void narrow() {
    if (socket_ < 0) return;
    std::vector<WantedChannel> wanted;
    for (const Entry& entry : entries_) wanted.push_back({entry.channel, entry.is_short});
    receiveOnly(socket_, wanted);
  }

  bool handleOne(std::chrono::milliseconds timeout) {
    handling_ = true;
    const int result = lcm_handle_timeout(lcm_.get(), static_cast<int>(timeout.count()));
    handling_ = false;
    eraseEnded();
    if (result < 0 && errno != EINTR) {
      throw std::runtime_error(std::string("LCM cannot receive: ") + std::strerror(errno));
    }
    return result > 0;
  }

  /// LCM cannot unsubscribe inside a handler: subscriptions that end there are erased afterwards.
  void end(std::list<Entry>::iterator entry) {
    entry->ended = true;
    has_ended_ = true;
    if (!handling_) eraseEnded();
  }
  void eraseEnded() {
    if (!std::exchange(has_ended_, false)) return;
    for (auto entry = entries_.begin(); entry != entries_.end();) {
      if (entry->ended) lcm_unsubscribe(lcm_.get(), entry->subscription);
      entry = entry->ended ? entries_.erase(entry) : std::next(entry);
    }
    narrow();
  }

  std::list<Entry> entries_;  ///< outlives lcm_, which points into it
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
  bool handling_ = false;
  bool has_ended_ = false;
  int64_t handler_failures_ = 0;
  int64_t publish_failures_ = 0;
  std::unique_ptr<lcm_t, LcmDeleter> lcm_;
  bool in_process_;
  bool is_udp_;
  bool has_subscribed_ = false;
  int socket_ = -1;  ///< that LCM receives with; -1: not known
};

}  // namespace

void checkLcmUrl(const std::string& url) {
  const char* policy = std::getenv("REDBEE_NETWORK_POLICY");  // NOLINT(concurrency-mt-unsafe)
  if (policy != nullptr && std::string(policy) == "none" && !isInProcess(url)) {
    throw std::runtime_error("REDBEE_NETWORK_POLICY=none allows memq:// only, not " + url);
  }
  const UdpBufferCheck check = checkReceiveBuffer(url);
  if (!check.enough) spdlog::warn("{}", check.advice);
}

std::unique_ptr<Bus> makeLcmBus(const std::string& url) {
  checkLcmUrl(url);
  return std::make_unique<LcmBus>(url);
}

}  // namespace redbee
